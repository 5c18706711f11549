//! A function under a tolerance: what each result may be off, and the cheapest variant of it.
//!
//! Rounding of the exact program is set aside first, and the search may use the rest. The checker
//! bounds what comes out, text and all, and only that decides: what it refuses gives way to the next
//! candidate, and in the end nothing is left out.

use dalembert_checker::Fault;
use dalembert_checker::certify::{Demand, certify};
use dalembert_model::diagnostic::Diagnostic;
use dalembert_model::scene::{Scale, Tolerance};

use super::claim::claim_in;
use super::definite;
use super::input_box::InputBox;
use super::overflow::overflows;
use super::reference::{self, Engine};
use super::refusals::{not_shown, unbounded_by};
use super::search::{self, SearchEffort, Target};
use super::sines::{self, Slopes};
use super::variant::{Variant, VariantSet};
use super::work::Meter;
use super::{scale, shape};
use crate::function::Argument;
use crate::program::{Library, Program, ScalarType};
use crate::setup::Setup;
use crate::sincos::AngleKernel;
use crate::sincos::interval::Interval;
use crate::states::JointState;
use crate::task::{GenerateError, Miss};
use crate::watch::{FunctionWatch, Part};

/// Rounding of the exact program is set aside so many times: the variant is another program.
const ASIDE: f64 = 2.0;
/// The part of a result's tolerance that is not used: bounds are shown up to so little.
const MARGIN: f64 = 3e-3;
/// The candidates of a search that the checker is asked about.
const CANDIDATES: usize = 6;
/// The parts of what edits and rounding leave that polynomials for sines may use.
const PARTS: [f64; 5] = [1.0, 0.5, 0.2, 0.05, 0.01];
/// An error may be larger than what climbs reach by this part.
const REACHED: f64 = 1e-3;

/// A function, its box, and what errors are relative to.
pub struct Budget<'a> {
    /// The full model.
    pub setup: &'a Setup,
    pub exact: &'a Program,
    /// The box in which bounds hold.
    pub limits: InputBox,
    /// T of each result, or just below.
    pub scales: Vec<f64>,
    pub relative_to: Scale,
    reached: Vec<JointState>,
    /// The function that makes the load, where a payload is an argument of this one.
    load: Option<&'a Program>,
    reference: Engine,
    /// The library whose sines code calls.
    pub(crate) library: Library,
    /// `true` if products are fused.
    pub(crate) is_fused: bool,
}

/// The tolerance of each result, relative to T.
pub struct Tolerances {
    per_result: Vec<f64>,
    /// The tolerance of all, if it is not the scene's.
    one: Option<f64>,
}

