//! Writes the arm's dynamics before the crate is compiled.

use dalembert_codegen::builder::{BuildError, Generator};
use dalembert_codegen::emit::ScalarType;
use dalembert_codegen::function::Function;

fn main() -> Result<(), BuildError> {
    Generator::new()
        .robot("../../generated/robots/planar2r.toml")
        .outputs([Function::InverseDynamics, Function::ManipulatorEquation])
        .scalars([ScalarType::F64])
        .module("arm")
        .write_to_out_dir("arm.rs")
}
