//! Helpers shared by the examples. A program of your own needs none of it.
//!
//! - [`integrate`]: an arm's motion under torques, from its forward dynamics
//! - [`chart`]: lines over time as SVG
//! - [`target`]: where an arm should be
//! - [`checked_in`]: whether a chart is what is checked in
#![forbid(unsafe_code)]

pub mod chart;
pub mod checked_in;
pub mod integrate;
pub mod target;
