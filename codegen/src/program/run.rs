//! Runs lowered code bit for bit: no contraction to fused
//! multiply-add, libm's sine and cosine or the code's polynomials, the scalar's
//! own rounding.

use super::machine::Machine;
use super::{AngleSum, Input, Literal, Lowered, LoweredTrig, ScalarType, evaluate};
use crate::states::JointState;

/// The arguments of a run: one value a joint; rates may be empty where the
/// function does not read them.
#[derive(Clone, Copy, Debug)]
pub struct State<'a, T> {
    /// q
    pub q: &'a [T],
    /// q̇
    pub qd: &'a [T],
    /// q̈
    pub qdd: &'a [T],
}

impl Lowered {
    /// The results at a state, in the order of the function's quantities; none
    /// if the state has no value that is read.
    pub fn run<T: Machine>(&self, state: State<'_, T>) -> Vec<T> {
        let mut trig = std::collections::BTreeMap::new();
        for t in &self.trig {
            let (sin, cos) = t.pair(state.q);
            trig.insert(Input::Sin(t.angle), sin);
            trig.insert(Input::Cos(t.angle), cos);
        }
        let input = |input: &Input| match *input {
            Input::Position(joint) => state.q.get(joint).copied(),
            Input::Velocity(joint) => state.qd.get(joint).copied(),
            Input::Acceleration(joint) => state.qdd.get(joint).copied(),
            Input::Sin(_) | Input::Cos(_) => trig.get(input).copied(),
        };
        let constant = |value: &Literal| Some(T::literal(value.0));
        evaluate(&self.steps, &self.outputs, input, constant).unwrap_or_default()
    }

    /// The results at a state rounded to the code's own scalar, as doubles
    /// that hold them exactly.
    pub fn run_at(&self, state: &JointState) -> Vec<f64> {
        match self.scalar {
            ScalarType::F64 => self.run_rounded::<f64>(state),
            ScalarType::F32 => self.run_rounded::<f32>(state),
        }
    }

    fn run_rounded<T: Machine>(&self, state: &JointState) -> Vec<f64> {
        let rounded = |x: &[f64]| x.iter().map(|&x| T::literal(x)).collect::<Vec<T>>();
        let (q, qd, qdd) = (rounded(&state.q), rounded(&state.qd), rounded(&state.qdd));
        let results = self.run(State {
            q: &q,
            qd: &qd,
            qdd: &qdd,
        });
        results.into_iter().map(T::to_f64).collect()
    }
}

impl LoweredTrig {
    /// Sine and cosine as the code computes them; of one that it does not
    /// need, whatever.
    pub(super) fn pair<T: Machine>(&self, q: &[T]) -> (T, T) {
        let angle = angle_value(self.angle, q);
        match (&self.kernel, self.sin, self.cos) {
            (Some(kernel), ..) => kernel.run(angle),
            (None, true, false) => (angle.sin(), angle),
            (None, false, true) => (angle, angle.cos()),
            (None, ..) => angle.sincos(),
        }
    }
}

/// q₂ + q₃ as emitted code adds it: from the left.
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
