//! Writes the arm's dynamics before the crate is compiled.

use dalembert_build::{BuildError, Generator, Output, Scalar};

fn main() -> Result<(), BuildError> {
    Generator::new()
        .robot("robots/arm.toml")
        .outputs([Output::InverseDynamics, Output::ManipulatorEquation])
        .scalars([Scalar::F64])
        .module("arm")
        .write_to_out_dir("arm.rs")
}
