//! States from elsewhere (a simulator, another library, a measurement)
//! compared with generated code.
//!
//! - [`mod@file`]: reading them, strictly: an unknown key is an error
//! - [`compare`]: the code's results beside the given ones

pub mod compare;
pub mod file;

use std::collections::BTreeMap;

use dalembert_codegen::workspace::{JointState, Quantity};

/// The largest disagreement that counts as agreement: the largest error of an
/// entry at a state, relative to the largest entry given at that state.
pub const BOUND: f64 = 1e-12;

/// A state with what is known about it.
#[derive(Clone, Debug, PartialEq)]
pub struct GivenState {
    /// The state; rates that no given quantity needs are zero.
    pub state: JointState,
    /// τ, D (row by row), h and c, as far as they are known.
    pub known: BTreeMap<Quantity, Vec<f64>>,
}

/// Returns the largest size of an entry.
fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most, x| most.max(x.abs()))
}

/// Returns the entry with the largest error and that error, relative to the largest
/// expected entry; absolute where all of those vanish, infinite where a value
/// is not a number.
fn worst(actual: &[f64], expected: &[f64]) -> (usize, f64) {
    let size = largest(expected);
    let mut worst = (0, 0.0f64);
    for (index, (a, b)) in actual.iter().zip(expected).enumerate() {
        let difference = (a - b).abs();
        let error = if size > 0.0 {
            difference / size
        } else {
            difference
        };
        if error.is_nan() {
            return (index, f64::INFINITY);
        }
        if error > worst.1 {
            worst = (index, error);
        }
    }
    worst
}
