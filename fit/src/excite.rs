//! A trajectory that tells the parameters apart.
//!
//! Bad excitation is why identification fails: joints that swing one after the other leave
//! most products of inertia in the noise. Among the [trajectories](crate::fourier) within
//! the joints' limits one is sought whose regressor W, rows divided by the joints' noise and
//! columns by their size in the [reference motion](mod@crate::reference), has a small
//! condition. With A = WᵀW,
//!
//! ```text
//! F = (log tr Aᵖ + log tr A⁻ᵖ) / 2p,   log cond W ≤ F ≤ log cond W + (log k)/p
//! ```
//!
//! is smooth where singular values cross; dF = tr(G dA)/2 with
//! G = Aᵖ⁻¹/tr Aᵖ − A⁻ᵖ⁻¹/tr A⁻ᵖ, and dW is the derivative of the regressor by q, q̇ and q̈, in
//! dual numbers through the same formula. Steps go along the gradient and back into the
//! limits; starts are seeded, and nothing depends on the machine.

use crate::dense::singular;
use crate::error::Error;
use crate::fourier::Trajectory;
use crate::model::Model;
use crate::random::{Random, within};
use crate::reference::Reference;
use crate::triangle::Triangle;

/// p of the smooth condition.
const POWER: i32 = 3;

/// How long to look, and for what.
#[derive(Clone, Debug, PartialEq)]
pub struct Effort {
    /// Sines and cosines of each joint.
    pub harmonics: usize,
    /// Times at which the regressor is evaluated, in a period.
    pub samples: usize,
    /// Random trajectories that the search begins with.
    pub starts: usize,
    /// Steps from the best of them.
    pub steps: usize,
    /// What the starts are drawn from.
    pub seed: u64,
}

impl Default for Effort {
    /// Five harmonics at 60 times, from the best of 20, 80 steps.
    fn default() -> Self {
        Effort {
            harmonics: 5,
            samples: 60,
            starts: 20,
            steps: 80,
            seed: 1,
        }
    }
}

/// Finds a trajectory of so many seconds within the joints' limits that has a small condition
/// where each joint's torque has this noise; returns it with its condition, columns of
/// length one as in [`Fit::condition`](crate::Fit::condition).
///
/// # Errors
/// [`Error::Option`] for an effort or a period out of range, and [`Error::Length`].
pub fn excite(
    model: &Model,
    noise: &[f64],
    period: f64,
    effort: &Effort,
) -> Result<(Trajectory, f64), Error> {
    if !(period > 0.0 && period.is_finite()) {
        return Err(Error::Option(
            "`period` has to be a positive number of seconds",
        ));
    }
    if !(2..=50).contains(&effort.harmonics) || effort.starts == 0 {
        return Err(Error::Option(
            "an effort has 2 to 50 harmonics, and a start",
        ));
    }
    if effort.samples < 2 * effort.harmonics || effort.samples > 100_000 {
        return Err(Error::Option(
            "an effort has at least two samples a harmonic, and at most 100000",
        ));
    }
    crate::error::check("noise", noise, model.joints())?;
    if noise.iter().any(|noise| *noise <= 0.0) {
        return Err(Error::Option(
            "each joint's noise has to be a positive number",
        ));
    }
    let search = Search {
        model,
        noise,
        samples: effort.samples,
        reference: Reference::new(model, noise)?,
    };
    let mut random = Random::new(effort.seed);
    let mut best = search.draw(period, effort.harmonics, &mut random);
    let mut least = search.value(&best)?;
    for _ in 1..effort.starts {
        let other = search.draw(period, effort.harmonics, &mut random);
        let value = search.value(&other)?;
        if value < least {
            (best, least) = (other, value);
        }
    }
    let mut length = 0.3;
    for _ in 0..effort.steps {
        let gradient = search.gradient(&best)?;
        // A step that does not gain is halved; the next one is tried twice as long.
        while length > 1e-4 {
            let next = search.moved(&best, &gradient, length);
            let value = search.value(&next)?;
            if value < least {
                (best, least) = (next, value);
                length = (2.0 * length).min(1.0);
                break;
            }
            length *= 0.5;
        }
    }
    let condition = search.condition(&best)?;
    Ok((best, condition))
}

struct Search<'a> {
    model: &'a Model,
    noise: &'a [f64],
    samples: usize,
    reference: Reference,
}

