//! The functions that the peers have too, of four robots: with every operation rounded,
//! and with a product and its sum made one, as the peers' compilers make them.

use dalembert_build::{BuildError, Generator};

fn main() -> Result<(), BuildError> {
    let outputs = "inverse_dynamics, forward_dynamics, inverse_dynamics_derivatives, \
                   forward_dynamics_derivatives";
    for robot in ["puma560", "stanford", "ur10", "panda"] {
        for (fma, module) in [("off", robot.to_owned()), ("on", format!("{robot}_fma"))] {
            Generator::new(format!("../../generated/robots/{robot}.toml"))
                .ask("outputs", outputs)
                .ask("sincos", "together")
                .ask("fma", fma)
                .write_to_out_dir(format!("{module}.rs"))?;
        }
    }
    Ok(())
}
