//! What generation takes: by a quick search without a plan, and by a plan. Read the
//! ratios, the times are this machine's.
//!
//! `cargo bench --bench generation`

mod rounds;

use std::fs;
use std::hint::black_box;
use std::path::{Path, PathBuf};

use dalembert_codegen::workspace::plan_file;
use dalembert_codegen::{Function, Request, generate};
use dalembert_model::read;
use dalembert_model::robot::Robot;
use rounds::Rounds;

/// Rounds in which each variant runs once.
const ROUNDS: usize = 7;

fn file(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(path)
}

fn robot(name: &str) -> Robot {
    let file = file(&format!("generated/robots/{name}.toml"));
    let source = fs::read_to_string(file).expect("a checked-in robot");
    let reading = read::parse(&source);
    reading.expect("a good robot").robot
}

fn searches(name: &str) {
    let robot = robot(name);
    let all = Request {
        functions: Function::ALL[..6].to_vec(),
        ..Request::default()
    };
    let torques = Request::new(&[Function::InverseDynamics]);
    let toml = file(&format!("generated/robots/{name}.toml"));
    let planned = Request {
        plan: plan_file::beside(&toml).expect("a readable plan"),
        ..torques.clone()
    };
    let mut rounds = Rounds::of(1);
    for _ in 0..ROUNDS {
        for (what, request) in [
            ("six functions", &all),
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
