//! The Rust side of the Python package: arms, and functions that take NumPy arrays.
//!
//! - `arm`: loading, with progress, and what is known of an arm
//! - `function`: calls: arguments, shapes, results
//! - `array`: NumPy arrays as slices: all that is `unsafe`
#![deny(unsafe_code)]

mod arm;
mod array;
mod function;

use pyo3::prelude::*;

/// The compiled part of `dalembert`.
#[pymodule]
mod _dalembert {
    #[pymodule_export]
    use super::arm::{Arm, load, outputs};
    #[pymodule_export]
    use super::function::Function;
}
