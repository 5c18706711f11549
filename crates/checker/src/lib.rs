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

mod aside;
mod c99;
pub mod certify;
pub mod claim;
mod compare;
mod cost;
mod defaults;
mod derivatives;
pub mod domain;
mod fault;
pub mod file;
mod hidden;
pub mod identity;
pub mod interval;
mod load;
mod maximum;
pub mod payload;
pub mod places;
pub mod polynomial;
pub mod program;
pub mod read;
mod ring;
mod rounding;
mod sample;
mod sines;
mod states;
mod together;
mod tolerance;
pub mod work;
mod written;

pub use fault::Fault;
