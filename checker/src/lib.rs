//! The checker of generated code, small enough to be read in a day.
//!
//! This crate uses none of the project's others, and reads the robot file itself. A generated file
//! has a claim beside it, with the exact program of each function:
//!
//! 1. `file`, `aside`, `c99`, `together`, `read`: the text, by a small strict grammar
//! 2. `claim`, `compare`: the text is the program that is claimed, its literals rounded once
//! 3. `identity`: that program equals the equations of motion, modulo primes that SHA-256 draws
//! 4. `rounding`, `cost`: what rounding costs, over the box or at drawn states
//! 5. `certify`: these in order, function by function
//!
//! A certificate says that a function from which something was left out differs from the dynamics,
//! at every state of a box, by at most E·T. The checker takes the text, the box, T and E, and shows
//! that with means of its own, or says how far its bound is from it:
//!
//! 1. `literal`, `robot`, `scene`: the robot file, every number as an interval about a double
//! 2. `program`, `text`: the text as straight-line code
//! 3. `dynamics`, `kinematics`, `quantity`: the recursion of Newton and Euler, and what follows
//! 4. `polynomial`, `ring`, `values`, `sines`: text and recursion as polynomials in
//!    sines, cosines and rates; all that was not edited cancels in their difference
//! 5. `levels`, `maximum`: the largest magnitude of that difference over the box
//! 6. `sample`: the text run at some states, which must not contradict the bounds;
//!    `witness`: states at which T is reached
//! 7. `verdict`: the parts in order
//!
//! What is believed: that every operation is rounded to nearest and none is contracted,
//! that the library's sines are within one ulp, this crate, the compiler, and the parsers
//! of TOML and JSON.
#![forbid(unsafe_code)]
#![allow(clippy::neg_cmp_op_on_partial_ord)] // So that NaN counts as too large.

#[cfg(feature = "certify")]
mod aside;
#[cfg(feature = "certify")]
mod c99;
#[cfg(feature = "certify")]
mod certificate;
#[cfg(feature = "certify")]
pub mod certify;
#[cfg(feature = "certify")]
pub mod claim;
#[cfg(feature = "certify")]
mod compare;
#[cfg(feature = "certify")]
mod cost;
#[cfg(feature = "certify")]
pub mod dynamics;
#[cfg(feature = "certify")]
mod fault;
#[cfg(feature = "certify")]
pub mod file;
pub mod identity;
#[cfg(feature = "certify")]
pub mod interval;
#[cfg(feature = "certify")]
pub mod kinematics;
#[cfg(feature = "certify")]
mod levels;
#[cfg(feature = "certify")]
pub mod literal;
#[cfg(feature = "certify")]
mod maximum;
#[cfg(feature = "certify")]
pub mod number;
#[cfg(feature = "certify")]
pub mod polynomial;
#[cfg(feature = "certify")]
pub mod program;
#[cfg(feature = "certify")]
pub mod quantity;
pub mod read;
#[cfg(feature = "certify")]
mod ring;
#[cfg(feature = "certify")]
pub mod robot;
#[cfg(feature = "certify")]
mod rounding;
#[cfg(feature = "certify")]
mod sample;
#[cfg(feature = "certify")]
pub mod scene;
#[cfg(feature = "certify")]
mod sines;
#[cfg(feature = "certify")]
pub mod text;
#[cfg(feature = "certify")]
mod together;
#[cfg(feature = "certify")]
mod values;
#[cfg(feature = "certify")]
mod verdict;
#[cfg(feature = "certify")]
mod witness;

#[cfg(feature = "certify")]
pub use certificate::{Claim, read};
#[cfg(feature = "certify")]
pub use fault::Fault;
#[cfg(feature = "certify")]
pub use verdict::{Found, Output, Verdict, audit, measure};
