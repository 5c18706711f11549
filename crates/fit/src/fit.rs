//! Parameters with their standard errors.
//!
//! The joints' noise comes from the same triangles: σ_i² = ρ_i²/(m − k_i), the residual that a
//! fit of joint i alone leaves (Gautier 1997, weighted least squares). With rows divided by σ_i
//! the covariance of π is (RᵀR)⁻¹; R is never multiplied by itself.
//!
//! Combinations are then compared with the [reference motion](mod@crate::reference). With R_ref
//! its factor, the singular values γ of R R_ref⁻¹/√m say how much torque a combination gives in
//! the data per torque in that motion. Below [`LEAST_EXCITATION`] it is not excited: it
//! keeps the robot file's value, and its standard error is infinite.

use crate::accumulator::Accumulator;
use crate::dense::{apply, back_substitute, dot, norms, over, singular, split};
use crate::error::Error;
use crate::model::Model;
use crate::reference::{Reference, weighted};
use crate::unexcited::{UnexcitedDirection, Weights, separated};

/// Combinations that give less than this part of the reference motion's torque are not excited.
pub const LEAST_EXCITATION: f64 = 1e-3;

/// The least noise, relative to the RMS of the torque: exact torques would have none.
const LEAST_NOISE: f64 = 1e-13;

/// Columns of length one in one joint's row depend on each other where a combination of length
/// one is as short as that: structure or lack of motion, or what rounding decides.
const DEPENDENT: f64 = 1e-8;

/// Identified parameters.
#[derive(Clone, Debug)]
pub struct Fit {
    /// π, an entry a column of the model.
    pub parameters: Vec<f64>,
    /// Their standard errors; infinite where the data do not tell.
    pub standard_errors: Vec<f64>,
    /// σ_i: the noise of each joint's torque, N·m or N.
    pub noise: Vec<f64>,
    /// Root mean square of each joint's residual with the robot file's parameters.
    pub before: Vec<f64>,
    /// The residuals of the identified parameters, on the same states.
    pub after: Vec<f64>,
    /// Condition of the weighted regressor, columns of length one; infinite if these are dependent.
    pub condition: f64,
    /// The parameters that the data do not excite.
    pub unexcited: Vec<UnexcitedDirection>,
    /// Number of states.
    pub states: u64,
    /// R of the weighted data.
    pub(crate) factor: Vec<f64>,
}

/// Identifies the parameters of a model from what was accumulated.
///
/// # Errors
/// [`Error::OtherModel`] and [`Error::TooFew`].
pub fn fit(model: &Model, data: &Accumulator) -> Result<Fit, Error> {
    data.matches(model)?;
    let width = model.columns().len();
    let noise = noise(data)?;
    let scales: Vec<f64> = noise.iter().map(|noise| 1.0 / noise).collect();
    let (r, z) = split(&weighted(data, width, &scales).reduced(), width);
    let reference = Reference::new(model, &noise)?;
    let root = libm::sqrt(data.states() as f64);
    let decomposition = singular(&over(&r, &reference.r, width), width);
    let before = apply(&reference.r, model.parameters());
    let least = LEAST_EXCITATION * root;
    let mut y = vec![0.0; width];
    let mut variances = vec![0.0f64; width];
    let mut directions = Vec::new();
    for k in 0..width {
        let (value, direction) = (decomposition.values[k], &decomposition.directions[k]);
        let parameters = back_substitute(&reference.r, direction);
        let excited = value >= least;
        let along = match excited {
            true => dot(&decomposition.images[k], &z) / (value * value),
            false => dot(direction, &before),
        };
        for (y, direction) in y.iter_mut().zip(direction) {
            *y += along * direction;
        }
        for (column, part) in parameters.iter().enumerate() {
            if excited {
                variances[column] += (part / value).powi(2);
            } else if (part * reference.norms[column]).abs() > 1e-6 {
                variances[column] = f64::INFINITY;
            }
        }
        if !excited {
            directions.push(parameters);
        }
    }
    let weighting = Weights {
        model,
        noise: &noise,
        reference: &reference,
    };
    let directions = separated(directions, &reference.norms);
    let mut unexcited = weighting.describe(&directions, &r, root)?;
    unexcited.sort_by(|a, b| a.excitation.total_cmp(&b.excitation));
    let mut parameters = back_substitute(&reference.r, &y);
    keep_file(model, &directions, &reference.norms, &mut parameters);
    Ok(Fit {
        before: data.residual(model, model.parameters())?,
        after: data.residual(model, &parameters)?,
        parameters,
        standard_errors: variances.into_iter().map(libm::sqrt).collect(),
        condition: condition(&r, width),
        noise,
        unexcited,
        states: data.states(),
        factor: r,
    })
}

