//! Certificates: how far emitted code can be from the full model, proved.
//!
//! - [`interval`], [`trig`]: doubles rounded outward
//! - [`input_box`]: the states for which a bound holds
//! - [`edits`]: what was left out, and the program of its error
//! - [`form`]: a program over a sub-box as polynomials in the rates
//! - [`bound`]: branch and bound over the positions

pub mod attack;
pub mod bound;
pub mod certificate;
pub mod edits;
mod expand;
mod grid;

pub mod form;

pub mod input_box;
pub mod interval;
pub mod json;
pub mod prune;
pub mod ranges;
pub mod sample;
pub mod scale;
pub mod sensitivity;
pub mod trig;
