//! Runs lowered code bit for bit: fused multiply-adds where the code has them and
//! nowhere else, the library's sine and cosine or the code's polynomials, the
//! scalar's own rounding.

use super::machine::Machine;
use super::{AngleSum, Input, Library, Literal, Lowered, LoweredTrig, ScalarType, evaluate};
use crate::function::Argument;
use crate::states::JointState;

/// The arguments of a run: one value a joint; those that the function does not
/// read may be empty.
#[derive(Clone, Copy, Debug)]
pub struct State<'a, T> {
    arguments: [&'a [T]; Argument::COUNT],
}

impl<'a, T> State<'a, T> {
    /// Makes a state from the entries of each argument.
    pub fn of(entries: impl FnMut(Argument) -> &'a [T]) -> State<'a, T> {
        State {
            arguments: Argument::ALL.map(entries),
        }
    }

    /// Returns the entries of an argument.
    pub fn argument(&self, argument: Argument) -> &'a [T] {
        self.arguments[argument.index()]
    }
}

impl Lowered {
    /// Returns the results at a state, in the order of the function's quantities; none
    /// if the state has no value that is read.
    pub fn run<T: Machine>(&self, state: State<'_, T>) -> Vec<T> {
        let read = self.inputs(state);
        let constant = |value: &Literal| Some(T::literal(value.0));
        evaluate(&self.steps, &self.outputs, read, constant).unwrap_or_default()
    }

    /// Returns the value of each input at a state, if the state has one.
    pub(super) fn inputs<'s, T: Machine>(
        &self,
        state: State<'s, T>,
    ) -> impl Fn(&Input) -> Option<T> + use<'s, T> {
        let mut trig = std::collections::BTreeMap::new();
        for t in &self.trig {
            let (sin, cos) = t.pair(self.library, state.argument(Argument::Position));
            trig.insert(Input::Sin(t.angle), sin);
            trig.insert(Input::Cos(t.angle), cos);
        }
        for speed in &self.speeds {
            let qd = state.argument(Argument::Velocity);
            if let Some(value) = speed.run(qd) {
                trig.insert(Input::PerSpeed(speed.joint), value);
            }
        }
        move |input: &Input| match *input {
            Input::Entry(argument, joint) => state.argument(argument).get(joint).copied(),
            Input::Sin(_) | Input::Cos(_) | Input::PerSpeed(_) => trig.get(input).copied(),
        }
    }

    /// Returns the results at a state rounded to the code's own scalar, as doubles
    /// that hold them exactly.
    pub fn run_at(&self, state: &JointState) -> Vec<f64> {
        match self.scalar {
            ScalarType::F64 => self.run_rounded::<f64>(state),
            ScalarType::F32 => self.run_rounded::<f32>(state),
        }
    }

    fn run_rounded<T: Machine>(&self, state: &JointState) -> Vec<f64> {
        let rounded = |argument: Argument| -> Vec<T> {
            let entries = state.of(argument).iter();
            entries.map(|&x| T::literal(x)).collect()
        };
        let arguments = Argument::ALL.map(rounded);
        let results = self.run(State::of(|argument| &arguments[argument.index()]));
        results.into_iter().map(T::to_f64).collect()
    }
}

impl LoweredTrig {
    /// Returns sine and cosine as the code computes them; of one that it does not
    /// need, whatever.
    pub(super) fn pair<T: Machine>(&self, library: Library, q: &[T]) -> (T, T) {
        let angle = angle_value(self.angle, q);
        match &self.kernel {
            Some(kernel) => kernel.run(angle),
            None => library.pair(angle, self.sin, self.cos),
        }
    }
}

/// Returns q₂ + q₃ as emitted code adds it: from the left.
pub(crate) fn angle_value<T: Machine>(angle: AngleSum, q: &[T]) -> T {
    let mut sum: Option<T> = None;
    for (joint, negative) in angle.terms() {
        sum = Some(match (sum, negative) {
            (None, false) => q[joint],
            (None, true) => q[joint].neg(),
            (Some(sum), false) => sum.add(&q[joint]),
            (Some(sum), true) => sum.sub(&q[joint]),
        });
    }
    sum.unwrap_or_else(|| T::literal(0.0))
}
