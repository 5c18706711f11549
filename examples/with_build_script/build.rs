//! Writes the arm's dynamics before the crate is compiled.

use dalembert_build::{BuildError, Generator};

fn main() -> Result<(), BuildError> {
    Generator::new("robots/arm.toml")
        .ask("outputs", "inverse_dynamics, manipulator_equation")
        .write_to_out_dir("arm.rs")
}
