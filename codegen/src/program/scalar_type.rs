//! Scalar types, numbers rounded to them, and literals of printed code.

use std::fmt;

use dalembert_model::number::{Exact, Rational, Rounded};

use crate::states::JointState;
use crate::words::words;

words! {
    /// The scalar of an emitted function.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
    pub enum ScalarType: "scalar" {
        /// Double precision.
        F64 = "f64",
        /// Single precision.
        F32 = "f32",
    }
}

impl ScalarType {
    pub(crate) const fn of<T: Copy>(self, double: T, single: T) -> T {
        match self {
            ScalarType::F64 => double,
            ScalarType::F32 => single,
        }
    }

    /// Returns the suffix of libm's functions for this scalar.
    pub fn math_suffix(self) -> &'static str {
        self.of("", "f")
    }

    /// Returns u: half an ulp of 1.
    pub fn unit_roundoff(self) -> f64 {
        self.of(f64::EPSILON, f32::EPSILON.into()) / 2.0
    }

    /// Returns the least number with a full significand.
    pub fn least_normal(self) -> f64 {
        self.of(f64::MIN_POSITIVE, f32::MIN_POSITIVE.into())
    }

    /// Rounds a constant once from its exact value; the double holds the rounded value exactly, and
    /// zero has no sign.
    pub fn round(self, value: &Exact) -> f64 {
        let rounded = match self {
            ScalarType::F64 => f64::nearest(value),
            ScalarType::F32 => f64::from(f32::nearest(value)),
        };
        // −0.0, which a sum of sines may end at, becomes 0.0.
        rounded + 0.0
    }

    pub(crate) fn round_rational(self, value: &Rational) -> f64 {
        match self {
            ScalarType::F64 => f64::nearest_rational(value),
            ScalarType::F32 => f32::nearest_rational(value).into(),
        }
    }

    /// Returns the nearest number of the type, as a double that holds it exactly.
    pub fn nearest(self, value: f64) -> f64 {
        self.of(value, f64::from(value as f32))
    }

    /// Returns the least number of the type that is not below a value.
    pub fn above(self, value: f64) -> f64 {
        match self {
            ScalarType::F64 => value,
            ScalarType::F32 if f64::from(value as f32) < value => (value as f32).next_up().into(),
            ScalarType::F32 => (value as f32).into(),
        }
    }

    /// Returns the value of a literal in this type, as a double.
    pub fn parse(self, literal: &str) -> Option<f64> {
        match self {
            ScalarType::F64 => literal.parse().ok(),
            ScalarType::F32 => literal.parse::<f32>().ok().map(f64::from),
        }
    }
}

impl fmt::Display for ScalarType {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl JointState {
    /// Returns the nearest state of a scalar's numbers, held in doubles. A load follows from the
    /// payload, and code rounds it to its own scalar.
    pub fn in_scalar(&self, scalar: ScalarType) -> JointState {
        self.each(|x| scalar.nearest(x))
    }
}

/// Returns half the least subnormal.
pub(crate) fn underflow(scalar: ScalarType) -> f64 {
    // Half of 2^−1074 is no double: the whole.
    scalar.of(f64::from_bits(1), f64::from(f32::from_bits(1)) / 2.0)
}

/// A literal's value in the code's scalar, held exactly. Equal are equal bits: −0.0 is not 0.0.
#[derive(Clone, Copy, Debug)]
pub struct Literal(pub f64);

impl Literal {
    /// Returns the shortest text that reads back as the value in the scalar.
    pub fn text(self, scalar: ScalarType) -> String {
        match scalar {
            ScalarType::F64 => format!("{:?}", self.0),
            ScalarType::F32 => format!("{:?}", self.0 as f32),
        }
    }
}

impl PartialEq for Literal {
    fn eq(&self, other: &Literal) -> bool {
        self.0.to_bits() == other.0.to_bits()
    }
}

impl Eq for Literal {}

impl std::hash::Hash for Literal {
    fn hash<H: std::hash::Hasher>(&self, state: &mut H) {
        self.0.to_bits().hash(state);
    }
}
