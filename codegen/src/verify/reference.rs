//! The functions' true values at a state: the generic link-frame recursion
//! over the robot's own parameters, in 256 bits.
//!
//! It shares nothing with what is emitted but the robot and the state: no
//! graph, no search, no proof, no printer. Its own error is bounded along with
//! it: [`Size`] runs the same formula with every sum and difference replaced by
//! the sum of magnitudes.

use dalembert_model::equations::{Arm, Formulation};
use dalembert_model::number::{Angle, Exact, Rational, Rounded, Wide};
use dalembert_model::outputs::Axis;
use dalembert_model::scalar::{Rotor, Scalar};
use num_traits::Zero;

use crate::function::{Function, Quantity};
use crate::program::{AngleSum, Input};
use crate::scene::Setting;
use crate::states::JointState;

/// 2⁻²⁰⁰: what 256 bits lose, times how often, is far below this part of the
/// largest intermediate.
const LOST: f64 = 6.3e-61;

/// A robot, or a robot in a scene.
#[derive(Clone, Debug)]
pub struct Reference<'s> {
    setting: &'s Setting,
    arm: Arm<Wide>,
    sizes: Arm<Size>,
}

/// A true value, and how far it may be off.
#[derive(Clone, Debug)]
pub struct TrueValue {
    value: Wide,
    lost: f64,
}

impl TrueValue {
    /// |x − value| and no less, less what the reference itself may be off;
    /// infinite if `x` is no number.
    pub fn error(&self, x: f64) -> f64 {
        match Wide::from_f64(x) {
            Some(x) => (x.sub(&self.value).magnitude() - self.lost).max(0.0),
            None => f64::INFINITY,
        }
    }

    /// |value|, rounded up.
    pub fn magnitude(&self) -> f64 {
        self.value.magnitude()
    }
}

impl<'s> Reference<'s> {
    /// Of a setting.
    pub fn new(setting: &'s Setting) -> Reference<'s> {
        let robot = setting.robot();
        Reference {
            setting,
            arm: Arm::from_robot(robot, &mut Wide::from_exact),
            sizes: Arm::from_robot(robot, &mut Size::of),
        }
    }

    /// The results of a function over the setting's rows at a state of finite
    /// numbers, flat.
    pub fn run(&self, function: Function, state: &JointState) -> Vec<TrueValue> {
        let finite = |x: f64| Wide::from_f64(x).unwrap_or_else(Wide::zero);
        let pairs: Vec<Rotor<Wide>> = state.q.iter().map(|&q| pair(q)).collect();
        // A motion reads the angles of single joints only.
        let joint = |angle: AngleSum| angle.terms().map(|(joint, _)| joint).sum::<usize>();
        let values = self.evaluate(function, &self.arm, Wide::from_exact, |input| match input {
            Input::Sin(angle) => pairs[joint(angle)].sin.clone(),
            Input::Cos(angle) => pairs[joint(angle)].cos.clone(),
            Input::Entry(argument, joint) => finite(state.of(argument)[joint]),
        });
        let sizes = self.evaluate(function, &self.sizes, Size::of, |input| match input {
            Input::Sin(_) | Input::Cos(_) => Size(1.0),
            Input::Entry(argument, joint) => Size(state.of(argument)[joint].abs()),
        });
        let pairs = values.into_iter().zip(sizes);
        pairs
            .map(|(value, size)| TrueValue {
                value,
                lost: size.0 * LOST,
            })
            .collect()
    }

    fn evaluate<S: Scalar>(
        &self,
        function: Function,
        arm: &Arm<S>,
        constant: impl FnMut(&Exact) -> S,
        input: impl FnMut(Input) -> S,
    ) -> Vec<S> {
        let motion = self.setting.motion(input, constant);
        let results = function.evaluate(Formulation::NewtonEulerLink, arm, &motion);
        let joints = self.setting.joints();
        self.setting.select(function, joints, results)
    }
}

/// How many recursions a function takes: what a state costs.
pub fn recursions(function: Function, joints: usize) -> usize {
    let of = |quantity: &Quantity| {
        let axes = quantity.shape().0.iter();
        match axes.filter(|axis| **axis == Axis::Joints).count() {
            0 | 1 => 1,
            2 => joints,
            // h_ikm by polarisation: a recursion for each pair k <= m.
            _ => joints * (joints + 1) / 2,
        }
    };
    function.quantities().iter().map(of).sum()
}

fn pair(q: f64) -> Rotor<Wide> {
    let angle = Rational::from_float(q).unwrap_or_else(Rational::zero);
    Wide::rotor(&Angle::Radians(angle))
}

/// The largest magnitude that a value and all that it was made of can have.
#[derive(Clone, Copy, Debug)]
struct Size(f64);

impl Size {
    fn of(constant: &Exact) -> Size {
        // A polynomial's terms may cancel, but its generators are at most one.
        let value = constant.map(
            &mut |x| Some(Size(f64::nearest_rational(x).abs())),
            &mut |_| Rotor {
                sin: Size(1.0),
                cos: Size(1.0),
            },
        );
        value.unwrap_or(Size(f64::INFINITY))
    }
}

impl Scalar for Size {
    fn zero() -> Self {
        Size(0.0)
    }
    fn one() -> Self {
        Size(1.0)
    }
    fn add(&self, other: &Self) -> Self {
        Size(self.0 + other.0)
    }
    fn sub(&self, other: &Self) -> Self {
        Size(self.0 + other.0)
    }
    fn mul(&self, other: &Self) -> Self {
        // 0·∞: a zero is one, whatever it is multiplied by.
        Size(match self.0 == 0.0 || other.0 == 0.0 {
            true => 0.0,
            false => self.0 * other.0,
        })
    }
    fn neg(&self) -> Self {
        *self
    }
    fn half(&self) -> Self {
        Size(0.5 * self.0)
    }
}
