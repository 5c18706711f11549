//! The functions' true values at a state: the generic link-frame recursion
//! over the robot's own parameters, in 256 bits.
//!
//! They share nothing with what is emitted but the robot and the state: no graph, no search, no
//! proof, no printer. What a program gives in 256 bits is beside them, to be compared. The error of
//! either is bounded along with it.

use std::cell::RefCell;

use dalembert_model::equations::{Arm, Formulation};
use dalembert_model::number::{Angle, Exact, Rational, Wide};
use dalembert_model::scalar::{Divide, Scalar, SinCosPair};
use num_traits::Zero;
use rustc_hash::FxHashMap;

use super::exact;
use crate::dag::Leaves;
use crate::function::{Argument, Function};
use crate::program::{Input, Program};
use crate::setup::Setup;
use crate::states::JointState;

/// 2⁻²⁰⁰: an operation in 256 bits loses at most 2⁻²⁵⁵ of its result. The rest is room for
/// the roundings of the bounds themselves, which are doubles.
const LOST: f64 = 6.3e-61;

/// A robot, or a robot in a scene.
#[derive(Clone, Debug)]
pub struct Reference {
    setup: Setup,
    arm: Arm<TrueValue>,
    /// By an angle's bits: several functions are run at the same states.
    pairs: RefCell<FxHashMap<u64, SinCosPair<Wide>>>,
}

/// Pairs that are kept, about a megabyte.
const MAX_PAIRS: usize = 1 << 13;

/// A true value, with a bound of its error by Wilkinson's running error analysis.
#[derive(Clone, Debug)]
pub struct TrueValue {
    value: Wide,
    /// |value|, rounded up.
    size: f64,
    /// In units of [`LOST`].
    lost: f64,
}

impl TrueValue {
    /// Returns the distance to another true value; zero where the errors of both may explain it.
    pub(crate) fn difference(&self, other: &TrueValue) -> f64 {
        let off = other.value.sub(&self.value).magnitude();
        (off - self.lost * LOST - other.lost * LOST).max(0.0)
    }

    /// A lower bound of |x − truth|: |x − value| less the reference's own error; infinite for NaN.
    pub fn error(&self, x: f64) -> f64 {
        match Wide::from_f64(x) {
            Some(x) => (x.sub(&self.value).magnitude() - self.lost * LOST).max(0.0),
            None => f64::INFINITY,
        }
    }

    /// Returns the nearest double.
    pub fn to_f64(&self) -> f64 {
        self.value.to_f64()
    }

    /// Returns |value|, rounded up.
    pub fn magnitude(&self) -> f64 {
        self.value.magnitude()
    }

    /// Returns the same; zero of what cannot be told from zero.
    pub fn size(&self) -> f64 {
        match self.magnitude() {
            size if size <= self.lost * LOST => 0.0,
            size => size,
        }
    }
}

impl Reference {
    /// Creates the reference of a robot in its scene.
    pub fn new(setup: &Setup) -> Reference {
        Reference {
            arm: setup.arm(TrueValue::constant),
            setup: setup.clone(),
            pairs: RefCell::default(),
        }
    }

    /// Returns the robot in its scene.
    pub fn setup(&self) -> &Setup {
        &self.setup
    }

    /// Returns the results of a function over the scene's rows at a state of finite numbers, flat.
    pub fn run(&self, function: Function, state: &JointState) -> Vec<TrueValue> {
        let task = self.setup.task(function);
        let posed = task.posed_arm(self.arm.clone(), &self.leaves(state));
        posed.results(Formulation::NewtonEulerLink)
    }

    /// A load is that of the state's payload; none if the program reads what is not there.
    pub(crate) fn run_program(
        &self,
        program: &Program,
        state: &JointState,
    ) -> Option<Vec<TrueValue>> {
        exact::run(Some(&self.setup), program, &self.leaves(state))
    }

    fn leaves<'r>(&'r self, state: &'r JointState) -> AtState<'r> {
        AtState {
            setup: &self.setup,
            pairs: state.q.iter().map(|&q| self.pair(q)).collect(),
            state,
        }
    }

    fn pair(&self, q: f64) -> SinCosPair<Wide> {
        let mut pairs = self.pairs.borrow_mut();
        if pairs.len() >= MAX_PAIRS {
            pairs.clear();
        }
        let known = pairs.entry(q.to_bits()).or_insert_with(|| {
            let angle = Rational::from_float(q).unwrap_or_else(Rational::zero);
            Wide::sincos(&Angle::Radians(angle))
        });
        known.clone()
    }
}

struct AtState<'r> {
    setup: &'r Setup,
    pairs: Vec<SinCosPair<Wide>>,
    state: &'r JointState,
}

impl Leaves for AtState<'_> {
    type Value = TrueValue;

    fn input(&self, input: Input) -> TrueValue {
        let finite = |argument, index| {
            let entry = Wide::from_f64(self.state.entry(argument, index));
            TrueValue::exact(entry.unwrap_or_else(Wide::zero))
        };
        match input {
            Input::Sin(joint) => TrueValue::rounded(self.pairs[joint].sin, 1.0),
            Input::Cos(joint) => TrueValue::rounded(self.pairs[joint].cos, 1.0),
            Input::PerSpeed(joint) => {
                let qd = finite(Argument::Velocity, joint);
                self.setup
                    .per_speed(joint, &qd, TrueValue::constant, TrueValue::sqrt)
            }
            Input::Entry(argument, index) => finite(argument, index),
        }
    }

    fn constant(&self, constant: &Exact) -> TrueValue {
        TrueValue::constant(constant)
    }
}

