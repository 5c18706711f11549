//! Semantic fingerprints: a node's values at random points of a prime field.
//!
//! Every sin/cos pair is a rational point of the circle, so sin² + cos² = 1 holds in the field;
//! decimal constants are exact there. Two nodes are polynomials of degree d in the points'
//! parameters (d is below a few hundred); if they differ, they agree at one point with probability
//! at most d/p ≈ 2⁻⁵³ (Schwartz–Zippel), and at all [`POINTS`] of them with the power of that.
//! Points 0 and 1 share the constant angles: a node with equal values there does not depend on the
//! state.

use std::hash::{Hash, Hasher};

use dalembert_model::equations::SinCosPair;
use dalembert_model::number::{Angle, Exact, Rational};
use dalembert_model::scalar::Scalar;
use dalembert_model::scalar::field::{Field, Modulo};

use super::{Input, Lanes};
use crate::random::Random;

pub(crate) const POINTS: usize = 3;

/// The values of one node at every point. A divisor that is zero at a point has a chance of
/// 2⁻⁶¹ if it is not zero everywhere.
pub(crate) type Fingerprint = Lanes<Field, POINTS>;

/// By its first value, which is as good as random: other prints hardly ever have the same.
impl Hash for Fingerprint {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.0[0].hash(state);
    }
}

impl Fingerprint {
    /// Returns the print up to sign, and whether it had to be negated.
    #[inline]
    pub fn canonical(&self) -> (Fingerprint, bool) {
        // The first value decides, unless it is its own negative: zero.
        let first = self.0.iter().find(|x| **x != Field::ZERO);
        match first.is_some_and(|x| x.neg() < *x) {
            true => (self.neg(), true),
            false => (*self, false),
        }
    }
    pub fn is_constant(&self) -> bool {
        self.0[0] == self.0[1]
    }
}

/// Points of the field, which follow from a seed: the search has a fixed one, a proof the hash of
/// its statement.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Points {
    seed: u64,
}

impl Points {
    /// The points that the simplifier uses.
    pub const SEARCH: Points = Points { seed: 0x5eed };

    pub(crate) fn new(seed: u64) -> Points {
        Points { seed }
    }

    pub fn input(&self, input: Input) -> Fingerprint {
        Lanes(core::array::from_fn(|point| self.input_at(input, point)))
    }

    pub(crate) fn input_at<const P: u64>(&self, input: Input, point: usize) -> Modulo<P> {
        let draw = |kind: u64, joint: usize| {
            Modulo::new(mix([self.seed, point as u64, kind, joint as u64]))
        };
        match input {
            Input::Sin(joint) => self.joint(joint, point).sin,
            Input::Cos(joint) => self.joint(joint, point).cos,
            // Beyond all arguments.
            Input::PerSpeed(joint) => draw(64, joint),
            // From 2, around 5, which is that of constant angles.
            Input::Entry(argument, joint) => match argument.index() as u64 {
                index @ 0..=2 => draw(index + 2, joint),
                index => draw(index + 3, joint),
            },
        }
    }

    fn joint<const P: u64>(&self, joint: usize, point: usize) -> SinCosPair<Modulo<P>> {
        circle(mix([self.seed, point as u64, 1, joint as u64]))
    }

    /// Returns the print of a constant; `None` if the prime divides a denominator.
    pub fn constant(&self, value: &Exact) -> Option<Fingerprint> {
        let coefficient = &mut |x: &Rational| Some(Lanes([Field::from_rational(x)?; POINTS]));
        value.map(coefficient, &mut |angle| {
            // Points 0 and 1 share the constant angles.
            let pairs = [0, 0, 2].map(|point| self.constant_angle(angle, point));
            SinCosPair {
                sin: Lanes(pairs.each_ref().map(|pair| pair.sin)),
                cos: Lanes(pairs.each_ref().map(|pair| pair.cos)),
            }
        })
    }

    /// Each point has its own constant angles. `None` if the prime divides a denominator.
    pub(crate) fn constant_at<const P: u64>(&self, x: &Exact, point: usize) -> Option<Modulo<P>> {
        let coefficient = &mut |x: &Rational| Modulo::from_rational(x);
        x.map(coefficient, &mut |angle| self.constant_angle(angle, point))
    }

    fn constant_angle<const P: u64>(&self, angle: &Angle, point: usize) -> SinCosPair<Modulo<P>> {
        let parameter = mix([self.seed, point as u64, 5, hash_angle(angle)]);
        Modulo::of_angle(angle, || Modulo::circle_point(Modulo::new(parameter)))
    }

    /// Returns true if a field cannot tell a constant from zero: its prime divides a coefficient.
    pub fn lose<const P: u64>(value: &Exact) -> bool {
        let coefficient = &mut |x: &Rational| {
            let residue = Modulo::<P>::from_rational(x);
            residue.filter(|x| *x != Modulo::ZERO)
        };
        let pair = &mut |_: &Angle| circle(0);
        !value.is_zero() && value.map(coefficient, pair).is_none()
    }
}

fn circle<const P: u64>(parameter: u64) -> SinCosPair<Modulo<P>> {
    let (sin, cos) = Modulo::circle_point(Modulo::new(parameter));
    SinCosPair { sin, cos }
}

/// SplitMix64 over the words.
fn mix(words: [u64; 4]) -> u64 {
    let words = words.into_iter();
    words.fold(0x9e37_79b9_7f4a_7c15, |state, word| {
        Random::new(state ^ word).bits()
    })
}

/// Over the digits of the exact value, so that it is the same on every machine.
fn hash_angle(angle: &Angle) -> u64 {
    // The number of digits tells where the numerator ends.
    let word = |kind: u64, value: &Rational| {
        let digits = value.numer().iter_u64_digits();
        let start = mix([kind, digits.len() as u64, 0, 0]);
        let digits = digits.chain(value.denom().iter_u64_digits());
        digits.fold(start, |hash, digit| mix([hash, digit, 0, 1]))
    };
    match angle {
        Angle::PiTimes(value) => word(0, value),
        Angle::Radians(value) => word(1, value),
        Angle::TwiceAtan(value) => word(2, value),
    }
}
