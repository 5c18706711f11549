//! Runs each generated program at random states, as a test of the proof.
//!
//! A proof in a prime field may miss, with a negligible chance, and its implementation may have
//! a defect. Two states show it: the program with its exact constants, in 256 bits, against
//! the robot's own recursion in 256 bits; with a tolerance the text, read back, against its bounds.

use crate::generate::{GenerateError, GeneratedFunction};
use crate::program::ScalarType;
use crate::random::Random;
use crate::setup::Setup;
use crate::states::JointState;
use crate::tolerance::attempt::held;
use crate::verify::measure::RunnableCode;
use crate::verify::truth::Reference;

/// Two states: what is wrong, is wrong almost everywhere.
const STATES: usize = 2;

const SEED: u64 = 0x0074_7269_616c;

pub(super) fn check(
    setup: &Setup,
    functions: &[GeneratedFunction],
    emitted: &[RunnableCode],
) -> Result<(), GenerateError> {
    let reference = Reference::new(setup);
    for generated in functions {
        if generated.admitted.is_none() {
            exact(&reference, generated)?;
            continue;
        }
        let is_own = |text: &&RunnableCode| text.function == generated.function;
        let mut texts = emitted.iter().filter(is_own);
        texts.try_for_each(|text| tolerated(&reference, generated, text))?;
    }
    Ok(())
}

/// Runs a function without a tolerance at random states, against the robot's own recursion.
pub fn exact(reference: &Reference, generated: &GeneratedFunction) -> Result<(), GenerateError> {
    // Limits may reach beyond f32, and the reference is of finite numbers.
    let states = reference.setup().states(STATES, SEED);
    for state in states.iter().map(JointState::in_finite_single) {
        let truth = reference.run(generated.function, &state);
        let Some(results) = reference.run_program(&generated.program, &state) else {
            let why = "it reads what is not there";
            return Err(wrong(generated, 0, None, f64::INFINITY, why));
        };
        if results.len() != truth.len() {
            let why = format!("it has {} results of {}", results.len(), truth.len());
            return Err(wrong(generated, results.len(), None, f64::INFINITY, &why));
        }
        let differences = truth.iter().zip(&results).map(|(a, b)| a.difference(b));
        if let Some((index, error)) = differences.enumerate().find(|(_, error)| *error > 0.0) {
            let why = "in 256 bits both are equal";
            return Err(wrong(generated, index, None, error, why));
        }
    }
    Ok(())
}

fn tolerated(
    reference: &Reference,
    generated: &GeneratedFunction,
    emitted: &RunnableCode,
) -> Result<(), GenerateError> {
    let scalar = emitted.scalar;
    let Some(claim) = generated.variant(scalar) else {
        let why = "it passed its proof, but has no bounds";
        let function = generated.function;
        return Err(GenerateError::Defect(function, Some(scalar), why.into()));
    };
    let mut random = Random::new(SEED);
    let loading = claim.loading().ok().flatten();
    for _ in 0..STATES {
        let drawn = claim.draw(loading.as_ref(), &mut random);
        let state = held(&drawn, scalar, &claim.limits);
        let truth = reference.run(generated.function, &state);
        let results = emitted.run(&state).into_iter();
        let pairs = truth.iter().zip(results.chain(std::iter::repeat(f64::NAN)));
        let errors = pairs.map(|(true_value, x)| true_value.error(x));
        let mut both = errors.zip(claim.errors()).enumerate();
        if let Some((index, (error, bound))) = both.find(|(_, (error, bound))| error > bound) {
            let why = format!("its bound is {bound:.3e}");
            return Err(wrong(generated, index, Some(scalar), error, &why));
        }
    }
    Ok(())
}

fn wrong(
    generated: &GeneratedFunction,
    index: usize,
    scalar: Option<ScalarType>,
    error: f64,
    why: &str,
) -> GenerateError {
    let entry = generated.program.entry(index);
    let why = format!(
        "it passed its proof, but gave a wrong result when it was run: {entry} is {error:.3e} off \
         the robot's own recursion, and {why}"
    );
    GenerateError::Defect(generated.function, scalar, why)
}
