//! A program in the place of an exact one, as it is printed in a scalar, with its bounds.

use dalembert_checker::Fault;
use dalembert_checker::certify::Bound;
use dalembert_model::robot::Robot;
use dalembert_model::scene::Scale;

use super::input_box::{InputBox, turns_freely};
use super::sample::draw;
use crate::language::function;
use crate::language::read::Signature;
use crate::program::{Code, Library, Program, ScalarType};
use crate::random::Random;
use crate::sincos::interval::Interval;
use crate::sincos::{AngleKernel, Sines};
use crate::states::JointState;
use crate::verify::exact::prove_same;

/// A function under a tolerance, in one scalar.
#[derive(Clone, Debug, PartialEq)]
pub struct Variant {
    pub scalar: ScalarType,
    /// The box in which the bounds hold.
    pub limits: InputBox,
    pub relative_to: Scale,
    /// If that is the range, states at which the results reach it.
    pub reached: Vec<JointState>,
    pub exact: Program,
    /// The program that is emitted, with exact constants.
    pub emitted: Program,
    pub text: String,
    /// The function that makes the load of a payload, where this one takes it.
    pub load: Option<Program>,
    /// The library of sines that are called.
    pub library: Library,
    /// The polynomials for its sines; none if they are called.
    pub sines: Sines,
    /// T of each result, in its unit.
    pub scales: Vec<f64>,
    /// E of each result.
    pub bounds: Vec<Bound>,
}

impl Variant {
    /// Returns the positions of a joint of this robot for which it holds; `None` for all. If a
    /// joint [turns freely](turns_freely), one turn is bounded and its sine reaches further.
    pub fn positions(&self, robot: &Robot, joint: usize) -> Option<Interval> {
        if !turns_freely(robot, joint) {
            return self.limits.position.get(joint).copied();
        }
        let sine = self.sines.iter().find(|sine| sine.joint == joint);
        sine.map(|sine| sine.range)
    }

    #[must_use]
    pub fn printed(self) -> Variant {
        let text = self.text_of(&self.emitted, self.library, &self.sines);
        Variant { text, ..self }
    }

    fn text_of(&self, program: &Program, library: Library, sines: &[AngleKernel]) -> String {
        let code = program.code(self.scalar, library, sines);
        function::write(program, &code, library, &[])
    }

    fn load_text(&self, load: &Program) -> String {
        self.text_of(load, Library::Libm, &[])
    }

    /// Returns its text, behind that of the function that makes its load.
    pub(super) fn with_load(&self) -> String {
        match &self.load {
            Some(load) => self.load_text(load) + "\n" + &self.text,
            None => self.text.clone(),
        }
    }

    /// Returns the function that makes its load, as it is printed.
    pub(crate) fn loading(&self) -> Result<Option<Code>, Fault> {
        let load = self.load.as_ref().map(|load| {
            let signature = Signature::of(load, self.scalar);
            Code::parse(&self.load_text(load), &signature)
        });
        load.transpose()
    }

    /// Draws a state of the box; `loading` makes the load of its payload.
    pub(crate) fn draw(&self, loading: Option<&Code>, random: &mut Random) -> JointState {
        let mut state = draw(&self.limits, random);
        if let Some(loading) = loading {
            for number in &mut state.payload {
                *number = self.scalar.of(*number, f64::from(*number as f32));
            }
            state.load = loading.run_at(&state);
        }
        state
    }

    pub fn worst(&self) -> f64 {
        let totals = self.bounds.iter().map(|bound| bound.total());
        totals.fold(0.0, f64::max)
    }

    /// Returns E·T of each result.
    pub(crate) fn errors(&self) -> Vec<f64> {
        self.in_units(Bound::total)
    }

    /// Returns a part of the bounds in the results' units.
    pub(super) fn in_units(&self, part: impl Fn(Bound) -> f64) -> Vec<f64> {
        let pairs = self.bounds.iter().zip(&self.scales);
        // Up: the product of two doubles is one of the two next to it.
        let size = |(bound, scale): (&Bound, &f64)| match *scale == 0.0 {
            true => part(*bound),
            false => (part(*bound) * scale).next_up(),
        };
        pairs.map(size).collect()
    }
}

/// The variants of a function that meet their tolerance.
#[derive(Clone, Debug)]
pub struct VariantSet {
    pub exact: Program,
    /// The program to emit, before its products are fused.
    pub program: Program,
    /// One a scalar, as they were asked for.
    pub variants: Vec<Variant>,
}

impl VariantSet {
    /// Returns true if it is another function than the exact program.
    pub fn is_other(&self) -> bool {
        self.exact != self.program && prove_same(&self.exact, &self.program).is_err()
    }
}
