//! The bounds of claims, found anew: what the edits cost, what sines and rounding
//! cost, and whether D stays positive definite.
//!
//! Each cause is bounded coarsely first, as some claims were made, and finely only
//! where that does not show the claim. What the scalars share is found once.

use std::cell::OnceCell;
use std::rc::Rc;

use super::subject::{Subject, changes_inertia};
use super::{Certificate, Refuted};
use crate::bound::definite::{is_at_least, least_eigenvalue};
use crate::bound::sensitivity::{BoundEffort, Sensitivity};
use crate::program::ScalarType;
use crate::split::ErrorByCause;

/// From coarse to fine.
const EFFORTS: [BoundEffort; 2] = [BoundEffort::QUICK, BoundEffort::CERTIFY];

/// What finds a program's sensitivity, or has it already.
type Sensitivities<'s> = &'s dyn Fn(BoundEffort) -> Rc<Sensitivity>;

/// What the claims about a variant in several scalars share: the longest to find.
pub(crate) struct Shared<'s> {
    subject: Subject<'s>,
    sensitivity: Sensitivities<'s>,
    /// The edits' errors, at each effort.
    models: [OnceCell<Vec<f64>>; EFFORTS.len()],
    sensitivities: [OnceCell<Rc<Sensitivity>>; EFFORTS.len()],
}

impl<'s> Shared<'s> {
    /// Nothing is found until it is asked for.
    pub(crate) fn new(subject: Subject<'s>, sensitivity: Sensitivities<'s>) -> Shared<'s> {
        Shared {
            subject,
            sensitivity,
            models: Default::default(),
            sensitivities: Default::default(),
        }
    }

    /// Returns what the edits cost, relative to each output's T, for which the scalars' claims
    /// are the same.
    fn edits(&self, effort: usize, claims: &[ErrorByCause]) -> Vec<f64> {
        let pairs = claims.iter().zip(self.subject.scales);
        // Relative to T it is rounded up.
        let limit = |(claim, scale): (&ErrorByCause, &f64)| claim.model * (1.0 - 4e-16) * scale;
        let limits: Vec<f64> = pairs.map(limit).collect();
        let find = || self.subject.model_within(&limits, EFFORTS[effort]);
        self.subject.relative(self.models[effort].get_or_init(find))
    }

    /// Returns what rounding and sines cost in a scalar.
    fn rounding(&self, effort: usize, scalar: ScalarType) -> Vec<ErrorByCause> {
        let found = &self.sensitivities[effort];
        let found = found.get_or_init(|| (self.sensitivity)(EFFORTS[effort]));
        self.subject.rounding(scalar, found)
    }
}

impl Certificate {
    /// Returns whether all that is claimed of bounds and of D can be shown; the bounds
    /// that were found.
    pub(crate) fn check_claims(&self, shared: &Shared<'_>) -> Result<Vec<ErrorByCause>, Refuted> {
        let found = self.check_bounds(shared)?;
        self.check_definite()?;
        Ok(found)
    }

    fn check_bounds(&self, shared: &Shared<'_>) -> Result<Vec<ErrorByCause>, Refuted> {
        let claims = &self.bounds;
        let edits = least(
            |effort| shared.edits(effort, claims),
            |found| {
                claims
                    .iter()
                    .zip(found)
                    .all(|(claim, &found)| claim.model >= found)
            },
            f64::min,
        );
        let rounding = least(
            |effort| shared.rounding(effort, self.scalar),
            |found| {
                let mut pairs = claims.iter().zip(found);
                pairs.all(|(claim, found)| {
                    claim.sincos >= found.sincos && claim.rounding >= found.rounding
                })
            },
            ErrorByCause::min,
        );
        let pairs = edits.into_iter().zip(rounding);
        let found: Vec<ErrorByCause> = pairs
            .map(|(model, rounding)| ErrorByCause { model, ..rounding })
            .collect();
        // No number shows nothing.
        let shown = |(claim, found): (&ErrorByCause, &ErrorByCause)| {
            claim.model >= found.model
                && claim.sincos >= found.sincos
                && claim.rounding >= found.rounding
        };
        match claims.iter().zip(&found).position(|pair| !shown(pair)) {
            None => Ok(found),
            Some(index) => Err(Refuted::Bound {
                entry: self.emitted.entry(index),
                claimed: claims[index],
                found: found[index],
            }),
        }
    }

    /// Checks that D, if it is not the model's, is claimed to be positive definite, and is.
    fn check_definite(&self) -> Result<(), Refuted> {
        let changed = changes_inertia(&self.stages, &self.emitted, &self.sines);
        if self.lambda_min.is_none() && !changed {
            return Ok(());
        }
        let claimed = self.lambda_min.unwrap_or(0.0);
        // The claim says what to show: one pass, in place of a search.
        if is_at_least(
            claimed,
            &self.emitted,
            self.scalar,
            &self.sines,
            &self.limits,
        ) {
            return Ok(());
        }
        let found = least_eigenvalue(&self.emitted, self.scalar, &self.sines, &self.limits)
            .map_err(Refuted::Indefinite)?;
        if claimed > 0.0 && claimed <= found {
            return Ok(());
        }
        Err(Refuted::Eigenvalue { claimed, found })
    }
}

/// Returns what the coarse bounds come to if they show the claims; if not, the smaller of
/// those and the fine ones.
fn least<T>(
    of: impl Fn(usize) -> Vec<T>,
    shows: impl Fn(&[T]) -> bool,
    min: impl Fn(T, T) -> T,
) -> Vec<T> {
    let coarse = of(0);
    if shows(&coarse) {
        return coarse;
    }
    coarse
        .into_iter()
        .zip(of(1))
        .map(|(a, b)| min(a, b))
        .collect()
}
