//! The exact program of a function over its box, as the checker sees it.

use std::sync::OnceLock;

use dalembert_checker::Fault;
use dalembert_checker::domain::Domain;
use dalembert_checker::identity::exact::Exact;
use dalembert_checker::polynomial::Polynomial;
use dalembert_checker::program as checked;
use dalembert_model::diagnostic::Diagnostic;
use dalembert_model::robot::write;
use dalembert_model::scene::{self, Scene};

use super::search::PARTS;
use super::turning::AxisLosses;
use super::{definite, work};
use crate::claim::{ConstantTable, claimed};
use crate::function::Argument;
use crate::program::{Program, has_inertia};
use crate::setup::Setup;
use crate::sincos::AngleKernel;

/// If the engine runs out of work, climbs may reach this part of the allowed error: the checker, which may
/// take longer, mostly shows such a program.
const OPEN: f64 = 0.8;
/// A state whose error is at least this part of what is allowed joins the samples.
const LARGE: f64 = 0.97;

pub(crate) struct Engine {
    pub(super) domain: Domain,
    exact: Vec<Polynomial>,
    /// The exact program, if it has D.
    inertia: Option<Program>,
    is_shown: OnceLock<bool>,
    turning: Option<AxisLosses>,
}

/// The engine's finding about a program.
pub(super) struct Verdict {
    /// `true` if every result is shown to be as near as is allowed, or seems to be.
    pub(super) is_within: bool,
    /// The largest error that was found, relative to the allowed one; if the engine ran out of work, to
    /// [`OPEN`] of that.
    pub(super) ratio: f64,
    /// `true` if no error above the allowed one was found.
    pub(super) is_open: bool,
    /// Positions where results are about as far off as they may be, or further.
    pub(super) positions: Vec<Vec<f64>>,
}

/// Returns the file of a robot in its scene; a base that is locked, gravity, payload and box are in the
/// robot already.
pub(super) fn source(setup: &Setup) -> (String, Option<Scene>) {
    let scene = setup.scene().map(|scene| Scene {
        lock_base: false,
        gravity: None,
        payload: None,
        payload_link: None,
        bounds: Default::default(),
        ..scene.clone()
    });
    let table = scene.as_ref().map_or_else(String::new, scene::write);
    let source = format!("{}\n{table}", write(setup.robot()));
    (source, scene)
}

fn refused(fault: Fault) -> Diagnostic {
    Diagnostic::error(fault.to_string())
}

/// Reads a program as the checker has it.
pub(super) fn read(program: &Program) -> Result<checked::Program<Exact>, Diagnostic> {
    let mut constants = ConstantTable::default();
    let claim = claimed(program, None, &mut constants);
    let document = constants.document(Vec::new());
    let constants = document.constants(&Default::default()).map_err(refused)?;
    claim.program(&constants).map_err(refused)
}

impl Engine {
    /// Writes an exact program out over the box of its robot.
    pub(super) fn new(
        setup: &Setup,
        exact: &Program,
        load: Option<&Program>,
    ) -> Result<Engine, Diagnostic> {
        let domain = domain(setup, exact, load)?;
        let inertia = has_inertia(exact).then(|| exact.clone());
        let exact = domain.write(&read(exact)?, None).map_err(refused)?;
        Ok(Engine {
            domain,
            exact,
            inertia,
            is_shown: OnceLock::new(),
            turning: AxisLosses::new(setup.robot()),
        })
    }

    /// Decides whether a program is as near to the exact one as is allowed, in real numbers.
    pub(super) fn judge(&self, program: &Program, allowed: &[f64]) -> Verdict {
        let mut verdict = Verdict {
            is_within: true,
            ratio: 0.0,
            is_open: true,
            positions: Vec::new(),
        };
        let Ok(differences) = self.differences(program) else {
            (verdict.is_within, verdict.is_open) = (false, false);
            return verdict;
        };
        for (difference, allowed) in differences.iter().zip(allowed) {
            let (decision, position) = self.domain.decide(difference, *allowed);
            work::count(decision.steps as usize / work::UNIT);
            let part = if decision.is_open { OPEN } else { 1.0 };
            let most = part * allowed;
            verdict.is_within &= decision.is_shown || decision.is_open && decision.reached <= most;
            verdict.is_open &= decision.is_shown || decision.is_open;
            let ratio = decision.reached / most.max(f64::MIN_POSITIVE);
            verdict.ratio = verdict.ratio.max(ratio);
            if ratio > LARGE && !position.is_empty() {
                verdict.positions.push(position);
            }
        }
        // With a payload all errors count, which the checker bounds.
        if verdict.is_within && !self.is_loaded() {
            verdict.is_within = self.is_definite(program, &[], None, allowed);
        }
        verdict
    }

