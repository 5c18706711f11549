//! The nearest bodies that exist.
//!
//! Least squares know nothing of bodies: a link may come out with a negative moment. A link
//! exists exactly if its pseudo-inertia
//!
//! ```text
//! J = [Σ h; hᵀ m],   Σ = ∫ r rᵀ dm,  h = ∫ r dm
//! ```
//!
//! is positive definite (Wensing, Kim and Slotine 2018; for Σ alone Traversaro, Brossette,
//! Escande and Nori 2016), and a drive if its inertia and friction are not negative. Among all
//! parameters θ of links and drives that do, those are sought whose base parameters are
//! nearest to the free ones in the metric of the data,
//!
//! ```text
//! min ½ ‖R (M θ − π̂)‖² + μ Σ_i [tr(J_i⁻¹(0) J_i) − log det J_i] + μ Σ_k [a_k/a_k(0) − log a_k]
//! ```
//!
//! for μ → 0. The bracket is the entropic distance of Lee, Wensing and Park 2020 from the
//! robot file's body: barrier, and choice among the many θ of the same base parameters.
//! With J = L Lᵀ and G_a = L⁻¹ E_a L⁻ᵀ a step of Newton's method is a least squares problem,
//! rows R M and √μ G, and is solved as one: nothing is squared. Drives' parameters that the
//! barrier alone keeps above zero are zero in the end.

mod barrier;
mod body;

use dalembert_codegen::workspace::Parameter;

use crate::dense::{apply, back_substitute, dot, split};
use crate::error::Error;
use crate::fit::Fit;
use crate::model::{Column, Model, place};
use crate::triangle::Triangle;
use barrier::Barrier;

/// The factor of the barrier at the end: its part of the squared distance is below
/// 2 μ times four a link and one a drive's parameter.
const LAST: f64 = 5e-9;
/// The least part of the squared distance that is left of the barrier: it then adds a thousand
/// millionth at most, and steps for less are those of rounding.
const HIDDEN: f64 = 1e-11;
/// The factor by which the barrier weakens at first. The objective is self-concordant: steps at
/// one strength are bounded by (1/f − 1 + log f) times the barrier's parameter, some 50, over
/// what a step gains, 0.1 or more (Boyd and Vandenberghe 2004, 11.5). Where the free parameters
/// are far from all bodies, a half takes thousands: the factor then comes nearer to one.
const WEAKEN: f64 = 0.5;
/// Few Newton steps at one strength of the barrier, and as many as there should be.
const FEW: usize = 4;
const ENOUGH: usize = 8;
/// Newton steps of a search; 18 350 are the most that were seen, at 7900 standard errors.
const STEPS: usize = 100_000;
/// The part of a drive's usual parameter that is nothing. The barrier keeps less than it where
/// the data ask for less than zero, and the noise hides a million times as much.
const NOTHING: f64 = 1e-6;

/// Parameters of bodies and drives that exist.
#[derive(Clone, Debug, PartialEq)]
pub struct Bodies {
    /// The ten of a full regressor, of a base that floats and then of each link: m, m x, m y, m z, Ixx,
    /// Iyy, Izz, Ixy, Iyz and Ixz about the origin and in the axes of the body's own frame.
    pub links: Vec<[f64; 10]>,
    /// Rotor inertias; the robot file's where they are not identified.
    pub armature: Vec<f64>,
    /// Viscous friction, as well.
    pub viscous: Vec<f64>,
    /// Coulomb friction, as well.
    pub coulomb: Vec<f64>,
    /// The offsets of the torques; zero where they are not identified.
    pub offset: Vec<f64>,
    /// π of these bodies, an entry a column of the model.
    pub parameters: Vec<f64>,
    /// ‖R (π − π̂)‖: how far they are from the free parameters, all standard errors together.
    pub distance: f64,
    /// The largest |π_k − π̂_k| in standard errors of π̂_k.
    pub moved: f64,
    /// Names of the drives' parameters that stopped at zero, as `armature2`: less fits better.
    pub stopped: Vec<String>,
    /// Steps of Newton's method that were taken.
    pub steps: usize,
}

impl Bodies {
    /// Returns π of the file by [`identified`](crate::identified): without the sensors' offsets.
    pub fn file_parameters(&self, model: &Model) -> Vec<f64> {
        let entry = |(value, column): (&f64, &Column)| match column {
            Column::Offset(_) => 0.0,
            _ => *value,
        };
        let entries = self.parameters.iter().zip(model.columns());
        entries.map(entry).collect()
    }
}

/// An entry of θ.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Unknown {
    /// A body's, of a base that floats and the links, and its place among ten.
    Body(usize, usize),
    Armature(usize),
    Viscous(usize),
    Coulomb(usize),
    Offset(usize),
}

