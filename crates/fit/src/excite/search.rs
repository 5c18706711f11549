//! The smooth condition of a trajectory, its derivative, and steps within the limits.

use super::POWER;
use crate::dense::singular;
use crate::error::Error;
use crate::fourier::Trajectory;
use crate::limits::Limits;
use crate::model::Model;
use crate::random::{Random, within};
use crate::reference::Reference;
use crate::triangle::Triangle;

/// The shortest step that is tried, in parts of the limits.
const SHORTEST: f64 = 1e-4;

pub(super) struct Search<'a> {
    pub(super) model: &'a Model,
    pub(super) noise: &'a [f64],
    pub(super) samples: usize,
    pub(super) reference: Reference,
}

impl Search<'_> {
    pub(super) fn draw(&self, period: f64, harmonics: usize, random: &mut Random) -> Trajectory {
        let limits = self.model.limits();
        let mut series = |of: &Limits| -> Vec<f64> {
            let draws = (0..harmonics).map(|_| within(random, of.velocity));
            draws.collect()
        };
        let middle = limits.iter().map(|of| of.middle() + 0.1 * of.reach());
        let drawn = Trajectory {
            period,
            cosines: limits.iter().map(&mut series).collect(),
            sines: limits.iter().map(&mut series).collect(),
            middle: middle.collect(),
        };
        drawn.filling(limits)
    }

    fn times(&self, trajectory: &Trajectory) -> impl Iterator<Item = f64> + use<> {
        let step = trajectory.period / self.samples as f64;
        (0..self.samples).map(move |k| step * k as f64)
    }

    /// Evaluates W at a state, row by row, columns divided by those of the reference motion.
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
        let mut triangle = Triangle::new(width);
        for time in self.times(trajectory) {
            for row in self.rows(&trajectory.at(time))?.chunks(width) {
                triangle.push(row.iter().copied());
            }
        }
        Ok(triangle.reduced())
    }

    pub(super) fn value(&self, trajectory: &Trajectory) -> Result<f64, Error> {
        let width = self.model.columns().len();
        let values = singular(&self.factor(trajectory)?, width).values;
        let sum = |power: i32| -> f64 { values.iter().map(|s| s.powi(power)).sum() };
        let [large, small] = [sum(2 * POWER), sum(-2 * POWER)].map(libm::log);
        Ok((large + small) / f64::from(2 * POWER))
    }

    pub(super) fn condition(&self, trajectory: &Trajectory) -> Result<f64, Error> {
        let width = self.model.columns().len();
        Ok(crate::fit::condition(&self.factor(trajectory)?, width))
    }

    pub(super) fn descended(
        &self,
        (mut least, mut best): (f64, Trajectory),
        steps: usize,
    ) -> Result<(f64, Trajectory), Error> {
        let mut length = 0.3;
        'steps: for _ in 0..steps {
            let gradient = self.gradient(&best)?;
            loop {
                let next = self.moved(&best, &gradient, length);
                let value = self.value(&next)?;
                if value < least {
                    (best, least) = (next, value);
                    length = (2.0 * length).min(1.0);
                    break;
                }
                length *= 0.5;
                if length < SHORTEST {
                    break 'steps;
                }
            }
        }
        Ok((least, best))
    }

    /// The derivatives stand in the places of the middles, a and b.
    fn gradient(&self, trajectory: &Trajectory) -> Result<Trajectory, Error> {
        let n = self.model.joints();
        let g = self.metric(trajectory)?;
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
            let width = self.model.columns().len();
            let mut weights = Vec::with_capacity(n * width);
            for (row, noise) in rows.chunks(width).zip(self.noise) {
                let products = crate::dense::apply(&g, row);
                let pairs = products.iter().zip(&self.reference.norms);
                weights.extend(pairs.map(|(w, norm)| w / (noise * norm)));
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

    /// Computes G: dF = tr(G dA)/2.
    fn metric(&self, trajectory: &Trajectory) -> Result<Vec<f64>, Error> {
        let width = self.model.columns().len();
        let decomposition = singular(&self.factor(trajectory)?, width);
        let sum = |power: i32| -> f64 { decomposition.values.iter().map(|s| s.powi(power)).sum() };
        let [large, small] = [sum(2 * POWER), sum(-2 * POWER)];
        let weight = |s: f64| s.powi(2 * POWER - 2) / large - s.powi(-2 * POWER - 2) / small;
        let mut g = vec![0.0; width * width];
        for (value, v) in decomposition.values.iter().zip(&decomposition.directions) {
            let weight = weight(*value);
            for (row, vi) in g.chunks_mut(width).zip(v) {
                for (g, vk) in row.iter_mut().zip(v) {
                    *g += weight * vi * vk;
                }
            }
        }
        Ok(g)
    }

    /// Lengths are in parts of the limits. The way back to them scales a joint's whole motion x by
    /// its bound b: F changes by g − (g·x) ∇b/b and not by g.
    fn moved(&self, from: &Trajectory, gradient: &Trajectory, length: f64) -> Trajectory {
        let limits = self.model.limits();
        let used = from.used(limits);
        let mut steps: Vec<Vec<f64>> = Vec::with_capacity(limits.len());
        let mut square = 0.0;
        for (i, of) in limits.iter().enumerate() {
            let place = coordinates(from, i, of.middle());
            let mut direction = coordinates(gradient, i, 0.0);
            let (bound, slope) = &used[i];
            let along = crate::dense::dot(&direction, &place) / bound;
            for (g, b) in direction.iter_mut().zip(slope) {
                *g -= along * b;
            }
            for (k, coordinate) in direction.iter_mut().enumerate() {
                let unit = if k == 0 { of.reach() } else { of.velocity };
                square += (*coordinate * unit).powi(2);
                *coordinate *= unit * unit;
            }
            steps.push(direction);
        }
        let factor = match square > 0.0 {
            true => length / libm::sqrt(square),
            false => 0.0,
        };
        let mut next = from.clone();
        for (i, step) in steps.iter().enumerate() {
            let harmonics = next.cosines[i].iter_mut().chain(&mut next.sines[i]);
            let entries = [&mut next.middle[i]].into_iter().chain(harmonics);
            entries.zip(step).for_each(|(x, step)| *x -= factor * step);
        }
        next.filling(limits)
    }
}

fn coordinates(of: &Trajectory, joint: usize, middle: f64) -> Vec<f64> {
    let mut coordinates = vec![of.middle[joint] - middle];
    coordinates.extend(of.cosines[joint].iter().chain(&of.sines[joint]));
    coordinates
}
