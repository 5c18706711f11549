//! The motion that excitation is measured against: random states within the limits.
//!
//! Parameters have different units, so that the condition of a regressor says as much about
//! kilograms as about the motion. The torque of a combination of parameters in a log,
//! against the one in this motion, has no unit.

use crate::accumulator::Accumulator;
use crate::dense::{norms, split};
use crate::error::Error;
use crate::model::Model;
use crate::random::Random;
use crate::triangle::Triangle;

/// Weighted states' R over all columns, without a torque.
#[derive(Clone, Debug)]
pub struct Reference {
    /// R, row by row.
    pub(crate) r: Vec<f64>,
    pub(crate) norms: Vec<f64>,
}

impl Reference {
    /// Evaluates the motion, with rows divided by their joint's noise and by √(number of states).
    pub(crate) fn new(model: &Model, noise: &[f64]) -> Result<Reference, Error> {
        let width = model.columns().len();
        let mut random = Random::new(0x7265_6600);
        let mut accumulator = Accumulator::new(model);
        let zero = vec![0.0; model.coordinates()];
        let states = 4 * width + 40;
        for _ in 0..states {
            let [q, qd, qdd] = model.state(1.0, &mut random);
            accumulator.add(model, [&q, &qd, &qdd], &zero)?;
        }
        let root = libm::sqrt(states as f64);
        let scales: Vec<f64> = noise.iter().map(|noise| 1.0 / (noise * root)).collect();
        let (r, _) = split(&weighted(&accumulator, width, &scales).reduced(), width);
        Ok(Reference {
            norms: norms(&r, width),
            r,
        })
    }
}

/// Returns the factor of all joints' rows times their scales, over all columns and the torque.
pub(crate) fn weighted(accumulator: &Accumulator, columns: usize, scales: &[f64]) -> Triangle {
    let mut triangle = Triangle::new(columns + 1);
    for (row, scale) in accumulator.factors().iter().zip(scales) {
        let count = row.columns.len();
        for entries in row.factor.chunks(count + 1).take(count) {
            let mut spread = vec![0.0; columns + 1];
            for (column, value) in row.columns.iter().chain([&columns]).zip(entries) {
                spread[*column] = value * scale;
            }
            triangle.push(spread);
        }
    }
    triangle
}
