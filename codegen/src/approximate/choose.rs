//! Choosing: the cheapest variant of a function that a tolerance admits.
//!
//! What rounding and sines cost is set aside first, twice over, since the
//! program that is left is another one; [`prune`] may use the rest. What comes
//! out is certified as a whole, and only that decides: as long as E is above
//! the tolerance, more is set aside, and in the end nothing is left out.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::rc::Rc;

use dalembert_model::scene::{Scale, Tolerance};

use crate::approximate::admitted::{Admitted, within};
use crate::approximate::error::{ToleranceError, unbounded_by};
use crate::approximate::prune::{PruneSettings, Pruned, Target};
use crate::approximate::regrouping;
use crate::approximate::sines;
use crate::approximate::starts::Starts;
use crate::bound::definite::least_eigenvalue;
use crate::bound::input_box::InputBox;
use crate::bound::scale;
use crate::bound::sensitivity::{BoundEffort, Sensitivity};
use crate::bound::work::Meter;
use crate::certificate::Certificate;
use crate::edits::{Omission, omissions};
use crate::program::{Program, ScalarType, has_inertia};
use crate::setup::{SceneKey, Setup};
use crate::states::JointState;
use crate::watch::{FunctionWatch, Part};
use crate::words::{Complaint, complaint};

/// What errors of a function are bounded in and relative to.
#[derive(Clone, Debug)]
pub struct ErrorBudget<'a> {
    /// The full model.
    pub setup: &'a Setup,
    /// The exact program.
    pub exact: &'a Program,
    /// Where bounds hold.
    pub limits: InputBox,
    /// T of each output.
    pub scales: Vec<f64>,
    /// What T is.
    pub relative_to: Scale,
    /// If it is the range, states at which the outputs reach it.
    reached: Vec<JointState>,
    watch: FunctionWatch<'a>,
    /// Cache of the latest programs' sensitivities.
    sensitivities: RefCell<Vec<Rc<Sensitivity>>>,
    definite: RefCell<BTreeMap<ScalarType, Result<f64, Complaint>>>,
}

/// The exact program's sensitivity and a variant's or two.
const KEPT: usize = 3;

