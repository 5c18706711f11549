//! The box of a function's states: programs as polynomials over it.

use crate::fault::Fault;
use crate::identity::exact::Exact;
use crate::identity::robot;
use crate::interval::Interval;
use crate::load::load_of_point;
pub use crate::maximum::corners;
use crate::maximum::{self, Decision};
use crate::polynomial::Polynomial;
use crate::program::{LOAD, Program, argument};
use crate::ring::Ring;
use crate::rounding::Ranges;
use crate::work::Work;
use crate::written::PolynomialProgram;

/// The multiplications for a decision.
const PURSE: u64 = 50_000_000;

/// The states of a robot, in a scene or by itself, that a function takes.
pub struct Domain {
    ring: Ring,
    load: Vec<[f64; 2]>,
    /// These states without a payload, where there may be one.
    bare: Option<Box<Domain>>,
}

impl Domain {
    /// Reads a robot file; the function has these arguments; another makes the load, of a
    /// payload alone.
    ///
    /// # Errors
    /// A robot file, a scene or an argument that is not known; a joint without limits.
    pub fn read(
        source: &str,
        scene: Option<&str>,
        arguments: &[&str],
        load: Option<&Program<Exact>>,
    ) -> Result<Domain, Fault> {
        let of_robot = |why: String| Fault::Robot("file".into(), why);
        let file = robot::read(source).map_err(of_robot)?;
        let mut setting = file.setting(scene).map_err(of_robot)?;
        setting.loading = load.iter().filter_map(|_| argument("payload")).collect();
        let places: Option<Vec<usize>> = arguments.iter().map(|name| argument(name)).collect();
        let unknown = || Fault::Claim("an argument that is not known".into());
        let (mut ranges, _) = setting.loaded_box(&places.ok_or_else(unknown)?, false, load)?;
        let without_load = |ranges: &Ranges| -> Result<Domain, Fault> {
            let ring = Ring::new(&setting, ranges, &Work::default())?;
            let (load, bare) = (Vec::new(), None);
            Ok(Domain { ring, load, bare })
        };
        let mut domain = without_load(&ranges)?;
        if let (Some(load), Some(place)) = (load, argument(LOAD)) {
            let bare = load_of_point(load, 0.0, [0.0; 3])?
                .into_iter()
                .map(Interval::ends);
            domain.load = std::mem::replace(&mut ranges[place], bare.collect());
            domain.bare = Some(Box::new(without_load(&ranges)?));
        }
        Ok(domain)
    }

    /// Returns the ranges of the load's numbers.
    pub fn load(&self) -> &[[f64; 2]] {
        &self.load
    }

    /// Returns these states without a payload.
    pub fn without_payload(&self) -> &Domain {
        self.bare.as_deref().unwrap_or(self)
    }

    /// Returns the results of a program. The errors of sines, or else of cosines, of a joint are
    /// variables.
    ///
    /// # Errors
    /// A program that divides, or has more terms than are written out.
    pub fn write(
        &self,
        program: &Program<Exact>,
        errors: Option<&dyn Fn(usize, bool) -> Option<f64>>,
    ) -> Result<Vec<Polynomial>, Fault> {
        let written = PolynomialProgram::new(program, &self.ring, errors, &Work::default())?;
        Ok(written.outputs)
    }

    /// Decides whether a magnitude is at most `wanted`, and returns a position where it is large, if one
    /// was looked at; behind it stands gravity in the axes of a base that floats.
    pub fn decide(&self, polynomial: &Polynomial, wanted: f64) -> (Decision, Vec<f64>) {
        let decision = maximum::decide(polynomial, &self.ring, wanted, PURSE);
        let mut position = self.ring.positions(&decision.angles);
        position.extend(self.ring.gravity(&decision.angles));
        (decision, position)
    }

    /// Returns true if a symmetric matrix is shown to be positive definite at every state; its lower
    /// triangle is given row by row, and how far each entry may be off.
    pub fn is_definite(&self, entries: &[Polynomial], errors: &[f64]) -> bool {
        maximum::is_definite(entries, errors, &self.ring)
    }
}
