//! From a robot to verified flat Rust: what the macro `dynamics!`, the build
//! scripts' `dalembert-build` and the command have in common.
//!
//! [`generate()`] does a [`Request`] for a robot. The items below are for users of the generator as a
//! library; the other crates of the workspace, and the tests, use more by one door, `workspace`.
//! docs/architecture.md lists the modules in the order of the stages: each uses those above.
#![forbid(unsafe_code)]
#![cfg_attr(docsrs, feature(doc_cfg), doc(auto_cfg))]
#![cfg_attr(feature = "testing", warn(unreachable_pub))]

mod ask;
mod claim;
mod dag;
mod emit;
mod figures;
mod function;
mod generate;
mod language;
mod limbs;
mod parallel;
mod plan;
mod program;
mod random;
mod robot_file;
mod scalar;
mod search;
mod seeds;
mod setup;
mod sincos;
mod states;
mod task;
mod tolerance;
mod verify;
mod watch;
#[doc(hidden)]
pub mod words;
#[doc(hidden)]
pub mod workspace;

pub use ask::{AskedCode, ask};
#[doc(inline)]
pub use dalembert_model::diagnostic::{Diagnostic, Diagnostics, Place};
#[doc(inline)]
pub use dalembert_stamp::Asked;
pub use emit::GeneratedFunction;
#[doc(inline)]
pub use function::Function;
pub use generate::{GeneratedCode, generate};
pub use language::Language;
pub use limbs::LimbLayout;
pub use plan::Plan;
pub use program::{Counts, Program, ScalarType};
pub use robot_file::{RobotFile, unreadable};
pub use search::Effort;
pub use seeds::Start;
pub use sincos::SinCos;
pub use task::options::{OPTIONS, OptionRow, Purpose};
pub use task::{GenerateError, Prefer, Request};
pub use watch::Watch;
