//! Certificates: how far emitted code can be from the full model, proved.
//!
//! - [`interval`], [`trig`]: doubles rounded outward
//! - [`input_box`]: the states for which a bound holds
//! - [`edits`]: what was left out, and the program of its error
//! - [`form`]: a program over a sub-box as polynomials in the rates
//! - [`bound`]: branch and bound over the positions

pub mod bound;
pub mod edits;
mod expand;
pub mod form;
mod grid;
pub mod input_box;
pub mod interval;
pub mod prune;
pub mod sample;
pub mod trig;
