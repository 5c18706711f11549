//! Intervals, rounded outward: what every rigorous bound is made of.
//!
//! - `doubles`: arithmetic; `scalar`: as a scalar
//! - `trig`: sines and cosines
//! - [`rounding`]: what rounding costs straight-line code

mod doubles;
pub(crate) mod rounding;
mod scalar;
mod trig;

pub use doubles::Interval;