impl TrueValue {
    fn exact(value: Wide) -> TrueValue {
        let size = value.magnitude();
        TrueValue {
            value,
            size,
            lost: 0.0,
        }
    }

    fn rounded(value: Wide, carried: f64) -> TrueValue {
        let size = value.magnitude();
        TrueValue {
            value,
            size,
            lost: carried + size,
        }
    }

    fn constant(constant: &Exact) -> TrueValue {
        let rational = &mut |x: &Rational| Some(TrueValue::rounded(Wide::from_rational(x), 0.0));
        // Sines and cosines, within 2⁻²⁵⁵.
        let value = constant.map(rational, &mut |angle| {
            Wide::sincos(angle).map(|x| TrueValue::rounded(*x, 1.0))
        });
        value.unwrap_or_else(|| TrueValue::rounded(Wide::from_exact(constant), f64::INFINITY))
    }

    /// For x above zero. Δx moves √x by Δx/(2 √x); the whole Δx/√x, since x is off itself.
    fn sqrt(&self) -> TrueValue {
        let value = self.value.sqrt();
        let carried = match value.magnitude() {
            0.0 => f64::INFINITY,
            root => self.lost / root.next_down(),
        };
        TrueValue::rounded(value, carried)
    }
}

/// Multiplies a size by an error: what is exactly zero is off by nothing, whatever the other is.
fn times(size: f64, lost: f64) -> f64 {
    match size == 0.0 || lost == 0.0 {
        true => 0.0,
        false => size * lost,
    }
}

impl Scalar for TrueValue {
    fn zero() -> Self {
        TrueValue::exact(Wide::zero())
    }
    fn one() -> Self {
        TrueValue::exact(Wide::one())
    }
    fn add(&self, other: &Self) -> Self {
        TrueValue::rounded(self.value.add(&other.value), self.lost + other.lost)
    }
    fn sub(&self, other: &Self) -> Self {
        TrueValue::rounded(self.value.sub(&other.value), self.lost + other.lost)
    }
    fn mul(&self, other: &Self) -> Self {
        let carried = times(self.size, other.lost)
            + times(other.size, self.lost)
            + times(self.lost, other.lost) * LOST;
        TrueValue::rounded(self.value.mul(&other.value), carried)
    }
    fn neg(&self) -> Self {
        TrueValue {
            value: self.value.neg(),
            ..*self
        }
    }
    fn half(&self) -> Self {
        TrueValue {
            value: self.value.half(),
            size: 0.5 * self.size,
            lost: 0.5 * self.lost,
        }
    }
}

impl Divide for TrueValue {
    /// Errors of x and y move x/y by (Δx + |x/y| Δy)/(|y| − Δy): at most twice that with |y|
    /// below, unless Δy is more than half of y, and nothing is known.
    fn div(&self, other: &Self) -> Self {
        let value = self.value.div(&other.value);
        let divisor = other.size.next_down();
        let carried = match other.lost * LOST < 0.4 * divisor {
            true => 2.0 * (self.lost + times(value.magnitude(), other.lost)) / divisor,
            false => f64::INFINITY,
        };
        TrueValue::rounded(value, carried)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use dalembert_model::read;

    /// An error of emitted code could hide where the reference knew less.
    #[test]
    fn every_result_is_known_far_beyond_a_double() {
        let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../generated/robots");
        for name in ["planar3r", "stanford", "ur10", "panda"] {
            let text = std::fs::read_to_string(folder.join(format!("{name}.toml"))).unwrap();
            let robot = read::parse(&text).unwrap().robot;
            let setup = Setup::whole(&robot);
            let reference = Reference::new(&setup);
            for function in Function::ALL {
                for state in setup.states(3, 5) {
                    let truth = reference.run(function, &state);
                    let largest = truth.iter().map(TrueValue::magnitude).fold(0.0, f64::max);
                    let lost = truth.iter().map(|x| x.lost * LOST).fold(0.0, f64::max);
                    assert!(
                        lost <= 1e-45 * largest,
                        "{name} {function}: {lost:e} of {largest:e}"
                    );
                }
            }
        }
    }

    fn int(n: i64) -> Rational {
        Rational::from_integer(n.into())
    }

    #[test]
    fn what_cancels_is_known_less_well() {
        let known = |n: Rational| TrueValue::constant(&Exact::from(n.recip()));
        let (third, tiny) = (known(int(3)), known(int(7).pow(60)));
        let rest = third.add(&tiny).sub(&third);
        let off = rest.value.sub(&tiny.value).magnitude();
        assert!(off > 0.0 && off <= rest.lost * LOST && rest.lost < 2.0);
        let quotient = third.div(&rest);
        assert!(quotient.lost > 1e50 * third.lost && quotient.lost.is_finite());
        assert_eq!(third.div(&third.sub(&third)).lost, f64::INFINITY);
    }
}