    fn is_loaded(&self) -> bool {
        let mut exact = self.inertia.iter();
        exact.any(|exact| exact.arguments.contains(&Argument::Load))
    }

    /// Returns true if D of a program is shown to be positive definite, with these sines, or the function
    /// has no D. Its entries have errors of rounding, if they are known; all errors together are at most
    /// these.
    ///
    /// A payload only adds to D, but the box of its numbers has some that no body has: so it is the exact
    /// D without a payload that counts, with all errors.
    pub(super) fn is_definite(
        &self,
        program: &Program,
        sines: &[AngleKernel],
        rounding: Option<&[f64]>,
        errors: &[f64],
    ) -> bool {
        let Some(exact) = &self.inertia else {
            return true;
        };
        if self.is_borne(program, errors) {
            return true;
        }
        let domain = self.domain.without_payload();
        let engine = |program, sines, off| definite::is_definite(domain, program, sines, off);
        self.is_shown()
            && match self.is_loaded() {
                true => {
                    definite::inertia_place(program).is_some() && engine(exact, &[], Some(errors))
                }
                false => program == exact && sines.is_empty() || engine(program, sines, rounding),
            }
    }

    /// Returns true if D of a program that the search finds may be shown to be positive definite, or the
    /// function has no D.
    pub(super) fn may_be_definite(&self, allowed: &[f64]) -> bool {
        let least: Vec<f64> = allowed.iter().map(|most| PARTS[0] * most).collect();
        let is_borne = |exact| self.is_borne(exact, &least);
        self.inertia.as_ref().is_none_or(is_borne) || self.is_shown()
    }

    /// Returns true if the engine shows that the exact D is positive definite: otherwise it shows it of
    /// no other.
    fn is_shown(&self) -> bool {
        let domain = self.domain.without_payload();
        let shows = |exact| definite::is_definite(domain, exact, &[], None);
        let decide = || self.inertia.as_ref().is_some_and(shows);
        *self.is_shown.get_or_init(decide)
    }

    fn is_borne(&self, program: &Program, errors: &[f64]) -> bool {
        let Some((turning, first)) = self.turning.as_ref().zip(definite::inertia_place(program))
        else {
            return false;
        };
        let n = program.rows.len();
        // Both halves are the same values: either bound holds.
        turning.bears(&program.rows, |i, j| {
            errors[first + i.max(j) * n + i.min(j)]
        })
    }

    /// Returns about how far off the results of a program are at most, in real numbers.
    pub(super) fn reached(&self, program: &Program) -> Result<Vec<f64>, Diagnostic> {
        let differences = self.differences(program)?;
        let reached = |difference| self.domain.decide(difference, 0.0).0.reached;
        Ok(differences.iter().map(reached).collect())
    }

    /// Writes out what a program, which has the results of the exact one, differs by from that.
    fn differences(&self, program: &Program) -> Result<Vec<Polynomial>, Diagnostic> {
        let written = self.domain.write(&read(program)?, None).map_err(refused)?;
        let difference = |(x, exact): (&Polynomial, &Polynomial)| x.plus(&exact.negated());
        Ok(written.iter().zip(&self.exact).map(difference).collect())
    }
}

/// Returns the box of a function's states.
pub(crate) fn domain(
    setup: &Setup,
    program: &Program,
    load: Option<&Program>,
) -> Result<Domain, Diagnostic> {
    let (source, scene) = source(setup);
    let names = program.arguments.iter().map(|argument| argument.name());
    let arguments: Vec<&str> = names.collect();
    let load = load.map(read).transpose()?;
    let name = scene.as_ref().map(|scene| scene.name.as_str());
    Domain::read(&source, name, &arguments, load.as_ref()).map_err(refused)
}