impl<'a> Budget<'a> {
    /// Returns the box of a robot in its scene, and T over it. `load` makes the load of a payload, if
    /// that is an argument.
    ///
    /// # Errors
    /// [`Miss::Refused`]: a function without bounds, a limit that is missing, or actuators
    /// that are no measure of it.
    pub fn new(
        setup: &'a Setup,
        exact: &'a Program,
        load: Option<&'a Program>,
        relative_to: Scale,
    ) -> Result<Budget<'a>, GenerateError> {
        let refused = |why| GenerateError::Tolerance(exact.function, Miss::Refused, why);
        unbounded_by(exact).map_or(Ok(()), |why| Err(refused(why)))?;
        let mut limits = InputBox::within(setup, exact.function).map_err(refused)?;
        let load = load.filter(|_| exact.arguments.contains(&Argument::Load));
        let reference = Engine::new(setup, exact, load).map_err(refused)?;
        let ranges = reference.domain.load().iter();
        let range = ranges.map(|ends| Interval::new(ends[0], ends[1]).unwrap_or(Interval::ALL));
        limits.load = range.collect();
        let (scales, reached) = match relative_to {
            Scale::Actuator => {
                let scales = scale::actuator(setup.robot(), exact);
                (scales.map_err(refused)?, Vec::new())
            }
            Scale::Range => scale::range(exact, load, &limits).into_iter().unzip(),
        };
        Ok(Budget {
            reference,
            setup,
            exact,
            load,
            limits,
            scales,
            relative_to,
            reached,
            library: Library::Libm,
            is_fused: false,
        })
    }

    pub fn allowed(&self, tolerance: &Tolerance) -> Tolerances {
        Tolerances {
            per_result: scale::tolerances(self.exact, tolerance),
            one: None,
        }
    }

    pub fn all_allowed(&self, tolerance: f64) -> Tolerances {
        Tolerances {
            per_result: vec![tolerance; self.scales.len()],
            one: Some(tolerance),
        }
    }

    fn missed(&self, miss: Miss, why: Diagnostic) -> GenerateError {
        GenerateError::Tolerance(self.exact.function, miss, why)
    }

    fn definite(&self) -> Result<(), GenerateError> {
        let none = vec![0.0; self.scales.len()];
        if self.reference.is_definite(self.exact, &[], None, &none) {
            return Ok(());
        }
        let why = definite::indefinite(self.exact, &self.limits);
        let message = format!("the full model: {why}");
        Err(self.missed(Miss::Indefinite, Diagnostic::error(message)))
    }

    /// Returns a program as it is printed in a scalar, with the bounds that the checker finds.
    ///
    /// # Errors
    /// [`Miss::Above`] if the checker does not show that every result is within its
    /// tolerance; [`Miss::Overflow`]; [`Miss::Indefinite`] if its D, if it has one,
    /// is not shown to be positive definite.
    pub fn shown(
        &self,
        program: &Program,
        scalar: ScalarType,
        sines: &[AngleKernel],
        allowed: &Tolerances,
    ) -> Result<Variant, GenerateError> {
        let printed = |program: &Program| match self.is_fused {
            true => program.fused(),
            false => program.clone(),
        };
        let emitted = printed(program);
        let wider = scalar.of("", ", or choose a wider scalar");
        // Bounds of rounding are of numbers that the scalar holds.
        if let Some(first) = overflows(&emitted, scalar, &self.limits).first() {
            let why = format!(
                "inside the box {first} in {scalar}, and an overflow has no error bound: \
                 bound the box, choose other units{wider}"
            );
            return Err(self.missed(Miss::Overflow, Diagnostic::error(why)));
        }
        let draft = Variant {
            scalar,
            limits: self.limits.clone(),
            relative_to: self.relative_to,
            reached: self.reached.clone(),
            exact: self.exact.clone(),
            emitted,
            text: String::new(),
            load: self.load.map(printed),
            // Polynomials call nothing.
            library: match sines {
                [] => self.library,
                _ => Library::Libm,
            },
            sines: sines.to_vec(),
            scales: Vec::new(),
            bounds: Vec::new(),
        };
        let variant = self.bounded(draft.printed(), allowed.one)?;
        if variant.emitted != *self.exact || !sines.is_empty() {
            let rounding = variant.in_units(|bound| bound.rounding);
            let (reference, errors) = (&self.reference, variant.errors());
            if !reference.is_definite(program, sines, Some(&rounding), &errors) {
                let why =
                    Diagnostic::error("with its errors D cannot be shown to be positive definite");
                return Err(self.missed(Miss::Indefinite, why));
            }
        }
        Ok(variant)
    }

    /// Returns a variant with T and the bounds that the checker finds: those that `generate` writes are
    /// those that `certify` finds. A `tolerance` takes the place of the scene's.
    fn bounded(&self, draft: Variant, tolerance: Option<f64>) -> Result<Variant, GenerateError> {
        let (robot, (source, scene)) = (self.setup.robot(), reference::source(self.setup));
        let claim = claim_in(robot, &source, self.setup, scene.as_ref(), &draft).write();
        let demand = Demand {
            scene: scene.as_ref().map(|scene| scene.name.as_str()),
            tolerance,
            worst: None,
        };
        let name = draft.emitted.function.name();
        let certified = || {
            let mut results = None;
            // A fault of any line, such as the load's, refuses the draft.
            for line in certify(&draft.with_load(), &claim, &source, &demand)?.lines {
                let findings = line.result?;
                if line.name == name && results.is_none() {
                    results = Some(findings.results);
                }
            }
            results.ok_or_else(|| Fault::Claim("the function is not in the file".into()))
        };
        let results =
            certified().map_err(|fault| self.missed(Miss::Above, not_shown(&draft, &fault)))?;
        Ok(Variant {
            bounds: results.iter().map(|bound| bound.relative()).collect(),
            scales: results.iter().map(|bound| bound.scale).collect(),
            ..draft
        })
    }

    /// Returns a program in several scalars, as [`shown`](Self::shown).
    pub fn admitted(
        &self,
        program: &Program,
        scalars: &[ScalarType],
        allowed: &Tolerances,
    ) -> Result<VariantSet, GenerateError> {
        let shown = |&scalar: &ScalarType| self.shown(program, scalar, &[], allowed);
        Ok(VariantSet {
            variants: scalars.iter().map(shown).collect::<Result<_, _>>()?,
            exact: self.exact.clone(),
            program: program.clone(),
        })
    }

    /// Returns the exact program in several scalars. If it cannot be shown that its D, if it has one, is
    /// positive definite, no variant's can.
    pub fn unedited(
        &self,
        scalars: &[ScalarType],
        allowed: &Tolerances,
    ) -> Result<VariantSet, GenerateError> {
        self.definite()?;
        self.admitted(self.exact, scalars, allowed)
    }

    /// Returns a plan's variant, as [`admitted`](Self::admitted). A plan is a text that anybody can edit:
    /// a program that is not of the function, or reads what it may not, is refused by itself.
    pub(crate) fn planned(
        &self,
        program: &Program,
        scalars: &[ScalarType],
        allowed: &Tolerances,
    ) -> Result<Result<VariantSet, GenerateError>, Diagnostic> {
        shape::check(self.setup, program, self.exact)?;
        Ok(self.admitted(program, scalars, allowed))
    }

    /// Returns the cheapest variant found of which every result in every scalar is shown to be
    /// within its tolerance: if none is found, `exact`, the variants of the exact program. `from` are
    /// programs that others found for smaller tolerances: it is never dearer than they are.
    ///
    /// # Errors
    /// [`Miss::Refused`] beyond the work of the effort.
    pub fn choose(
        &self,
        from: &[Program],
        exact: VariantSet,
        allowed: &Tolerances,
        effort: &SearchEffort,
        watch: FunctionWatch<'_>,
    ) -> Result<VariantSet, GenerateError> {
        let meter = Meter::new(effort.work);
        let variants = exact.variants.iter();
        let scalars: Vec<ScalarType> = variants.map(|variant| variant.scalar).collect();
        let allowances = self.allowances(&exact, allowed);
        let mut programs = Vec::new();
        if allowances.iter().any(|allowance| *allowance > 0.0)
            && self.reference.may_be_definite(&allowances)
        {
            let target = Target {
                setup: self.setup,
                exact: self.exact,
                reference: &self.reference,
                limits: &self.limits,
                allowances: &allowances,
                effort,
                watch,
                meter,
            };
            programs = search::programs(target, from);
        }
        if let Some(limit) = effort.work.filter(|_| meter.is_over()) {
            let scene = self.setup.scene().map_or("", |scene| &scene.name);
            return Err(self.missed(Miss::Refused, Diagnostic::error(format!(
                "the search for a program within the tolerance was stopped: it takes too long for \
                 a compilation (more than {limit} units of work). Run `dalembert generate \
                 ROBOT.toml --scene {scene} --effort thorough --save-plan` once: macro and build \
                 script then take the program from its plan"
            ))));
        }
        let mut candidates = programs.iter().take(CANDIDATES).enumerate();
        let shown = candidates.find_map(|(index, program)| {
            watch.step(Part::Bounds, [index, CANDIDATES], Some(program.counts()));
            self.admitted(program, &scalars, allowed).ok()
        });
        Ok(shown.unwrap_or(exact))
    }

    /// Returns a variant with polynomials for its sines: the cheapest that what edits and rounding leave
    /// of the tolerances admits; as it is if it has no sines.
    pub fn with_polynomials(
        &self,
        program: &Program,
        variant: &Variant,
        allowed: &Tolerances,
    ) -> Result<Variant, Diagnostic> {
        if program.trig().is_empty() {
            return Ok(variant.clone());
        }
        // A bound is as large as is allowed: what is left is seen from what errors reach.
        let reached = self.reference.reached(program)?;
        let unused = |(i, reached): (usize, f64)| {
            let part = allowed.per_result[i] - 1.01 * variant.bounds[i].rounding;
            (part * variant.scales[i] - reached * (1.0 + REACHED)).max(0.0)
        };
        let left: Vec<f64> = reached.into_iter().enumerate().map(unused).collect();
        let slopes = Slopes::new(program, &self.limits);
        let scalar = variant.scalar;
        let positions = self.limits.sine_positions(self.setup.robot(), scalar);
        let mut last: Option<Diagnostic> = None;
        for part in PARTS {
            let allowances: Vec<f64> = left.iter().map(|remainder| remainder * part).collect();
            let sines = sines::within(program, scalar, &positions, &allowances, &slopes);
            let sines = match (sines, last) {
                (Err(_), Some(why)) => return Err(why),
                (sines, _) => sines?,
            };
            match self.shown(program, scalar, &sines, allowed) {
                Ok(replacement) => return Ok(replacement),
                Err(why) => last = Some(Diagnostic::error(why.to_string())),
            }
        }
        Err(last.unwrap_or_else(|| Diagnostic::error("no part of the tolerance is left")))
    }

    fn allowances(&self, exact: &VariantSet, allowed: &Tolerances) -> Vec<f64> {
        let left = |index: usize| {
            let most = (1.0 - MARGIN) * allowed.per_result[index];
            let allowances = exact.variants.iter().map(|variant| {
                (most - ASIDE * variant.bounds[index].rounding) * variant.scales[index]
            });
            allowances.fold(f64::INFINITY, f64::min).max(0.0)
        };
        (0..self.scales.len()).map(left).collect()
    }
}
