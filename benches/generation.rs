//! The time of generation: by a quick search without a plan, and by a plan.
//!
//! `cargo bench --bench generation`

mod rounds;

use std::hint::black_box;
use std::path::Path;

use dalembert_codegen::{Function, Request, RobotFile, generate};
use rounds::Rounds;

const ROUNDS: usize = 7;

fn searches(name: &str) {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let file = RobotFile::read(&root.join(format!("generated/robots/{name}.toml")));
    let RobotFile { robot, plan, .. } = file.expect("a checked-in robot");
    let six_functions = Request {
        functions: Function::ALL[..6].to_vec(),
        ..Request::default()
    };
    let torques = Request::new(&[Function::InverseDynamics]);
    let planned = Request {
        plan,
        ..torques.clone()
    };
    let mut rounds = Rounds::of(1);
    for _ in 0..ROUNDS {
        for (what, request) in [
            ("six functions", &six_functions),
            ("inverse_dynamics", &torques),
            ("inverse_dynamics, by its plan", &planned),
        ] {
            rounds.time(what, || {
                black_box(generate(&robot, request).expect("code"));
            });
        }
    }
    rounds.print(&format!("{name}, generation"));
}

fn main() {
    for name in ["puma560", "stanford", "ur10", "panda"] {
        searches(name);
    }
}
