//! Runs a program with its constants rounded.

use std::marker::PhantomData;

use dalembert_codegen::workspace::program::machine::Machine;
use dalembert_codegen::workspace::program::{
    AngleSum, Input, Literal, Lowered, Program, ScalarType, evaluate,
};
use dalembert_codegen::workspace::states::JointState;

/// A program with its constants rounded.
pub(super) struct Runner<T> {
    lowered: Lowered,
    machine: PhantomData<T>,
}

impl<T: Machine> Runner<T> {
    pub(super) fn new(program: &Program, scalar: ScalarType) -> Self {
        Runner {
            lowered: program.lower(scalar, |_| None),
            machine: PhantomData,
        }
    }

    /// Returns the results; of an angle both sine and cosine are always computed.
    pub(super) fn run(&self, state: &JointState) -> Vec<f64> {
        let pair = |angle: AngleSum| {
            let mut sum = T::literal(0.0);
            for (joint, negative) in angle.terms() {
                let q = T::literal(*state.q.get(joint)?);
                sum = if negative { sum.sub(&q) } else { sum.add(&q) };
            }
            Some((angle, sum.sincos()))
        };
        let pairs: Vec<_> = self
            .lowered
            .trig
            .iter()
            .filter_map(|t| pair(t.angle))
            .collect();
        let pair = |angle: AngleSum| {
            let found = pairs.iter().find(|(known, _)| *known == angle);
            found.map(|(_, pair)| *pair)
        };
        let at = |values: &[f64], joint: usize| values.get(joint).map(|&x| T::literal(x));
        let speeds = &self.lowered.speeds;
        let qd: Vec<T> = state.qd.iter().map(|&x| T::literal(x)).collect();
        let speed = |joint: usize| {
            let own = speeds.iter().find(|own| own.joint == joint)?;
            own.run(&qd)
        };
        let input = |input: &Input| match *input {
            Input::PerSpeed(joint) => speed(joint),
            Input::Entry(argument, joint) => at(state.of(argument), joint),
            Input::Sin(angle) => pair(angle).map(|(sin, _)| sin),
            Input::Cos(angle) => pair(angle).map(|(_, cos)| cos),
        };
        let constant = |value: &Literal| Some(T::literal(value.0));
        let results = evaluate(&self.lowered.steps, &self.lowered.outputs, input, constant);
        let results = results.unwrap_or_default();
        results.into_iter().map(T::to_f64).collect()
    }
}
