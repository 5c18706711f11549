//! The functions that the peers have too, of four robots: with every operation rounded,
//! and with a product and its sum made one, as the peers' compilers make them.

use dalembert_build::{BuildError, Fma, Generator, Output, Scalar, SinCos};

fn main() -> Result<(), BuildError> {
    for robot in ["puma560", "stanford", "ur10", "panda"] {
        for (fma, module) in [
            (Fma::Off, robot.to_owned()),
            (Fma::On, format!("{robot}_fma")),
        ] {
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
                .fma(fma)
                .module(&module)
                .write_to_out_dir(format!("{module}.rs"))?;
        }
    }
    Ok(())
}
