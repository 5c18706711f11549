//! Helpers shared by the examples. A program of your own needs none of it.
//!
//! - [`integrate`]: an arm's motion under torques, from its forward dynamics
#![forbid(unsafe_code)]

pub mod integrate;
