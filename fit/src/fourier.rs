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
    /// Of each joint, the position about which it swings, rad or m.
    pub middle: Vec<f64>,
    /// a_il, rad/s or m/s.
    pub cosines: Vec<Vec<f64>>,
    /// b_il
    pub sines: Vec<Vec<f64>>,
}

impl Trajectory {
    /// ω, rad/s.
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

    /// The highest frequency that it has, Hz.
    pub fn highest_frequency(&self) -> f64 {
        let harmonics = self.cosines.iter().map(Vec::len).max().unwrap_or(0);
        harmonics as f64 / self.period
    }

    /// Bounds how far each joint gets from its middle, its velocity and its acceleration.
    pub fn bounds(&self) -> Vec<[f64; 3]> {
        let joints = self.cosines.iter().zip(&self.sines);
        let each = joints.map(|(cosines, sines)| {
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
        each.collect()
    }

    /// Makes it begin at rest, then scales each joint's motion until it is within its limits.
    #[must_use]
    pub fn within(mut self, limits: &[Limits]) -> Trajectory {
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
        let bounds = self.bounds();
        for (i, (limits, bounds)) in limits.iter().zip(bounds).enumerate() {
            let aside = self.middle[i] - limits.middle();
            // A little less than the limits: of a motion at the very limit rounding may
            // show more.
            let part = |bound: f64, limit: f64| match bound > 0.0 {
                true => limit * (1.0 - 1e-9) / bound,
                false => f64::INFINITY,
            };
            let factor = 1.0f64
                .min(part(bounds[0] + aside.abs(), limits.reach()))
                .min(part(bounds[1], limits.velocity))
                .min(part(bounds[2], limits.acceleration));
            self.middle[i] = limits.middle() + factor * aside;
            for x in self.cosines[i].iter_mut().chain(&mut self.sines[i]) {
                *x *= factor;
            }
        }
        self
    }
}
