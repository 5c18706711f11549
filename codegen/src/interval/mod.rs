//! Intervals, rounded outward: what every rigorous bound is made of.
//!
//! - `doubles`: arithmetic
//! - `trig`: sines and cosines

mod doubles;
mod trig;

pub use doubles::Interval;
