//! Exact numbers: rationals, angles and the constants made of them.
//!
//! - [`Angle`]: a rational multiple of π or a rational number of radians
//! - [`parse`]: decimal literals, read and written exactly
//! - [`Exact`]: polynomials over ℚ in the sin and cos of constant angles
//! - `rationals`, `divisor`: sums and products of rationals, short and long
//! - `trig`, `round`: their correctly rounded floating-point values
//! - [`Wide`]: a float of 256 bits, which errors are measured against
//! - [`recover`]: the number that was meant, from one computed in wide floats

mod angle;
mod divisor;
mod exact;
pub mod parse;
mod rationals;
pub mod recover;
mod round;
mod text;
mod trig;
mod wide;

pub use angle::{Angle, SnappedAngle};
pub use exact::Exact;
pub use round::Rounded;
pub use wide::Wide;

/// An exact rational number.
pub type Rational = num_rational::BigRational;

fn ratio(numerator: i64, denominator: i64) -> Rational {
    Rational::new(numerator.into(), denominator.into())
}
