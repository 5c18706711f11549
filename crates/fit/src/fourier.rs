//! Periodic trajectories of sines, within limits at every time.
//!
//! ```text
//! q̇_i(t) = Σ_l a_il cos ω l t + b_il sin ω l t
//! ```
//!
//! (Swevers, Ganseman, Tükel, De Schutter and Van Brussel 1997). With Σ_l a_il = 0 and
//! Σ_l l b_il = 0 it begins and ends at rest. Each harmonic is at most
//! c_il = √(a_il² + b_il²), so that Σ c_il/(ω l), Σ c_il and Σ c_il ω l bound position,
//! velocity and acceleration at all times, not only where somebody looked.

use crate::limits::Limits;

/// A periodic trajectory.
#[derive(Clone, Debug, PartialEq)]
pub struct Trajectory {
    /// Its period, s.
    pub period: f64,
    /// The position about which each joint swings, rad or m.
    pub middle: Vec<f64>,
    /// a_il, rad/s or m/s.
    pub cosines: Vec<Vec<f64>>,
    /// b_il
    pub sines: Vec<Vec<f64>>,
}

impl Trajectory {
    pub(crate) fn omega(&self) -> f64 {
        2.0 * core::f64::consts::PI / self.period
    }

    /// Evaluates positions, velocities and accelerations at a time, s.
    pub fn at(&self, time: f64) -> [Vec<f64>; 3] {
        let mut state = [self.middle.clone(), vec![], vec![]];
        for (i, (cosines, sines)) in self.cosines.iter().zip(&self.sines).enumerate() {
            let [mut qd, mut qdd] = [0.0; 2];
            for (l, (a, b)) in cosines.iter().zip(sines).enumerate() {
                let rate = self.omega() * (l as f64 + 1.0);
                let (sin, cos) = libm::sincos(rate * time);
                state[0][i] += (a * sin - b * cos) / rate;
                qd += a * cos + b * sin;
                qdd += rate * (b * cos - a * sin);
            }
            state[1].push(qd);
            state[2].push(qdd);
        }
        state
    }

    /// Returns the highest frequency that it has, Hz.
    pub fn highest_frequency(&self) -> f64 {
        let harmonics = self.cosines.iter().map(Vec::len).max().unwrap_or(0);
        harmonics as f64 / self.period
    }

    /// Bounds how far each joint gets from its middle, its velocity and its acceleration.
    pub fn bounds(&self) -> Vec<[f64; 3]> {
        let joints = self.cosines.iter().zip(&self.sines);
        let joint_bounds = joints.map(|(cosines, sines)| {
            let mut bounds = [0.0; 3];
            for (l, (a, b)) in cosines.iter().zip(sines).enumerate() {
                let size = libm::hypot(*a, *b);
                let rate = self.omega() * (l as f64 + 1.0);
                bounds[0] += size / rate;
                bounds[1] += size;
                bounds[2] += size * rate;
            }
            bounds
        });
        joint_bounds.collect()
    }

    /// Returns a smooth bound of the part of its limits that each joint takes, with its derivative
    /// by the joint's middle, cosines and sines. The largest of three bounds would have edges,
    /// where a descent stops; the sixteenth root of the sum of their sixteenth powers is at most 7
    /// % more. Twice the motion has twice the bound.
    pub(crate) fn used(&self, limits: &[Limits]) -> Vec<(f64, Vec<f64>)> {
        const SHARP: i32 = 16;
        let pairs = self.bounds().into_iter().zip(limits).enumerate();
        let gradients = pairs.map(|(i, (bounds, of))| {
            let aside = self.middle[i] - of.middle();
            let limits = [of.reach(), of.velocity, of.acceleration];
            let parts = [
                (bounds[0] + aside.abs()) / limits[0],
                bounds[1] / limits[1],
                bounds[2] / limits[2],
            ];
            let largest = parts.into_iter().fold(f64::MIN_POSITIVE, f64::max);
            let sum: f64 = parts.iter().map(|part| (part / largest).powi(SHARP)).sum();
            let bound = largest * libm::pow(sum, 1.0 / f64::from(SHARP));
            let weight = |k: usize| (parts[k] / bound).powi(SHARP - 1) / limits[k];
            let (cosines, sines) = (&self.cosines[i], &self.sines[i]);
            let mut slope = vec![0.0; 1 + cosines.len() + sines.len()];
            slope[0] = weight(0) * aside.signum();
            for (l, (a, b)) in cosines.iter().zip(sines).enumerate() {
                let size = libm::hypot(*a, *b);
                if size > 0.0 {
                    let rate = self.omega() * (l as f64 + 1.0);
                    let per = weight(0) / rate + weight(1) + weight(2) * rate;
                    slope[1 + l] = per * a / size;
                    slope[1 + cosines.len() + l] = per * b / size;
                }
            }
            (bound, slope)
        });
        gradients.collect()
    }

    /// Makes it begin at rest, and scales each joint's motion until its [bound](Self::used) is one.
    #[must_use]
    pub(crate) fn filling(mut self, limits: &[Limits]) -> Trajectory {
        self.begin_at_rest();
        for (i, (bound, _)) in self.used(limits).into_iter().enumerate() {
            // Below the limits: at the very limit rounding may show more.
            let (middle, factor) = (limits[i].middle(), (1.0 - 1e-9) / bound);
            self.middle[i] = middle + factor * (self.middle[i] - middle);
            let harmonics = self.cosines[i].iter_mut().chain(&mut self.sines[i]);
            harmonics.for_each(|x| *x *= factor);
        }
        self
    }

    fn begin_at_rest(&mut self) {
        for (cosines, sines) in self.cosines.iter_mut().zip(&mut self.sines) {
            let count = cosines.len() as f64;
            let mean = cosines.iter().sum::<f64>() / count;
            cosines.iter_mut().for_each(|a| *a -= mean);
            let orders = || (1..).map(f64::from);
            let along: f64 = orders().zip(&*sines).map(|(l, b)| l * b).sum();
            let norm: f64 = orders().take(sines.len()).map(|l| l * l).sum();
            for (l, b) in orders().zip(sines) {
                *b -= along / norm * l;
            }
        }
    }
}
