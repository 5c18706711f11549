//! The functions' true values at a state: the generic link-frame recursion
//! over the robot's own parameters, in 256 bits.
//!
//! It shares nothing with what is emitted but the robot and the state: no
//! graph, no search, no proof, no printer, and unlike the proof no recording of the
//! formula, which is executed anew at each state. Its own error is bounded along with
//! it: `Known` carries the size of all that a value was made of, every sum
//! and difference replaced by the sum of magnitudes.

use dalembert_model::equations::regressor::LinkParameter;
use dalembert_model::equations::{Arm, Formulation};
use dalembert_model::number::{Angle, Exact, Rational, Rounded, Wide};
use dalembert_model::outputs::Axis;
use dalembert_model::scalar::{Divide, Scalar, SinCosPair};
use num_traits::Zero;

use crate::function::{Argument, Columns, Function, Quantity};
use crate::program::{AngleSum, Input};
use crate::scene::SceneRobot;
use crate::states::JointState;

/// 2⁻²⁰⁰: what 256 bits lose, times how often, is far below this part of the
/// largest intermediate.
const LOST: f64 = 6.3e-61;

/// A robot, or a robot in a scene.
#[derive(Clone, Debug)]
pub struct Reference<'s> {
    scene_robot: &'s SceneRobot,
    arm: Arm<Known>,
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

    /// The same; zero of what cannot be told from zero.
    pub fn size(&self) -> f64 {
        match self.magnitude() {
            size if size <= self.lost => 0.0,
            size => size,
        }
    }
}

impl<'s> Reference<'s> {
    /// Of a robot in its scene.
    pub fn new(scene_robot: &'s SceneRobot) -> Reference<'s> {
        let robot = scene_robot.robot();
        Reference {
            scene_robot,
            arm: Arm::from_robot(robot, &mut Known::of),
        }
    }

    /// What it is about.
    pub fn scene_robot(&self) -> &'s SceneRobot {
        self.scene_robot
    }

    /// The results of a function over the scene's rows at a state of finite
    /// numbers, flat.
    pub fn run(&self, function: Function, state: &JointState) -> Vec<TrueValue> {
        let finite = |x: f64| Wide::from_f64(x).unwrap_or_else(Wide::zero);
        let pairs: Vec<SinCosPair<Wide>> = state.q.iter().map(|&q| pair(q)).collect();
        // A motion reads the angles of single joints only.
        let joint = |angle: AngleSum| angle.terms().map(|(joint, _)| joint).sum::<usize>();
        let sine = |value: &Wide| Known::sized(*value, 1.0);
        let input = |input| match input {
            Input::Sin(angle) => sine(&pairs[joint(angle)].sin),
            Input::Cos(angle) => sine(&pairs[joint(angle)].cos),
            Input::PerSpeed(joint) => {
                let x = state.entry(Argument::Velocity, joint);
                let qd = Known::sized(finite(x), x.abs());
                self.scene_robot
                    .per_speed(joint, &qd, Known::of, Known::sqrt)
            }
            Input::Entry(argument, joint) => {
                let x = state.entry(argument, joint);
                Known::sized(finite(x), x.abs())
            }
        };
        let arm = self.arm.clone();
        let posed = self.scene_robot.posed(function, arm, input, Known::of);
        let results = posed.results(self.scene_robot, function, Formulation::NewtonEulerLink);
        let known = |Known { value, size }: Known| TrueValue {
            value,
            lost: size * LOST,
        };
        results.into_iter().map(known).collect()
    }
}

/// How many recursions a function takes: what a state costs.
pub(crate) fn recursions(function: Function, joints: usize) -> usize {
    let of = |quantity: &Quantity| {
        let axes = quantity.shape().0.iter();
        if function.columns() != Columns::None {
            // Two for each column, of which there are ten a link at most.
            return 2 * LinkParameter::COUNT * joints;
        }
        match axes.filter(|axis| **axis == Axis::Joints).count() {
            0 | 1 => 1,
            2 => joints,
            // h_ikm by polarisation: a recursion for each pair k <= m.
            _ => joints * (joints + 1) / 2,
        }
    };
    function.quantities().iter().map(of).sum()
}

fn pair(q: f64) -> SinCosPair<Wide> {
    let angle = Rational::from_float(q).unwrap_or_else(Rational::zero);
    Wide::sincos(&Angle::Radians(angle))
}

/// A value, and the largest magnitude that it and all that it was made of can
/// have: what it lost is a small part of that.
#[derive(Clone, Debug)]
struct Known {
    value: Wide,
    size: f64,
}

impl Known {
    fn sized(value: Wide, size: f64) -> Known {
        Known { value, size }
    }

    fn of(constant: &Exact) -> Known {
        // A polynomial's terms may cancel, but its generators are at most one.
        let rational = &mut |x: &Rational| {
            let size = f64::nearest_rational(x).abs();
            Some(Known::sized(Wide::from_rational(x), size))
        };
        let value = constant.map(rational, &mut |angle| {
            Wide::sincos(angle).map(|x| Known::sized(*x, 1.0))
        });
        value.unwrap_or_else(|| Known::sized(Wide::from_exact(constant), f64::INFINITY))
    }
}

impl Known {
    /// The root of what is above zero: what x is off moves it by Δx/(2 √x); the
    /// whole Δx/√x, since x is off itself.
    fn sqrt(&self) -> Known {
        let value = self.value.sqrt();
        let size = match value.magnitude() {
            0.0 => f64::INFINITY,
            root => self.size / root.next_down(),
        };
        Known::sized(value, size)
    }
}

impl Scalar for Known {
    fn zero() -> Self {
        Known::sized(Wide::zero(), 0.0)
    }
    fn one() -> Self {
        Known::sized(Wide::one(), 1.0)
    }
    fn add(&self, other: &Self) -> Self {
        Known::sized(self.value.add(&other.value), self.size + other.size)
    }
    fn sub(&self, other: &Self) -> Self {
        Known::sized(self.value.sub(&other.value), self.size + other.size)
    }
    fn mul(&self, other: &Self) -> Self {
        // 0·∞: a zero is one, whatever it is multiplied by.
        let size = match self.size == 0.0 || other.size == 0.0 {
            true => 0.0,
            false => self.size * other.size,
        };
        Known::sized(self.value.mul(&other.value), size)
    }
    fn neg(&self) -> Self {
        Known::sized(self.value.neg(), self.size)
    }
    fn half(&self) -> Self {
        Known::sized(self.value.half(), 0.5 * self.size)
    }
}

impl Divide for Known {
    /// What x and y are off moves x/y by (Δx − (x/y) Δy)/y; twice that, since
    /// y is off itself.
    fn div(&self, other: &Self) -> Self {
        let value = self.value.div(&other.value);
        let moved = self.size + value.magnitude() * other.size;
        let size = match other.value.magnitude() {
            0.0 => f64::INFINITY,
            divisor => 2.0 * moved / divisor.next_down(),
        };
        Known::sized(value, size)
    }
}
