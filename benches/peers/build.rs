//! The functions that the peers have too, of four robots.

use dalembert_build::{BuildError, Generator, Output, Scalar, SinCos};

fn main() -> Result<(), BuildError> {
    for robot in ["puma560", "stanford", "ur10", "panda"] {
        Generator::new()
            .robot(format!("../../generated/robots/{robot}.toml"))
            .outputs([
                Output::InverseDynamics,
                Output::ForwardDynamics,
                Output::InverseDynamicsDerivatives,
                Output::ForwardDynamicsDerivatives,
            ])
            .scalars([Scalar::F64])
            .sincos(SinCos::Together)
            .module(robot)
            .write_to_out_dir(format!("{robot}.rs"))?;
    }
    Ok(())
}
