//! Runs an emitted function's text bit for bit: no contraction to fused
//! multiply-add, libm's sine and cosine or the text's polynomials, the scalar's
//! own rounding.

use super::text::{TextOperand, TextProgram, TextTrig};
use crate::graph::{AngleSum, Input};
use crate::schedule::Operation;

/// A float that emitted code runs in.
pub trait Machine: Copy {
    /// The literal's value: exact, since it was parsed in this type.
    fn literal(value: f64) -> Self;
    /// Exact.
    fn to_f64(self) -> f64;
    /// The sine that emitted code calls when it needs no cosine.
    fn sin(self) -> Self;
    /// The cosine that emitted code calls when it needs no sine.
    fn cos(self) -> Self;
    /// Both at once.
    fn sincos(self) -> (Self, Self);
    /// −self
    fn neg(self) -> Self;
    /// One rounded operation.
    fn operate(self, operation: Operation, other: Self) -> Self;
}

macro_rules! machine {
    ($t:ty, $sin:path, $cos:path, $sincos:path) => {
        impl Machine for $t {
            fn literal(value: f64) -> Self {
                value as $t
            }
            fn to_f64(self) -> f64 {
                self.into()
            }
            fn sin(self) -> Self {
                $sin(self)
            }
            fn cos(self) -> Self {
                $cos(self)
            }
            fn sincos(self) -> (Self, Self) {
                $sincos(self)
            }
            fn neg(self) -> Self {
                -self
            }
            fn operate(self, operation: Operation, other: Self) -> Self {
                match operation {
                    Operation::Add => self + other,
                    Operation::Sub => self - other,
                    Operation::Mul => self * other,
                }
            }
        }
    };
}
machine!(f64, libm::sin, libm::cos, libm::sincos);
machine!(f32, libm::sinf, libm::cosf, libm::sincosf);

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

impl TextProgram {
    /// The results at a state, in the order of the function's quantities.
    pub fn run<T: Machine>(&self, state: State<'_, T>) -> Vec<T> {
        let mut trig = std::collections::BTreeMap::new();
        for t in &self.trig {
            let (sin, cos) = t.pair(state.q);
            trig.insert(Input::Sin(t.angle), sin);
            trig.insert(Input::Cos(t.angle), cos);
        }
        let mut values: Vec<T> = Vec::with_capacity(self.steps.len());
        let read = |operand: &TextOperand, values: &[T]| match *operand {
            TextOperand::Literal(value) => T::literal(value),
            TextOperand::Step(step) => values[step],
            TextOperand::Input(Input::Position(joint)) => state.q[joint],
            TextOperand::Input(Input::Velocity(joint)) => state.qd[joint],
            TextOperand::Input(Input::Acceleration(joint)) => state.qdd[joint],
            TextOperand::Input(input) => trig[&input],
        };
        for step in &self.steps {
            let (left, right) = (read(&step.left, &values), read(&step.right, &values));
            values.push(left.operate(step.operation, right));
        }
        self.outputs
            .iter()
            .map(|(negative, operand)| {
                let value = read(operand, &values);
                if *negative { value.neg() } else { value }
            })
            .collect()
    }
}

impl TextTrig {
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
pub(super) fn angle_value<T: Machine>(angle: AngleSum, q: &[T]) -> T {
    let mut sum = None;
    for (joint, negative) in angle.terms() {
        sum = Some(match (sum, negative) {
            (None, false) => q[joint],
            (None, true) => q[joint].neg(),
            (Some(sum), false) => T::operate(sum, Operation::Add, q[joint]),
            (Some(sum), true) => T::operate(sum, Operation::Sub, q[joint]),
        });
    }
    sum.unwrap_or_else(|| T::literal(0.0))
}