impl<'a> ErrorBudget<'a> {
    /// Returns the box of a robot in its scene, and T over it.
    ///
    /// # Errors
    /// [`ToleranceError::Refused`]: a function without bounds, a limit that is missing, or actuators
    /// that are no measure of it.
    pub fn new(
        setup: &'a Setup,
        exact: &'a Program,
        relative_to: Scale,
    ) -> Result<ErrorBudget<'a>, ToleranceError> {
        unbounded_by(exact).map_or(Ok(()), |why| Err(ToleranceError::Refused(why)))?;
        let limits = InputBox::within(setup, exact.function).map_err(ToleranceError::Refused)?;
        let (scales, reached) = match relative_to {
            Scale::Actuator => {
                let scales = scale::actuator(setup.robot(), exact);
                (scales.map_err(ToleranceError::Refused)?, Vec::new())
            }
            Scale::Range => scale::range(exact, &limits).into_iter().unzip(),
        };
        Ok(ErrorBudget {
            setup,
            exact,
            limits,
            scales,
            relative_to,
            reached,
            watch: FunctionWatch::default(),
            sensitivities: RefCell::default(),
            definite: RefCell::default(),
        })
    }

    /// Returns the same under a watch: where it is over, a search ends with its best.
    pub fn watched(self, watch: FunctionWatch<'a>) -> ErrorBudget<'a> {
        ErrorBudget { watch, ..self }
    }

    /// Returns the tolerance of each output.
    pub fn tolerances(&self, tolerance: &Tolerance) -> Vec<f64> {
        scale::tolerances(self.exact, tolerance)
    }

    fn sensitivity(&self, program: &Program, bound_effort: BoundEffort) -> Rc<Sensitivity> {
        let mut known = self.sensitivities.borrow_mut();
        let found = known
            .iter()
            .position(|s| s.is_of(program, &self.limits, bound_effort));
        let found = match found {
            Some(index) => known.remove(index),
            None => Rc::new(Sensitivity::new(program, &self.limits, bound_effort)),
        };
        known.truncate(KEPT - 1);
        known.insert(0, found.clone());
        found
    }

    /// Shows that the exact program's D, if it has one, is positive definite: if it cannot be
    /// shown, no variant's can.
    ///
    /// # Errors
    /// [`ToleranceError::Indefinite`].
    pub fn definite(&self, scalars: &[ScalarType]) -> Result<(), ToleranceError> {
        if !has_inertia(self.exact) {
            return Ok(());
        }
        let mut known = self.definite.borrow_mut();
        for &scalar in scalars {
            let find = || least_eigenvalue(self.exact, scalar, &[], &self.limits);
            let found = known.entry(scalar).or_insert_with(find);
            if let Err(why) = found {
                let why = complaint(format!("the full model: {why}"));
                return Err(ToleranceError::Indefinite(why));
            }
        }
        Ok(())
    }

    fn draft(&self, emitted: &Program) -> Certificate {
        Certificate {
            scene: self.setup.scene().map(SceneKey::new),
            relative_to: Some(self.relative_to),
            reached: self.reached.clone(),
            ..Certificate::draft(self.exact, emitted, &self.limits, &self.scales)
        }
    }

    /// Returns the exact program's certificates, whatever they come to.
    pub fn unedited(&self, scalars: &[ScalarType], bound_effort: BoundEffort) -> Admitted {
        self.certified(self.exact, &[], scalars, &[], bound_effort)
    }

    fn certified(
        &self,
        emitted: &Program,
        left_out: &[Omission],
        scalars: &[ScalarType],
        tolerances: &[f64],
        bound_effort: BoundEffort,
    ) -> Admitted {
        let tell = |done| {
            let rounds = [done, 1 + scalars.len()];
            self.watch
                .step(Part::Bounds, rounds, Some(emitted.counts()));
        };
        tell(0);
        let draft = self.draft(emitted);
        let sensitivity = self.sensitivity(emitted, bound_effort);
        let limits = self.left(&draft, scalars, tolerances, &sensitivity);
        let model = draft.model(&limits, bound_effort);
        let certificate = |(index, &scalar)| {
            tell(1 + index);
            draft.clone().bounded(scalar, &model, &sensitivity)
        };
        let certificates = scalars.iter().enumerate().map(certificate);
        Admitted {
            exact: self.exact.clone(),
            program: emitted.clone(),
            left_out: left_out.to_vec(),
            certificates: certificates.collect(),
        }
    }

    fn left(
        &self,
        draft: &Certificate,
        scalars: &[ScalarType],
        tolerances: &[f64],
        sensitivity: &Sensitivity,
    ) -> Vec<f64> {
        let mut left = tolerances.to_vec();
        for &scalar in scalars {
            let rounding = draft.rounding(scalar, sensitivity).into_iter();
            for ((left, t), rounding) in left.iter_mut().zip(tolerances).zip(rounding) {
                *left = left.min(t * (1.0 - 1e-14) - rounding.total());
            }
        }
        let pairs = left.iter().zip(&self.scales);
        pairs.map(|(left, scale)| left * scale).collect()
    }

    /// Returns a variant with bounds as coarse as shows that it is within the tolerances; if
    /// nothing does, with the finest.
    ///
    /// # Errors
    /// A program that is not of the function, or reads what it may not.
    pub fn shown(
        &self,
        emitted: &Program,
        left_out: &[Omission],
        scalars: &[ScalarType],
        tolerances: &[f64],
    ) -> Result<Admitted, Complaint> {
        self.draft(emitted).check(self.setup)?;
        let certified = |effort| self.certified(emitted, left_out, scalars, tolerances, effort);
        let coarse = certified(BoundEffort::QUICK);
        Ok(
            match coarse.within(tolerances).is_ok() && coarse.is_definite() {
                true => coarse,
                false => certified(BoundEffort::CERTIFY),
            },
        )
    }

    /// Returns the cheapest variant found of which every output in every scalar is
    /// certified to stay within its tolerance. `from` are programs that others found for smaller
    /// tolerances: it is never dearer than the first of them.
    ///
    /// # Errors
    /// [`ToleranceError::Above`] if the exact program is not;
    /// [`ToleranceError::Indefinite`] if its D cannot be shown to be positive definite;
    /// [`ToleranceError::Refused`] beyond the work of the settings.
    pub fn choose(
        &self,
        from: &[Program],
        tolerances: &[f64],
        scalars: &[ScalarType],
        settings: &PruneSettings,
        bound_effort: BoundEffort,
    ) -> Result<Admitted, ToleranceError> {
        let meter = Meter::new(settings.work);
        let spent = || match settings.work {
            Some(limit) if meter.is_over() => {
                let scene = self.setup.scene().map_or("", |scene| &scene.name);
                Err(ToleranceError::Refused(complaint(format!(
                    "the search for a program within the tolerance was stopped: it takes too long \
                     for a compilation (more than {limit} units of work). Run `dalembert generate \
                     ROBOT.toml --scene {scene} --effort thorough --save-plan` once: macro and \
                     build script then take the program from its plan"
                ))))
            }
            _ => Ok(()),
        };
        let unedited = self.unedited(scalars, bound_effort);
        unedited.within(tolerances)?;
        self.definite(scalars)?;
        spent()?;
        let mut start: Option<Option<Program>> = None;
        let mut models: Option<Vec<Program>> = None;
        for aside in [2.0, 8.0] {
            let Some(allowances) = self.allowances(tolerances, scalars, aside, bound_effort) else {
                break;
            };
            let target = Target {
                exact: self.exact,
                limits: &self.limits,
                allowances: &allowances,
                settings,
                watch: self.watch,
            };
            let start = start.get_or_insert_with(|| regrouping::descend(self.setup, target));
            let starts = Starts {
                setup: self.setup,
                target,
                equal: start.as_ref(),
            };
            let found = starts.pruned(from, &mut models);
            spent()?;
            if found.is_empty() {
                break;
            }
            for Pruned {
                stages, program, ..
            } in found
            {
                let left_out = omissions(&stages);
                let variant =
                    self.certified(&program, &left_out, scalars, tolerances, bound_effort);
                if variant.within(tolerances).is_ok() && variant.is_definite() {
                    return Ok(variant);
                }
            }
            if self.watch.is_over() {
                break;
            }
        }
        Ok(unedited)
    }

    /// Returns a variant with polynomials for its sines: the cheapest that what edits
    /// and rounding leave of the tolerances admits; as it is if it has no sines.
    ///
    /// # Errors
    /// Why there are none.
    pub fn with_polynomials(
        &self,
        certificate: &Certificate,
        tolerances: &[f64],
        bound_effort: BoundEffort,
    ) -> Result<Certificate, Complaint> {
        let Certificate {
            emitted, scalar, ..
        } = certificate;
        if emitted.trig().is_empty() {
            return Ok(certificate.clone());
        }
        // The values that rounding is bounded with change a little.
        let left = certificate.bounds.iter().zip(tolerances);
        let left = left.map(|(bound, t)| (t - bound.model - 1.01 * bound.rounding) * (1.0 - 1e-9));
        let allowances: Vec<f64> = left
            .zip(&self.scales)
            .map(|(left, scale)| (left * scale).max(0.0))
            .collect();
        let sensitivity = self.sensitivity(emitted, bound_effort);
        let positions = self.limits.sine_positions(self.setup.robot(), *scalar);
        // A tolerance may admit more than D bears.
        for part in [1.0, 0.1, 0.01] {
            let allowances: Vec<f64> = allowances.iter().map(|allowed| allowed * part).collect();
            let sines = sines::within(emitted, *scalar, &positions, &allowances, &sensitivity)?;
            let found = certificate.with_sines(&sines, &sensitivity);
            within(&found, tolerances).map_err(|why| complaint(why.to_string()))?;
            if found.lambda_min.is_some() || !has_inertia(emitted) {
                return Ok(found);
            }
        }
        let why = "with their errors D cannot be shown to be positive definite";
        Err(complaint(why))
    }

    /// Returns a variant of which another program is emitted that is the same function: its
    /// roundings are bounded anew, the edits' bounds stay.
    ///
    /// # Errors
    /// [`ToleranceError::Above`], as of any variant.
    pub fn with_emitted(
        &self,
        certificate: &Certificate,
        emitted: &Program,
        tolerances: &[f64],
        bound_effort: BoundEffort,
    ) -> Result<Certificate, ToleranceError> {
        let sensitivity = self.sensitivity(emitted, bound_effort);
        let own = Certificate {
            emitted: emitted.clone(),
            ..certificate.clone()
        };
        let found = own.with_sines(&own.sines, &sensitivity);
        within(&found, tolerances)?;
        Ok(found)
    }

    fn allowances(
        &self,
        tolerances: &[f64],
        scalars: &[ScalarType],
        aside: f64,
        bound_effort: BoundEffort,
    ) -> Option<Vec<f64>> {
        let pairs = self.scales.iter().zip(tolerances);
        let whole: Vec<f64> = pairs.map(|(scale, t)| scale * t).collect();
        let mut allowances = whole.clone();
        let sensitivity = self.sensitivity(self.exact, bound_effort);
        for &scalar in scalars {
            let costs = sensitivity.rounding(scalar, &[]);
            for ((left, whole), cost) in allowances.iter_mut().zip(&whole).zip(&costs) {
                let rest = whole - aside * cost.total();
                *left = left.min(rest).max(0.0);
            }
        }
        let some = allowances.iter().any(|&left| left > 0.0);
        some.then_some(allowances)
    }
}