impl Search<'_> {
    fn draw(&self, period: f64, harmonics: usize, random: &mut Random) -> Trajectory {
        let limits = self.model.limits();
        let mut series =
            |limit: f64| -> Vec<f64> { (0..harmonics).map(|_| within(random, limit)).collect() };
        let drawn = Trajectory {
            period,
            cosines: limits.iter().map(|of| series(of.velocity)).collect(),
            sines: limits.iter().map(|of| series(of.velocity)).collect(),
            middle: limits
                .iter()
                .map(|of| of.middle() + 0.1 * of.reach())
                .collect(),
        };
        drawn.within(limits)
    }

    fn times(&self, trajectory: &Trajectory) -> impl Iterator<Item = f64> + use<> {
        let step = trajectory.period / self.samples as f64;
        (0..self.samples).map(move |k| step * k as f64)
    }

    /// W of a state, row by row, columns divided by those of the reference motion.
    fn rows(&self, state: &[Vec<f64>; 3]) -> Result<Vec<f64>, Error> {
        let width = self.model.columns().len();
        let [q, qd, qdd] = state;
        let mut y = self.model.regressor(q, qd, qdd)?;
        for (row, noise) in y.chunks_mut(width).zip(self.noise) {
            for (y, norm) in row.iter_mut().zip(&self.reference.norms) {
                *y /= noise * norm;
            }
        }
        Ok(y)
    }

    fn factor(&self, trajectory: &Trajectory) -> Result<Vec<f64>, Error> {
        let width = self.model.columns().len();
        let mut all = Triangle::new(width);
        for time in self.times(trajectory) {
            let y = self.rows(&trajectory.at(time))?;
            y.chunks(width)
                .for_each(|row| all.push(row.iter().copied()));
        }
        Ok(all.reduced())
    }

    fn value(&self, trajectory: &Trajectory) -> Result<f64, Error> {
        let width = self.model.columns().len();
        let values = singular(&self.factor(trajectory)?, width).values;
        let sum = |power: i32| -> f64 { values.iter().map(|s| s.powi(power)).sum() };
        let [large, small] = [sum(2 * POWER), sum(-2 * POWER)].map(libm::log);
        Ok((large + small) / f64::from(2 * POWER))
    }

    fn condition(&self, trajectory: &Trajectory) -> Result<f64, Error> {
        let width = self.model.columns().len();
        let r = self.factor(trajectory)?;
        let with_last: Vec<f64> = r
            .chunks(width)
            .flat_map(|row| row.iter().copied().chain([0.0]))
            .collect();
        Ok(crate::fit::condition(&with_last, width))
    }

    /// dF by every middle, a and b, in the order of a trajectory's joints.
    fn gradient(&self, trajectory: &Trajectory) -> Result<Trajectory, Error> {
        let (n, width) = (self.model.joints(), self.model.columns().len());
        let found = singular(&self.factor(trajectory)?, width);
        let sum = |power: i32| -> f64 { found.values.iter().map(|s| s.powi(power)).sum() };
        let [large, small] = [sum(2 * POWER), sum(-2 * POWER)];
        let weight = |s: f64| s.powi(2 * POWER - 2) / large - s.powi(-2 * POWER - 2) / small;
        let mut g = vec![0.0; width * width];
        for (value, v) in found.values.iter().zip(&found.directions) {
            let weight = weight(*value);
            for (row, vi) in g.chunks_mut(width).zip(v) {
                for (g, vk) in row.iter_mut().zip(v) {
                    *g += weight * vi * vk;
                }
            }
        }
        let harmonics = trajectory.cosines.first().map_or(0, Vec::len);
        let mut gradient = Trajectory {
            period: trajectory.period,
            middle: vec![0.0; n],
            cosines: vec![vec![0.0; harmonics]; n],
            sines: vec![vec![0.0; harmonics]; n],
        };
        for time in self.times(trajectory) {
            let state = trajectory.at(time);
            let rows = self.rows(&state)?;
            let mut weights = Vec::with_capacity(n * width);
            for (row, noise) in rows.chunks(width).zip(self.noise) {
                let products = crate::dense::apply(&g, row);
                let own = products.iter().zip(&self.reference.norms);
                weights.extend(own.map(|(w, norm)| w / (noise * norm)));
            }
            let [q, qd, qdd] = &state;
            let slopes = self.model.gradient([q, qd, qdd], &weights);
            for i in 0..n {
                let [position, velocity, acceleration] = [0, 1, 2].map(|k| slopes[k * n + i]);
                gradient.middle[i] += position;
                for l in 0..harmonics {
                    let rate = trajectory.omega() * (l as f64 + 1.0);
                    let (sin, cos) = libm::sincos(rate * time);
                    gradient.cosines[i][l] +=
                        position * sin / rate + velocity * cos - acceleration * rate * sin;
                    gradient.sines[i][l] +=
                        velocity * sin - position * cos / rate + acceleration * rate * cos;
                }
            }
        }
        Ok(gradient)
    }

    /// A step against the gradient, lengths in parts of the limits, back within these.
    fn moved(&self, from: &Trajectory, gradient: &Trajectory, length: f64) -> Trajectory {
        let limits = self.model.limits();
        let scaled = |slope: f64, unit: f64| slope * unit;
        let mut square = 0.0;
        for (i, of) in limits.iter().enumerate() {
            square += scaled(gradient.middle[i], of.reach()).powi(2);
            for slope in gradient.cosines[i].iter().chain(&gradient.sines[i]) {
                square += scaled(*slope, of.velocity).powi(2);
            }
        }
        let step = if square > 0.0 {
            length / libm::sqrt(square)
        } else {
            0.0
        };
        let mut next = from.clone();
        for (i, of) in limits.iter().enumerate() {
            next.middle[i] -= step * gradient.middle[i] * of.reach().powi(2);
            for (series, slopes) in [
                (&mut next.cosines[i], &gradient.cosines[i]),
                (&mut next.sines[i], &gradient.sines[i]),
            ] {
                for (x, slope) in series.iter_mut().zip(slopes) {
                    *x -= step * slope * of.velocity.powi(2);
                }
            }
        }
        next.within(limits)
    }
}
