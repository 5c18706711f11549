//! The comparison of machine code with the program that it was made of.

use dalembert_codegen::workspace::{Argument, Code, Machine, State};

use crate::compile::Signature;
use crate::error::Error;
use crate::rows::Place;

/// The number of states that are compared.
pub const STATES: usize = 64;

/// Values that have branches, or no number.
const SPECIAL: [f64; 8] = [
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    -0.0,
    1e5,
    -8192.0,
    100.5,
    1e-310,
];

/// Draws an entry: from a SHA-256 of where it is. One of 31 is special.
fn entry<T: Machine>(state: usize, argument: Argument, index: usize) -> T {
    let text = format!("{state} {} {index}", argument.name());
    let hash = hmac_sha256::Hash::hash(text.as_bytes());
    let number = u64::from_le_bytes(std::array::from_fn(|byte| hash[byte]));
    let special = (number % 31 == 0 && state % 2 == 1)
        .then(|| SPECIAL[(number / 31) as usize % SPECIAL.len()]);
    let unit = (number >> 11) as f64 / (1u64 << 53) as f64;
    T::literal(special.unwrap_or((2.0 * unit - 1.0) * reach(argument)))
}

fn reach(argument: Argument) -> f64 {
    match argument {
        // All four quarter turns, and the next.
        Argument::Position => 7.0,
        other => other.reach(),
    }
}

fn drawn<T: Machine>(signature: &Signature) -> Vec<Vec<Vec<T>>> {
    let state = |state: usize| {
        let arguments = signature.arguments.iter();
        let drawn = arguments.map(|&(argument, len)| {
            let entries = (0..len).map(|index| entry(state, argument, index));
            entries.collect()
        });
        drawn.collect()
    };
    (0..STATES).map(state).collect()
}

/// Compares two results: equal bits, or both no number, whose bits no language fixes.
fn is_same<T: Machine>(left: T, right: T) -> bool {
    let (left, right) = (left.to_f64(), right.to_f64());
    left.to_bits() == right.to_bits() || (left.is_nan() && right.is_nan())
}

fn expected<T: Machine>(program: &Code, signature: &Signature, state: &[Vec<T>]) -> Vec<T> {
    let mut arguments: State<T> = Default::default();
    for (&(argument, _), entries) in signature.arguments.iter().zip(state) {
        arguments[argument.index()].clone_from(entries);
    }
    program.run(&arguments).unwrap_or_default()
}

fn differing<T: Machine>(expected: &[T], found: &[T]) -> Option<usize> {
    if expected.len() != found.len() {
        return Some(expected.len().min(found.len()));
    }
    let mut both = expected.iter().zip(found);
    both.position(|(&expected, &found)| !is_same(expected, found))
}

pub(crate) fn check<T: Machine + Default>(
    program: &Code,
    signature: &Signature,
    call: impl Fn(&[&[T]], &mut [T]) -> Result<(), Error>,
) -> Result<(), Error> {
    let mut results = vec![T::default(); program.dag.outputs.len()];
    for (state, arguments) in drawn::<T>(signature).iter().enumerate() {
        let slices: Vec<&[T]> = arguments.iter().map(Vec::as_slice).collect();
        // The lengths are the signature's: it can only be called.
        call(&slices, &mut results).map_err(|_| Error::Program)?;
        if let Some(result) = differing(&expected(program, signature, arguments), &results) {
            return Err(Error::Differs { state, result });
        }
    }
    Ok(())
}

/// `place` says where the entries of an argument or a result lie.
pub(crate) fn check_many<T: Machine + Default>(
    program: &Code,
    signature: &Signature,
    place: impl Fn(usize) -> Place,
    call: impl Fn(&[(&[T], Place)], &mut [(&mut [T], Place)]) -> Result<(), Error>,
) -> Result<(), Error> {
    let states = drawn::<T>(signature);
    let mut data: Vec<Vec<T>> = Vec::new();
    for (argument, &(_, len)) in signature.arguments.iter().enumerate() {
        let (mut numbers, place) = (vec![T::default(); len * STATES], place(len));
        for (number, state) in states.iter().enumerate() {
            for (at, &value) in place.entries(number).zip(&state[argument]) {
                numbers[at] = value;
            }
        }
        data.push(numbers);
    }
    let read = data.iter().zip(&signature.arguments);
    let rows = read.map(|(data, &(_, len))| (data.as_slice(), place(len)));
    let sizes = signature.results.iter();
    let mut outputs: Vec<_> = sizes.map(|len| vec![T::default(); len * STATES]).collect();
    let written = outputs.iter_mut().zip(&signature.results);
    let results = written.map(|(data, &len)| (data.as_mut_slice(), place(len)));
    call(&rows.collect::<Vec<_>>(), &mut results.collect::<Vec<_>>())?;
    for (state, arguments) in states.iter().enumerate() {
        let entries = |(output, &len): (&Vec<T>, &usize)| -> Vec<T> {
            place(len).entries(state).map(|at| output[at]).collect()
        };
        let values = outputs.iter().zip(&signature.results).flat_map(entries);
        let computed: Vec<T> = values.collect();
        if let Some(result) = differing(&expected(program, signature, arguments), &computed) {
            return Err(Error::Differs { state, result });
        }
    }
    Ok(())
}
