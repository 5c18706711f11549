//! From a robot to verified flat Rust: what the macro `dynamics!`, the build
//! scripts' `dalembert-build` and the command have in common.
//!
//! [`generate()`] does a [`Request`] for a robot. The items listed below are for
//! users of the generator as a library. The modules follow here in the order of the
//! stages: each may use those above it, never those below (`tests/layering.rs` sees
//! to it).
//!
//! - `random`: seeded random numbers, the same on every machine
//! - `parallel`: work shared out among threads
//! - `states`: joint states inside a robot's limits
//! - `function`: the functions that can be generated
//! - `words`: values that users name by a word
//! - `figures`: numbers in texts, rounded to the side that stays true
//! - `dag`: straight-line code as a graph, and the formulas with exact constants and fingerprints
//! - `program`: programs and their code in a scalar, as it runs and is written
//! - `interval`: intervals, rounded outward
//! - `split`: the error of emitted code by cause
//! - `watch`: watching a long search, and ending it early
//! - `search`: fewer operations, same function
//! - `setup`: the robot in its scene: locked joints, results asked for
//! - `seeds`: the formulations to start from, tuned to the robot
//! - `edits`: programs with less work in them, and how far they are off
//! - `sincos`: sine and cosine by polynomials with proved errors
//! - `language`: flat Rust, printed and read back
//! - `verify`: proofs and checks
//! - `claim`: programs as the document of claims and plans has them
//! - `plan`: programs kept from a long search
//! - `task`: what is generated, for which robot in which scene, with which options
//! - `bound`: rigorous bounds of what was left out and of what rounding costs
//! - `certificate`: claims about variants that a tolerance admits
//! - `falsify`: attempts to refute them
//! - `approximate`: the lossy search
//! - `emit`: the module of a robot: header, documentation, functions
//! - `generate`: the one function that macro, build script and command call
//!
//! And the ways in, which all end in `generate`:
//! - `robot_file`: a robot file from a path, with errors fit to show
//! - `ask`: what macro and build script ask of one
//!
//! The other crates of the workspace, and the tests, use more than what is listed
//! below, by one door:
//! - `workspace`: what they use of each stage
#![forbid(unsafe_code)]
#![cfg_attr(docsrs, feature(doc_cfg), doc(auto_cfg))]
#![warn(unreachable_pub)]

mod approximate;
mod ask;
mod bound;
mod certificate;
mod claim;
mod dag;
mod edits;
mod emit;
mod falsify;
mod figures;
mod function;
mod generate;
mod interval;
mod language;
mod parallel;
mod plan;

mod program;
mod random;
mod robot_file;
mod search;
mod seeds;
mod setup;
mod sincos;
mod split;
mod states;
mod task;
mod verify;
mod watch;
mod words;
#[doc(hidden)]
pub mod workspace;

pub use ask::{Made, ask};
#[doc(inline)]
pub use dalembert_stamp::Asked;
pub use emit::GeneratedFunction;
#[doc(inline)]
pub use function::Function;
pub use generate::{GenerateError, Generated, generate};
pub use language::Language;
pub use plan::Plan;
pub use program::{Counts, Program, ScalarType};
pub use robot_file::{RobotFile, RobotFileError};
pub use search::Effort;
pub use seeds::Start;
pub use sincos::SinCos;
pub use task::options::{OPTIONS, OptionRow, Problem, Purpose};
pub use task::{Prefer, Request};
pub use watch::Watch;
pub use words::Complaint;
