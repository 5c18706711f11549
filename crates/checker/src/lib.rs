//! The checker of generated code, small enough to be read in a day.
//!
//! This crate uses none of the project's others, and reads the robot file itself. A generated file
//! has a claim beside it, with the exact program of each function:
//!
//! 1. `file`, `aside`, `payload`, `c99`, `together`, `read`: the text, by a small strict grammar
//! 2. `claim`, `compare`: the text is the program that is claimed, its literals rounded once
//! 3. `program`, `identity`: that program equals the equations of motion, modulo primes that
//!    SHA-256 draws
//! 4. `rounding`, `cost`, `interval`: what rounding costs, over the box or at drawn states
//! 5. `tolerance`: under a tolerance the text is another program, and the difference is bounded over
//!    the box, by `written`, `polynomial`, `ring`, `sines`, `maximum`
//! 6. `certify`, `fault`: these in order, function by function
//!
//! Believed are: that every operation is rounded to nearest and none is contracted,
//! that the library's sines are within one ulp, this crate, the compiler, and the parsers
//! of TOML and JSON.
#![forbid(unsafe_code)]
#![allow(clippy::neg_cmp_op_on_partial_ord)] // So that NaN counts as too large.

#[cfg(feature = "certify")]
mod aside;
#[cfg(feature = "certify")]
mod c99;
#[cfg(feature = "certify")]
pub mod certify;
#[cfg(feature = "claim")]
pub mod claim;
#[cfg(feature = "certify")]
mod compare;
#[cfg(feature = "certify")]
mod cost;
#[cfg(feature = "certify")]
mod defaults;
#[cfg(feature = "certify")]
mod derivatives;
#[cfg(feature = "certify")]
pub mod domain;
mod fault;
#[cfg(feature = "certify")]
pub mod file;
#[cfg(feature = "certify")]
mod hidden;
#[cfg(feature = "certify")]
pub mod identity;
#[cfg(feature = "certify")]
pub mod interval;
mod load;
mod maximum;
pub mod payload;
pub mod places;
#[cfg(feature = "certify")]
pub mod polynomial;
pub mod program;
pub mod read;
#[cfg(feature = "certify")]
mod ring;
#[cfg(feature = "certify")]
mod rounding;
#[cfg(feature = "certify")]
mod sample;
#[cfg(feature = "certify")]
mod sines;
#[cfg(feature = "certify")]
mod states;
#[cfg(feature = "certify")]
mod together;
#[cfg(feature = "certify")]
mod tolerance;
#[cfg(feature = "certify")]
pub mod work;
#[cfg(feature = "certify")]
mod written;

pub use fault::Fault;
