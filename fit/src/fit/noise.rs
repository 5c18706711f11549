//! The noise of each joint's torque, from its triangle.

use super::{remove, unit_columns};
use crate::accumulator::Accumulator;
use crate::dense::{dot, singular, split};
use crate::error::Error;

/// Noise is taken for at least so much of the torque's root mean square: exact torques would
/// have none.
const LEAST_NOISE: f64 = 1e-13;

/// Columns of length one in one joint's row depend on each other where a combination of length
/// one is as short as that: structure or lack of motion, or what rounding decides.
const DEPENDENT: f64 = 1e-8;

/// Returns σ_i of every joint.
pub(crate) fn noise(data: &Accumulator) -> Result<Vec<f64>, Error> {
    let each = data.factors().into_iter().enumerate().map(|(joint, row)| {
        let columns = row.columns.len();
        let needed = columns as u64;
        if data.states() <= needed {
            return Err(Error::TooFew {
                joint,
                states: data.states(),
                needed,
            });
        }
        let (r, torque) = split(&row.factor, columns);
        let squares = dot(&torque, &torque) + row.rest();
        let (rank, left) = alone(&r, torque);
        let rest = left + row.rest();
        let degrees = (data.states() - rank) as f64;
        let least = LEAST_NOISE * libm::sqrt(squares / data.states() as f64);
        let noise = libm::sqrt(rest / degrees).max(least);
        // Torques that are all zero have none: any weight will do.
        Ok(if noise > 0.0 { noise } else { 1.0 })
    });
    each.collect()
}

/// Fits a joint's row alone: the rank of its columns, and the squares that R leaves of the torque.
///
/// Columns that are independent in all rows together may depend on each other in one. The
/// triangle then has rows of rounding: a direction that is anywhere in the residual, whose part
/// of the torque is as good as drawn. Of those, nothing is taken for fitted.
fn alone(r: &[f64], mut rest: Vec<f64>) -> (u64, f64) {
    let width = rest.len();
    let found = singular(&unit_columns(r, width), width);
    let largest = found.values.iter().fold(0.0f64, |a, b| a.max(*b));
    let mut rank = 0;
    for (value, image) in found.values.iter().zip(found.images) {
        if *value > DEPENDENT * largest {
            let unit: Vec<f64> = image.iter().map(|x| x / value).collect();
            remove(&mut rest, &unit);
            rank += 1;
        }
    }
    (rank, dot(&rest, &rest))
}
