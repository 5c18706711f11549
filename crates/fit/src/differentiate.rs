//! Velocities and accelerations of encoders, by a filter without delay.
//!
//! A polynomial of degree 4 is fitted to 2m + 1 positions; its value, slope and curvature in
//! the middle are q, q̇ and q̈ there (Savitzky and Golay 1964). All three are one filter's: they
//! belong to the same instant, have no phase, and are exact for motion of degree 4. A filter
//! with delay, or one whose q̇ and q̈ lag differently, would show up as inertia and friction.
//!
//! The window is the longest that damps nothing of the motion: at the highest frequency that
//! the motion has, gains of q, q̇ and q̈ may be off by [`Differentiator::ERROR`]. Longer windows
//! bias the parameters, in proportion to what they damp; shorter ones leave more of the
//! encoders' steps in q̈, where they grow as m^−5/2, and noise in Y biases towards zero.
//! Torques are not filtered: their noise stays white, so that standard errors stay right.
//! Positions closer than m to either end of a log have no derivative and are left out.

use crate::dense::dot;
use crate::error::{Error, check, ensure};

/// A filter for positions at equal times.
#[derive(Clone, Debug, PartialEq)]
pub struct Differentiator {
    /// Weights of q, q̇ and q̈ for each place of the window.
    weights: [Vec<f64>; 3],
}

impl Differentiator {
    /// By how much gains may be off at the highest frequency of the motion.
    pub const ERROR: f64 = 1e-3;
    /// The longest half of a window.
    pub const LONGEST: usize = 500;

    /// Returns the filter of a window of `2 half + 1` positions, `period` seconds apart.
    ///
    /// # Errors
    /// [`Error::Option`] unless the period is positive and `half` is 3 to
    /// [`Differentiator::LONGEST`].
    pub fn new(period: f64, half: usize) -> Result<Differentiator, Error> {
        let is_period = period > 0.0 && period.is_finite();
        ensure(is_period, "`period` has to be a positive number of seconds")?;
        let is_half = (3..=Differentiator::LONGEST).contains(&half);
        ensure(is_half, "half a window is 3 to 500 positions long")?;
        // Even and odd powers are orthogonal on a symmetric window. This unit keeps sums near one.
        let unit = half as f64;
        let places = || (-(half as i64)..=half as i64).map(|j| j as f64 / unit);
        let sum = |power: i32| -> f64 { places().map(|x| x.powi(power)).sum() };
        let [s0, s2, s4, s6, s8] = [0, 2, 4, 6, 8].map(sum);
        let [a, b, c] = [s4 * s8 - s6 * s6, s6 * s4 - s2 * s8, s2 * s6 - s4 * s4];
        let det = s0 * a + s2 * b + s4 * c;
        let middle = |x: f64| (a + b * x * x + c * x.powi(4)) / det;
        let [d, e] = [s0 * s8 - s4 * s4, s2 * s4 - s0 * s6];
        let bend = |x: f64| 2.0 * (b + d * x * x + e * x.powi(4)) / det;
        let slope = |x: f64| (s6 * x - s4 * x.powi(3)) / (s2 * s6 - s4 * s4);
        let time = unit * period;
        Ok(Differentiator {
            weights: [
                places().map(middle).collect(),
                places().map(|x| slope(x) / time).collect(),
                places().map(|x| bend(x) / (time * time)).collect(),
            ],
        })
    }

    /// Returns the filter for motion up to a frequency in Hz: the longest window whose gains are off by
    /// at most [`Differentiator::ERROR`] there.
    ///
    /// # Errors
    /// [`Error::TooFast`] where the shortest window is too long: the positions are too far apart.
    pub fn for_motion(period: f64, frequency: f64) -> Result<Differentiator, Error> {
        let is_good = frequency > 0.0 && frequency.is_finite();
        ensure(is_good, "`frequency` has to be a positive number of Hz")?;
        // A window under half a period is judged by its middle: until then gains fall with its
        // length.
        let longest = (0.25 / (period * frequency)).min(Differentiator::LONGEST as f64) as usize;
        let mut best = None;
        for half in 3..=longest {
            let filter = Differentiator::new(period, half)?;
            if !filter.is_good(period, frequency) {
                break;
            }
            best = Some(filter);
        }
        match best {
            Some(filter) => Ok(filter),
            None => Err(Error::TooFast {
                rate: 1.0 / period,
                most: highest(period)?,
                frequency,
            }),
        }
    }

    fn is_good(&self, period: f64, frequency: f64) -> bool {
        let mut gains = self.gains(period, frequency).into_iter();
        gains.all(|gain| (gain - 1.0).abs() <= Differentiator::ERROR)
    }

    /// Returns half the window's length: how many positions of either end have no derivative.
    pub fn half(&self) -> usize {
        self.weights[0].len() / 2
    }

    /// Returns the gains of q, q̇ and q̈ at a frequency in Hz: one is right.
    pub fn gains(&self, period: f64, frequency: f64) -> [f64; 3] {
        let omega = 2.0 * core::f64::consts::PI * frequency;
        let sum = |weights: &[f64], of: &dyn Fn(f64) -> f64| -> f64 {
            let half = self.half() as f64;
            let places = weights.iter().enumerate();
            let terms = places.map(|(j, w)| w * of(omega * period * (j as f64 - half)));
            terms.sum()
        };
        let [middle, slope, bend] = &self.weights;
        [
            sum(middle, &|x| libm::cos(x)),
            sum(slope, &|x| libm::sin(x)) / omega,
            -sum(bend, &|x| libm::cos(x)) / (omega * omega),
        ]
    }
}

fn highest(period: f64) -> Result<f64, Error> {
    let shortest = Differentiator::new(period, 3)?;
    let (mut low, mut high) = (0.0, 0.25 / (3.0 * period));
    for _ in 0..50 {
        let middle = 0.5 * (low + high);
        match shortest.is_good(period, middle) {
            true => low = middle,
            false => high = middle,
        }
    }
    Ok(low)
}

/// Computes q, q̇ and q̈ of a joint's positions. The k-th position has entry k − half.
///
/// # Errors
/// [`Error::Value`], and [`Error::Length`] where there is not one window of positions.
pub fn differentiate(filter: &Differentiator, q: &[f64]) -> Result<[Vec<f64>; 3], Error> {
    check("q", q, q.len().max(filter.weights[0].len()))?;
    let apply = |weights: &Vec<f64>| {
        let windows = q.windows(weights.len());
        windows.map(|window| dot(window, weights)).collect()
    };
    Ok(filter.weights.each_ref().map(apply))
}
