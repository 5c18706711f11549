//! The functions' true values at a state: the generic link-frame recursion
//! over the robot's own parameters, in 256 bits.
//!
//! They share nothing with what is emitted but the robot and the state: no graph, no search, no
//! proof, no printer. A program's results in 256 bits are beside them, to be compared. The error of
//! either is bounded along with it.

use std::cell::RefCell;

use dalembert_model::equations::{Arm, Formulation};
use dalembert_model::number::{Angle, Exact, Rational, Wide};
use dalembert_model::scalar::{Scalar, SinCosPair};
use num_traits::Zero;
use rustc_hash::FxHashMap;

use super::exact;
use crate::dag::Leaves;
use crate::function::{Argument, Function};
use crate::program::{Input, Program};
use crate::scalar::true_value::TrueValue;
use crate::scalar::{AnyLeaves, AnyValue, Erase, restored};
use crate::setup::Setup;
use crate::states::JointState;

#[derive(Clone, Debug)]
pub struct Reference {
    setup: Setup,
    arm: Arm<AnyValue>,
    /// By an angle's bits: several functions are run at the same states.
    pairs: RefCell<FxHashMap<u64, SinCosPair<Wide>>>,
}

/// Pairs that are kept, about a megabyte.
const MAX_PAIRS: usize = 1 << 13;

impl Reference {
    pub fn new(setup: &Setup) -> Reference {
        let arm = setup.arm(|constant| TrueValue::constant(constant).erase());
        let (setup, pairs) = (setup.clone(), RefCell::default());
        Reference { arm, setup, pairs }
    }

    pub fn setup(&self) -> &Setup {
        &self.setup
    }

    /// Returns the results of a function over the scene's rows at a state of finite numbers, flat.
    pub fn run(&self, function: Function, state: &JointState) -> Vec<TrueValue> {
        let task = self.setup.task(function);
        let leaves = self.leaves(state);
        let posed = task.posed_arm(self.arm.clone(), &AnyLeaves(&leaves));
        restored(posed.results(Formulation::NewtonEulerLink))
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
            Input::PerSpeed(coordinate) => {
                let qd = finite(Argument::Velocity, coordinate);
                self.setup
                    .per_speed(coordinate, &qd, TrueValue::constant, TrueValue::sqrt)
            }
            Input::Entry(argument, index) => finite(argument, index),
        }
    }

    fn constant(&self, constant: &Exact) -> TrueValue {
        TrueValue::constant(constant)
    }
}