pub(crate) fn noise(data: &Accumulator) -> Result<Vec<f64>, Error> {
    let noises = data.factors().into_iter().enumerate().map(|(joint, row)| {
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
    noises.collect()
}

/// Returns the rank of the columns, and the squares that R leaves of the torque. Columns that are
/// independent in all rows together may depend on each other in one. R then has rows of rounding,
/// whose part of the torque is as good as drawn: of those, nothing is taken for fitted.
fn alone(r: &[f64], mut rest: Vec<f64>) -> (u64, f64) {
    let width = rest.len();
    let decomposition = singular(&unit_columns(r, width), width);
    let largest = decomposition.values.iter().fold(0.0f64, |a, b| a.max(*b));
    let mut rank = 0;
    for (value, image) in decomposition.values.iter().zip(decomposition.images) {
        if *value > DEPENDENT * largest {
            let unit: Vec<f64> = image.iter().map(|x| x / value).collect();
            remove(&mut rest, &unit);
            rank += 1;
        }
    }
    (rank, dot(&rest, &rest))
}

/// Takes back what unexcited directions have of the change from the file's parameters, sizes
/// by `norms`: a parameter that is one of these directions by itself then keeps its value.
fn keep_file(model: &Model, directions: &[Vec<f64>], norms: &[f64], parameters: &mut [f64]) {
    let scaled = |values: &[f64]| -> Vec<f64> {
        values.iter().zip(norms).map(|(x, norm)| x * norm).collect()
    };
    let pairs = parameters.iter().zip(model.parameters());
    let changes: Vec<f64> = pairs.map(|(parameter, file)| parameter - file).collect();
    let mut change = scaled(&changes);
    let mut basis: Vec<Vec<f64>> = Vec::with_capacity(directions.len());
    for direction in directions {
        let mut vector = scaled(direction);
        // Twice is enough (Giraud, Langou and Rozložník 2005).
        for other in basis.iter().chain(&basis) {
            remove(&mut vector, other);
        }
        let size = libm::sqrt(dot(&vector, &vector));
        if size > 0.0 {
            vector.iter_mut().for_each(|x| *x /= size);
            remove(&mut change, &vector);
            basis.push(vector);
        }
    }
    let file = model.parameters().iter().zip(norms);
    for ((parameter, (file, norm)), change) in parameters.iter_mut().zip(file).zip(change) {
        if *norm > 0.0 {
            *parameter = file + change / norm;
        }
    }
}

fn remove(from: &mut [f64], unit: &[f64]) {
    let along = dot(from, unit);
    for (x, unit) in from.iter_mut().zip(unit) {
        *x -= along * unit;
    }
}

pub(crate) fn condition(r: &[f64], width: usize) -> f64 {
    let values = singular(&unit_columns(r, width), width).values;
    let largest = values.iter().fold(0.0f64, |a, b| a.max(*b));
    let least = values.iter().fold(f64::INFINITY, |a, b| a.min(*b));
    largest / least
}

fn unit_columns(r: &[f64], width: usize) -> Vec<f64> {
    let norms = norms(r, width);
    let scaled = |(i, x): (usize, &f64)| match norms[i % width] {
        0.0 => 0.0,
        norm => x / norm,
    };
    r.iter().enumerate().map(scaled).collect()
}