/// Finds the consistent bodies nearest to what was identified.
///
/// # Errors
/// [`Error::NotConverged`].
pub fn consistent(model: &Model, fit: &Fit) -> Result<Bodies, Error> {
    let width = model.columns().len();
    let unknowns = unknowns(model);
    let map = map(model, &unknowns);
    // R M, and R π̂.
    let mut metric = vec![0.0; width * unknowns.len()];
    for (i, row) in fit.factor.chunks(width).enumerate() {
        for (k, r) in row.iter().enumerate().filter(|(_, r)| **r != 0.0) {
            for (sum, m) in metric[i * unknowns.len()..].iter_mut().zip(&map[k]) {
                *sum += r * m;
            }
        }
    }
    let wanted = apply(&fit.factor, &fit.parameters);

    let barrier = Barrier::new(model, &unknowns, &fit.noise);
    let mut theta = barrier.start();
    let distance = |theta: &[f64]| -> f64 {
        let rows = apply(&metric, theta).into_iter().zip(&wanted);
        rows.map(|(x, w)| (x - w).powi(2)).sum()
    };
    // So strong that the robot file's bodies are near the best ones.
    let mut strength = distance(&theta).max(LAST / WEAKEN);
    let (mut weaken, mut steps) = (WEAKEN, 0);
    while strength > LAST.max(HIDDEN * distance(&theta)) {
        strength = (strength * weaken).max(LAST);
        let before = steps;
        let value = |theta: &[f64]| {
            let barrier = barrier.value(theta)?;
            Some(0.5 * distance(theta) + strength * barrier)
        };
        loop {
            if steps == STEPS {
                return Err(Error::NotConverged);
            }
            let now = value(&theta).ok_or(Error::NotConverged)?;
            let along = newton(&metric, &wanted, &barrier, &theta, strength)?;
            steps += 1;
            let mut length = 1.0;
            let next = loop {
                let moved = theta.iter().zip(&along).map(|(x, d)| x + length * d);
                let next: Vec<f64> = moved.collect();
                match value(&next) {
                    Some(then) if then <= now => break Some((next, now - then)),
                    _ if length < 1e-12 => break None,
                    _ => length *= 0.5,
                }
            };
            // Where rounding hides what is left, there is no better point.
            let Some((next, gain)) = next else { break };
            theta = next;
            // Below the rounding of the value itself there is nothing left to gain.
            if gain <= (1e-4 * strength).max(1e-14 * now) {
                break;
            }
        }
        weaken = match steps - before {
            0..=FEW => (weaken * weaken).max(0.1),
            few if few <= ENOUGH => weaken,
            _ => libm::sqrt(weaken),
        };
    }
    let stopped = barrier.stopped(&theta, NOTHING);
    stopped.iter().for_each(|at| theta[*at] = 0.0);
    let named = stopped.iter().filter_map(|at| body::named(unknowns[*at]));
    Ok(Bodies {
        distance: libm::sqrt(distance(&theta)),
        stopped: named.collect(),
        steps,
        ..body::bodies(model, fit, &unknowns, &map, &theta)
    })
}

fn newton(
    metric: &[f64],
    wanted: &[f64],
    barrier: &Barrier,
    theta: &[f64],
    strength: f64,
) -> Result<Vec<f64>, Error> {
    let count = theta.len();
    let mut triangle = Triangle::new(count + 1);
    for (row, wanted) in metric.chunks(count).zip(wanted) {
        let rest = wanted - dot(row, theta);
        triangle.push(row.iter().copied().chain([rest]));
    }
    let root = libm::sqrt(strength);
    for row in barrier.rows(theta).ok_or(Error::NotConverged)? {
        triangle.push(row.iter().map(|x| root * x));
    }
    let (r, z) = split(&triangle.reduced(), count);
    let along = back_substitute(&r, &z);
    let is_finite = along.iter().all(|x| x.is_finite());
    is_finite.then_some(along).ok_or(Error::NotConverged)
}

fn unknowns(model: &Model) -> Vec<Unknown> {
    let of_body = |body| (0..10).map(move |k| Unknown::Body(body, k));
    let bodies = 0..model.joints() + model.first_link();
    let mut unknowns: Vec<Unknown> = bodies.flat_map(of_body).collect();
    let columns = model.columns().iter();
    for (unknown, _) in columns.flat_map(|column| terms(model, *column)) {
        if !unknowns.contains(&unknown) {
            unknowns.push(unknown);
        }
    }
    unknowns
}

fn terms(model: &Model, column: Column) -> Vec<(Unknown, f64)> {
    let unknown = |parameter: Parameter| match parameter {
        Parameter::Base(moment) => Unknown::Body(0, place(moment)),
        Parameter::Link(link, moment) => Unknown::Body(model.first_link() + link, place(moment)),
        Parameter::Armature(joint) => Unknown::Armature(joint),
        Parameter::Viscous(joint) => Unknown::Viscous(joint),
    };
    let term = |(parameter, factor): &(Parameter, f64)| (unknown(*parameter), *factor);
    match column {
        Column::Base(base) => model.combination(base).iter().map(term).collect(),
        Column::Coulomb(joint) => vec![(Unknown::Coulomb(joint), 1.0)],
        Column::Offset(joint) => vec![(Unknown::Offset(joint), 1.0)],
    }
}

/// Returns M, a row a column of the model: π = M θ.
fn map(model: &Model, unknowns: &[Unknown]) -> Vec<Vec<f64>> {
    let rows = model.columns().iter().map(|column| {
        let terms = terms(model, *column);
        let entry = |of: &Unknown| {
            let factors = terms.iter().filter(|(unknown, _)| unknown == of);
            factors.map(|(_, factor)| factor).sum()
        };
        unknowns.iter().map(entry).collect()
    });
    rows.collect()
}
