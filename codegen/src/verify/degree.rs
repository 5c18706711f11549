//! Degree and height of a program's and a formula's outputs, from above.
//!
//! A program is a polynomial in its inputs and in the pairs of constant
//! angles. With every sine and cosine of an angle a rational function of one
//! parameter, of numerator degree 2 over 1 + t², a polynomial whose degree in
//! the pair of joint j is e_j becomes, times Π (1 + t_j²)^e_j, a polynomial of
//! degree at most Σ 2e_j + (the degree in everything else).
//!
//! Its coefficients are rationals. If every constant is an integer over a
//! common denominator E, a polynomial of degree k in the constants is, times
//! E^k, one with integers; they are no larger than E^k times the sum of the
//! coefficients' magnitudes, which products multiply and sums add, and which
//! an angle's parameter at most doubles for each degree in its pair. [`height`]
//! is the number of bits of that. Halving, which formulas do, counts by itself.
//!
//! [`height`]: Degree::height

use dalembert_model::equations::SinCosPair;
use dalembert_model::number::Exact;
use dalembert_model::scalar::Scalar;

use super::size::{Denominators, Size};
use crate::program::Input;

/// Degrees of a polynomial and the size of its coefficients: upper bounds,
/// cancellation is not seen.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Degree {
    /// The sum of the coefficients' magnitudes; none if it is zero.
    size: Option<Size>,
    /// In the sine and cosine of each joint.
    joints: Vec<u32>,
    /// In all other inputs together.
    other: u32,
    /// In the sines and cosines of constant angles together.
    angles: u32,
    /// In constants that are no integers.
    constants: u32,
    /// The number of halvings.
    halvings: u32,
}

impl Degree {
    fn of(size: Option<Size>) -> Degree {
        Degree {
            size,
            joints: Vec::new(),
            other: 0,
            angles: 0,
            constants: 0,
            halvings: 0,
        }
    }

    /// Returns the degree of an input.
    pub fn input(input: Input) -> Degree {
        let mut degree = Degree::one();
        match input.angle() {
            Some(angle) => {
                for (joint, _) in angle.terms() {
                    degree.joints.resize(joint + 1, 0);
                    degree.joints[joint] = 1;
                }
                // sin(a + b) is two products, and so on.
                for _ in 0..angle.additions() {
                    degree = degree.double();
                }
            }
            None => degree.other = 1,
        }
        degree
    }

    /// Returns the degree of a constant and adds its denominators to `denominators`.
    pub fn constant(constant: &Exact, denominators: &mut Denominators) -> Degree {
        if constant.is_zero() {
            return Degree::zero();
        }
        let generator = Degree {
            angles: 1,
            ..Degree::one()
        };
        let mut coefficient = |x: &_| {
            Some(Degree {
                constants: u32::from(denominators.note(x)),
                ..Degree::of(Some(Size::of(x)))
            })
        };
        let degree = constant.map(&mut coefficient, &mut |_| SinCosPair {
            sin: generator.clone(),
            cos: generator.clone(),
        });
        degree.unwrap_or_else(Degree::one)
    }

    /// Returns the degree in the random parameters; the largest there is if it was
    /// beyond counting.
    pub fn bound(&self) -> u64 {
        match self.is_beyond_counting() {
            true => u64::MAX,
            false => self.pairs() * 2 + u64::from(self.other),
        }
    }

    /// Sums of degrees stay at the largest number.
    fn is_beyond_counting(&self) -> bool {
        let others = [self.other, self.angles, self.constants, self.halvings];
        let mut all = self.joints.iter().chain(&others);
        all.any(|&degree| degree == u32::MAX)
    }

    /// Returns the bits of its coefficients once they are integers.
    pub fn height(&self, denominators: &Denominators) -> u64 {
        let size = self.size.map_or(0, |size| size.bits());
        let shared = denominators.bits().saturating_mul(self.constants.into());
        let bits = size.saturating_add(shared);
        bits.saturating_add(self.pairs() + u64::from(self.halvings))
    }

    /// Returns the degree in all pairs together.
    fn pairs(&self) -> u64 {
        let joints = self.joints.iter().map(|&degree| u64::from(degree));
        joints.sum::<u64>() + u64::from(self.angles)
    }

    fn combine(&self, other: &Degree, size: Option<Size>, f: impl Fn(u32, u32) -> u32) -> Degree {
        let n = self.joints.len().max(other.joints.len());
        let at = |degree: &Degree, i: usize| degree.joints.get(i).copied().unwrap_or(0);
        Degree {
            size,
            joints: (0..n).map(|i| f(at(self, i), at(other, i))).collect(),
            other: f(self.other, other.other),
            angles: f(self.angles, other.angles),
            constants: f(self.constants, other.constants),
            halvings: f(self.halvings, other.halvings),
        }
    }
}

impl Scalar for Degree {
    fn zero() -> Self {
        Degree::of(None)
    }
    fn one() -> Self {
        Degree::of(Some(Size::ONE))
    }
    fn add(&self, other: &Self) -> Self {
        match (self.size, other.size) {
            (None, _) => other.clone(),
            (_, None) => self.clone(),
            (Some(a), Some(b)) => self.combine(other, Some(a.add(b)), u32::max),
        }
    }
    fn sub(&self, other: &Self) -> Self {
        self.add(other)
    }
    fn mul(&self, other: &Self) -> Self {
        match (self.size, other.size) {
            (Some(a), Some(b)) => self.combine(other, Some(a.mul(b)), u32::saturating_add),
            _ => Degree::zero(),
        }
    }
    fn neg(&self) -> Self {
        self.clone()
    }
    fn half(&self) -> Self {
        Degree {
            halvings: self.halvings.saturating_add(1),
            ..self.clone()
        }
    }
    fn is_zero(&self) -> bool {
        self.size.is_none()
    }
}
