//! From a robot to verified flat Rust: stages in the order of the pipeline.
//!
//! - [`generate`]: the one function that macro, build script and command call
//! - [`function`]: the functions that can be generated
//! - [`scene`]: the robot in its setting: locked joints, results asked for
//! - [`trace`]: the equations as a graph
//! - [`portfolio`]: the formulations to start from, tuned to the robot
//! - [`graph`]: the graph with exact constants and fingerprints
//! - [`simplify`]: fewer operations, same function
//! - [`plan`]: programs kept from a long search
//! - [`schedule`]: straight-line code
//! - [`sincos`]: sine and cosine by polynomials with proved errors
//! - [`emit`]: flat Rust
//! - [`verify`]: proofs and checks
//! - [`certify`]: bounds of what was left out and of what rounding costs
//! - [`couplings`]: which coefficients vanish or repeat, and why
//! - [`explain`]: what each step brought, and why
//! - [`watch`]: watching a long search, and ending it early
//!
//! And the ways in, which all end in [`generate`]:
//! - [`clauses`]: words, robot files, and `dynamics!` as tokens
//! - [`builder`]: for build scripts
//! - `stress`: stability at the extremes (feature `stress`)
#![forbid(unsafe_code)]

pub mod builder;
pub mod certify;
pub mod clauses;
pub mod couplings;
pub mod emit;
pub mod explain;
pub mod function;
pub mod generate;
pub mod graph;
pub mod plan;
pub mod portfolio;
pub mod scene;
pub mod schedule;
pub mod simplify;
pub mod sincos;
#[cfg(feature = "stress")]
pub mod stress;
pub mod trace;
pub mod verify;
pub mod watch;
