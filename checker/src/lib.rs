//! The checker of generated code, small enough to be read in a day.
//!
//! A certificate says that a generated function differs from the dynamics of a robot, at
//! every state of a box, by at most E·T; a generated file without one says that nothing
//! was left out. This crate uses none of the project's others. It takes the text, the
//! box, T and E, reads the robot file itself, and shows the claim with its own means, or
//! says how far its own bound is from it:
//!
//! 1. `literal`, `robot`, `scene`: the robot file, every number as an interval about a double
//! 2. `file`, `aside`, `c99`, `program`, `text`: the text, by a small strict grammar
//! 3. `dynamics`, `kinematics`, `quantity`: the recursion of Newton and Euler, and what follows
//! 4. `polynomial`, `ring`, `values`, `sines`: text and recursion as polynomials in
//!    sines, cosines and rates; all that was not edited cancels in their difference
//! 5. `levels`, `maximum`: the largest magnitude of that difference over the box
//! 6. `values`, again: what rounding costs, by one pass over the text
//! 7. `sample`: the text run at some states, which must not contradict the bounds;
//!    `witness`: states at which T is reached
//! 8. `tried`: functions that divide, by their equation at states that SHA-256 draws, without a bound
//! 9. `identity`: an exact program equals the equations of motion, modulo primes that SHA-256 draws
//! 10. `verdict`, `exact`: the parts in order, of a certificate and of a whole file
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
pub mod dynamics;
#[cfg(feature = "certify")]
pub mod exact;
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
mod tried;
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
