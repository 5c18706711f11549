//! Exact numbers: rationals, angles and the constants made of them.

mod angle;

pub use angle::Angle;

/// An exact rational number.
pub type Rational = num_rational::BigRational;
