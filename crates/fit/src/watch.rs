//! Residuals that change: collisions, wear, another payload.
//!
//! Page's cumulative sums (1954), of each joint in both directions: in units of the noise
//!
//! ```text
//! s⁺ ← max(0, s⁺ + r/σ − k),   s⁻ ← max(0, s⁻ − r/σ − k)
//! ```
//!
//! A change of twice k is found soonest. White noise of σ reaches a bar b once in about
//! e^(2 k (b + 1.166))/(2 k²) states and direction (Siegmund 1985).

use crate::error::{Error, check, ensure};

/// Sums of residuals, a pair a joint.
#[derive(Clone, Debug, PartialEq)]
pub struct Watch {
    noise: Vec<f64>,
    drift: f64,
    bar: f64,
    sums: Vec<[f64; 2]>,
}

impl Watch {
    /// Returns the watch over residuals with this noise, N·m or N; drift k and bar are in units of
    /// it.
    ///
    /// # Errors
    /// [`Error::Value`] and [`Error::Option`].
    pub fn new(noise: &[f64], drift: f64, bar: f64) -> Result<Watch, Error> {
        check("noise", noise, noise.len())?;
        check("drift and bar", &[drift, bar], 2)?;
        let are_positive = noise.iter().chain([&drift, &bar]).all(|x| *x > 0.0);
        let expected = "the noise, the drift and the bar of a watch have to be positive numbers";
        ensure(are_positive, expected)?;
        Ok(Watch {
            noise: noise.to_vec(),
            drift,
            bar,
            sums: vec![[0.0; 2]; noise.len()],
        })
    }

    /// Returns the largest of the sums: over a log in which nothing happens, what a bar has to be
    /// well above. A model is not exact, least of all where friction changes its sign.
    pub fn level(&self) -> f64 {
        let sums = self.sums.iter().flatten();
        sums.fold(0.0, |max, sum| max.max(*sum))
    }

    /// Adds the residuals of a state; returns a joint whose sum is over the bar, and then begins
    /// anew.
    ///
    /// # Errors
    /// [`Error::Length`] and [`Error::Value`].
    pub fn push(&mut self, residuals: &[f64]) -> Result<Option<usize>, Error> {
        check("residuals", residuals, self.noise.len())?;
        let mut over = None;
        let joints = residuals.iter().zip(&self.noise).zip(&mut self.sums);
        for (joint, ((residual, noise), sums)) in joints.enumerate() {
            for (sum, sign) in sums.iter_mut().zip([1.0, -1.0]) {
                *sum = (*sum + sign * residual / noise - self.drift).max(0.0);
                if *sum > self.bar && over.is_none() {
                    over = Some(joint);
                }
            }
        }
        if over.is_some() {
            self.sums.fill([0.0; 2]);
        }
        Ok(over)
    }
}
