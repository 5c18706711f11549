//! The Rust side of the Python package: arms, and functions that take NumPy arrays.
#![deny(unsafe_code)]

mod arm;
mod call;
mod convert;
mod function;
mod load;
mod memory;
mod payload;
mod pose;
mod xla;

use std::ffi::OsString;

use pyo3::prelude::*;

/// Runs the command with its arguments, the first of which is its name, and returns the exit code.
#[pyfunction]
fn command(arguments: Vec<OsString>) -> u8 {
    dalembert_cli::run(arguments)
}

/// The compiled part of `dalembert`.
#[pymodule]
mod _dalembert {
    #[pymodule_export]
    use super::arm::{Arm, outputs};
    #[pymodule_export]
    use super::command;
    #[pymodule_export]
    use super::function::Function;
    #[pymodule_export]
    use super::load::load;
    #[pymodule_export]
    use super::memory::xla_handler;
    #[pymodule_export]
    use super::payload::Load;
    #[pymodule_export]
    use super::pose::pose_rows;
}
