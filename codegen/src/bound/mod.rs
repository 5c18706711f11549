//! Rigorous bounds.
//!
//! - [`interval`]: doubles rounded outward
//! - `split`: the error of emitted code by cause

pub mod interval;
mod split;

pub use split::Split;
