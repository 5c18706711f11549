//! A trajectory that tells the parameters apart.
//!
//! Bad excitation is why identification fails: joints that swing one after the other leave most
//! products of inertia in the noise. Among the [trajectories](crate::fourier) within the joints'
//! limits one is sought whose regressor W, rows divided by the joints' noise and columns by their
//! size in the [reference motion](mod@crate::reference), has a small condition. With A = WᵀW,
//!
//! ```text
//! F = (log tr Aᵖ + log tr A⁻ᵖ) / 2p,   log cond W ≤ F ≤ log cond W + (log k)/p
//! ```
//!
//! is smooth where singular values cross; dF = tr(G dA)/2 with
//! G = Aᵖ⁻¹/tr Aᵖ − A⁻ᵖ⁻¹/tr A⁻ᵖ, and dW is the derivative of the regressor by q, q̇ and q̈, in
//! dual numbers through the same formula. Steps go along the gradient and back to the
//! limits; starts are seeded, and nothing depends on the machine.

mod search;

use crate::error::{Error, check, ensure};
use crate::fourier::Trajectory;
use crate::model::Model;
use crate::random::Random;
use crate::reference::Reference;
use search::Search;

/// p of the smooth condition.
const POWER: i32 = 3;

/// The work of a search for a motion, and its measure.
#[derive(Clone, Debug, PartialEq)]
pub struct Effort {
    /// Sines and cosines of each joint.
    pub harmonics: usize,
    /// Times at which the regressor is evaluated, in a period.
    pub samples: usize,
    /// Random trajectories that the search begins with.
    pub starts: usize,
    /// The number of them, the best first, that are improved.
    pub descents: usize,
    /// Steps from each of these.
    pub steps: usize,
    /// The seed of the starts.
    pub seed: u64,
}

impl Default for Effort {
    /// Returns five harmonics at 60 times; 60 starts, 80 steps from each of the best two.
    fn default() -> Self {
        Effort {
            harmonics: 5,
            samples: 60,
            starts: 60,
            descents: 2,
            steps: 80,
            seed: 1,
        }
    }
}

/// Finds a trajectory of so many seconds within the limits whose condition is small at this noise
/// of the torques; returns its [condition](crate::Fit::condition), too.
///
/// # Errors
/// [`Error::Option`] for an effort or a period out of range, and [`Error::Length`].
pub fn excite(
    model: &Model,
    noise: &[f64],
    period: f64,
    effort: &Effort,
) -> Result<(Trajectory, f64), Error> {
    let is_period = period > 0.0 && period.is_finite();
    ensure(is_period, "`period` has to be a positive number of seconds")?;
    ensure(
        model.robot().floating.is_none(),
        "a base that floats cannot follow a trajectory: log it as it moves",
    )?;
    let has_harmonics = (2..=50).contains(&effort.harmonics);
    ensure(has_harmonics, "an effort has 2 to 50 harmonics")?;
    let has_samples = (2 * effort.harmonics..=100_000).contains(&effort.samples);
    let samples = "an effort has at least two samples a harmonic, and at most 100000";
    ensure(has_samples, samples)?;
    check("noise", noise, model.joints())?;
    let is_noise = noise.iter().all(|noise| *noise > 0.0);
    ensure(is_noise, "each joint's noise has to be a positive number")?;
    let search = Search {
        model,
        noise,
        samples: effort.samples,
        reference: Reference::new(model, noise)?,
    };
    let mut random = Random::new(effort.seed);
    let mut starts = Vec::with_capacity(effort.starts);
    for _ in 0..effort.starts {
        let start = search.draw(period, effort.harmonics, &mut random);
        starts.push((search.value(&start)?, start));
    }
    // The first of equal ones that was drawn.
    starts.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut best: Option<(f64, Trajectory)> = None;
    for start in starts.into_iter().take(effort.descents) {
        let descent = search.descended(start, effort.steps)?;
        if best.as_ref().is_none_or(|best| descent.0 < best.0) {
            best = Some(descent);
        }
    }
    let Some((_, best)) = best else {
        return Err(Error::Option("an effort has a start, and a descent"));
    };
    let condition = search.condition(&best)?;
    Ok((best, condition))
}
