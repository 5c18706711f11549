//! From a robot to verified flat Rust: stages in the order of the pipeline.
//!
//! - [`generate`]: the one function that macro, build script and command call
//! - [`function`]: the functions that can be generated
//! - [`trace`]: the equations as a graph
//! - [`graph`]: the graph with exact constants and fingerprints
//! - [`simplify`]: fewer operations, same function
//! - [`schedule`]: straight-line code
//! - [`emit`]: flat Rust
//! - [`verify`]: proofs and checks
#![forbid(unsafe_code)]

pub mod emit;
pub mod function;
pub mod generate;
pub mod graph;
pub mod schedule;
pub mod simplify;
pub mod trace;
pub mod verify;
