//! The variants, tolerance by tolerance.
//!
//! From the smallest tolerance up: each search also starts from the program of the one
//! before, which its tolerance admits as well. So none is dearer than one before it. A search
//! with other settings may still find less for one tolerance alone.

use dalembert_codegen::workspace::{
    Admitted, BoundEffort, Certificate, ErrorBudget, PruneSettings, TextError, each, falsify,
};
use dalembert_codegen::{Effort, Program, ScalarType};

use super::Point;

/// The options of a sweep.
#[derive(Clone, Copy, Debug)]
pub struct Options {
    /// States at which each variant is run.
    pub samples: usize,
    /// Climbs from there to the largest error of each output.
    pub climbs: usize,
    /// The effort of the search.
    pub effort: Effort,
}

/// Observes the progress of a sweep.
pub trait Waiting {
    /// Called where a step begins that takes long.
    fn begin(&self, name: &str);
    /// Called where the variants of a tolerance are certified.
    fn done(&self, tolerance: f64, variants: &[Point]);
}

/// A scalar may share the others' variant if rounding takes less than this
/// part of the tolerance.
const SHARE: f64 = 1.0 / 16.0;

/// The variants of one function, tolerance by tolerance.
pub struct Ladder<'a> {
    options: Options,
    frame: &'a ErrorBudget<'a>,
    waiting: &'a dyn Waiting,
    settings: PruneSettings,
    /// The exact program in every scalar.
    exact: Admitted,
}

impl<'a> Ladder<'a> {
    /// Makes a ladder for a function in its box.
    pub fn new(
        options: Options,
        frame: &'a ErrorBudget<'a>,
        waiting: &'a dyn Waiting,
    ) -> Ladder<'a> {
        waiting.begin("exact");
        Ladder {
            options,
            frame,
            waiting,
            settings: PruneSettings::of(options.effort),
            exact: frame.unedited(&ScalarType::ALL, BoundEffort::CERTIFY),
        }
    }

    /// Returns the variants of all tolerances, which ascend; the exact program's first.
    ///
    /// # Errors
    /// A variant cannot be run.
    pub fn climb(&self, tolerances: &[f64]) -> Result<Vec<Point>, TextError> {
        let mut points: Vec<Point> = Vec::new();
        for tolerance in tolerances.iter().copied().chain([0.0]) {
            let variants = self.rung(tolerance, points.last())?;
            self.waiting.done(tolerance, &variants);
            points.extend(variants);
        }
        points.sort_by(|a, b| {
            let order = a.tolerance.total_cmp(&b.tolerance);
            order.then(a.kind().cmp(&b.kind()))
        });
        Ok(points)
    }

    /// Returns a variant with polynomials for its sines, if the tolerance admits any.
    fn polynomials(&self, tolerance: f64, certificate: &Certificate) -> Option<Certificate> {
        let tolerances = vec![tolerance; self.frame.scales.len()];
        let found = self
            .frame
            .with_polynomials(certificate, &tolerances, BoundEffort::CERTIFY);
        found.ok().filter(|found| !found.sines.is_empty())
    }

    /// Returns the variants of one tolerance; `before` is one that a smaller tolerance admits.
    fn rung(&self, tolerance: f64, before: Option<&Point>) -> Result<Vec<Point>, TextError> {
        self.waiting.begin(&format!("tolerance {tolerance:e}"));
        let exact = tolerance == 0.0;
        let variants = match exact {
            true => vec![self.exact.clone()],
            false => self.variants(tolerance, before),
        };
        self.waiting
            .begin(&format!("attempts to refute {tolerance:e}"));
        let mut certificates = Vec::new();
        for certificate in variants.into_iter().flat_map(|v| v.certificates) {
            let polynomials = match exact {
                true => None,
                false => self.polynomials(tolerance, &certificate),
            };
            certificates.push(certificate);
            certificates.extend(polynomials);
        }
        let options = self.options;
        let points = each(&certificates, |certificate| {
            point(options, tolerance, certificate)
        });
        points.into_iter().collect()
    }

    /// Returns the cheapest variants that a tolerance admits, in each scalar that can
    /// be that exact at all; `before` is one that a smaller tolerance admits.
    fn variants(&self, tolerance: f64, before: Option<&Point>) -> Vec<Admitted> {
        let tolerances = vec![tolerance; self.frame.scales.len()];
        let worst = |certificate: &Certificate| {
            let totals = certificate.bounds.iter().map(|bound| bound.total());
            totals.fold(0.0, f64::max)
        };
        let able = self.exact.certificates.iter();
        let able: Vec<_> = able.filter(|c| worst(c) <= tolerance).collect();
        let alike = able.iter().all(|c| worst(c) <= SHARE * tolerance);
        let groups: Vec<Vec<ScalarType>> = match alike {
            true => vec![able.iter().map(|c| c.scalar).collect()],
            false => able.iter().map(|c| vec![c.scalar]).collect(),
        };
        let groups = groups.into_iter().filter(|scalars| !scalars.is_empty());
        let from = before.map(|point| point.certificate.emitted.clone());
        let from = from.filter(|program| program != self.frame.exact);
        let from: Vec<Program> = from.into_iter().collect();
        groups
            .map(|scalars| {
                let found = self.frame.choose_from(
                    &from,
                    &tolerances,
                    &scalars,
                    &self.settings,
                    BoundEffort::CERTIFY,
                );
                found.unwrap_or_else(|_| self.exact_in(&scalars))
            })
            .collect()
    }

    fn exact_in(&self, scalars: &[ScalarType]) -> Admitted {
        let mut exact = self.exact.clone();
        exact.certificates.retain(|c| scalars.contains(&c.scalar));
        exact
    }
}

/// Runs a variant at states that try to refute its claim.
fn point(options: Options, tolerance: f64, certificate: &Certificate) -> Result<Point, TextError> {
    let (observed, mut violation) = falsified(options, certificate)?;
    let mut rounding_observed = None;
    if certificate.scalar == ScalarType::F32 {
        let (observed, other) = falsified(options, &certificate.of_rounding())?;
        rounding_observed = observed;
        violation = violation.or(other);
    }
    Ok(Point {
        observed,
        rounding_observed,
        violation,
        ..Point::new(tolerance, certificate.clone())
    })
}

/// Returns the largest error that is seen, and one above E.
fn falsified(
    options: Options,
    certificate: &Certificate,
) -> Result<(Option<f64>, Option<String>), TextError> {
    let falsification = falsify(certificate, options.samples, options.climbs, 1)?;
    let largest = || falsification.observed.iter().copied().fold(0.0, f64::max);
    let observed = (falsification.states > 0).then(largest);
    let violation = falsification.violation.map(|(index, state)| {
        format!(
            "{} errs up to {:e}, which is more than its E of {:e}, as at {state:?}",
            certificate.emitted.entry(index),
            falsification.observed[index],
            certificate.bounds[index].total()
        )
    });
    Ok((observed, violation))
}
