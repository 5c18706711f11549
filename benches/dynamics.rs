//! Generated functions against the recursion in symbols, unsimplified, and against the
//! generic recursion; what sharing saves; f64 against f32; with the sines of all angles
//! together and with none to compute. Read the ratios, the times are this machine's.
//!
//! `cargo bench --bench dynamics`

mod rounds;

use std::hint::black_box;
use std::path::Path;

use dalembert_codegen::RobotFile;
use dalembert_generated::{panda, puma560, puma560_f32, stanford, ur10};
use dalembert_model::reference::Reference;
use dalembert_model::scalar::field::Points;
use nalgebra::DVector;
use rounds::Rounds;

#[rustfmt::skip] // As the generator writes it.
#[path = "generated/recursion.rs"]
mod symbolic;

const CALLS: usize = 200;
const ROUNDS: usize = 1001;

fn reference(name: &str) -> Reference<f64> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let file = RobotFile::read(&root.join(format!("generated/robots/{name}.toml")));
    Reference::from_robot(&file.expect("a checked-in robot").robot)
}

/// States that no constant folds and no branch of a sine is learnt from.
fn states<const N: usize>(seed: u64) -> Vec<[f64; N]> {
    let mut points = Points::new(seed);
    let state = |_| [0.0; N].map(|_: f64| std::f64::consts::PI * points.unit());
    (0..CALLS).map(state).collect()
}

fn calls<R>(rounds: &mut Rounds, name: &'static str, run: impl Fn(usize) -> R) {
    rounds.time(name, || {
        for k in 0..CALLS {
            black_box(run(k));
        }
    });
}

macro_rules! inverse_dynamics {
    ($robot:ident) => {{
        const N: usize = $robot::N;
        let (q, qd, qdd) = (states::<N>(1), states::<N>(2), states::<N>(3));
        let generic = reference(stringify!($robot));
        let vectors = [&q, &qd, &qdd].map(|states| {
            let vector = |x: &[f64; N]| DVector::from_column_slice(x);
            states.iter().map(vector).collect::<Vec<_>>()
        });
        let mut rounds = Rounds::of(CALLS);
        for _ in 0..ROUNDS {
            calls(&mut rounds, "generated", |k| {
                $robot::inverse_dynamics(black_box(&q[k]), &qd[k], &qdd[k])
            });
            calls(&mut rounds, "recursion in symbols, unsimplified", |k| {
                symbolic::$robot::inverse_dynamics(black_box(&q[k]), &qd[k], &qdd[k])
            });
            calls(&mut rounds, "generic recursion", |k| {
                let [q, qd, qdd] = [0, 1, 2].map(|i| &vectors[i][k]);
                generic.inverse_dynamics(black_box(q), qd, qdd)
            });
        }
        rounds.print(concat!(stringify!($robot), " inverse_dynamics f64"));
    }};
}

fn variants() {
    let [q, qd, qdd] = [1, 2, 3].map(states::<6>);
    let single = [&q, &qd, &qdd].map(|states| {
        let single = |x: &[f64; 6]| x.map(|x| x as f32);
        states.iter().map(single).collect::<Vec<_>>()
    });
    let mut rounds = Rounds::of(CALLS);
    for _ in 0..ROUNDS {
        calls(&mut rounds, "inertia, coriolis, gravity", |k| {
            let q = black_box(&q[k]);
            let (inertia, coriolis) = (puma560::inertia(q), puma560::coriolis(q, &qd[k]));
            (inertia, coriolis, puma560::gravity(q))
        });
        calls(&mut rounds, "manipulator_equation", |k| {
            puma560::manipulator_equation(black_box(&q[k]), &qd[k])
        });
        calls(&mut rounds, "dynamic_coefficients", |k| {
            puma560::dynamic_coefficients(black_box(&q[k]))
        });
        calls(&mut rounds, "inverse_dynamics", |k| {
            puma560::inverse_dynamics(black_box(&q[k]), &qd[k], &qdd[k])
        });
        calls(&mut rounds, "inverse_dynamics f32", |k| {
            let [q, qd, qdd] = single.each_ref().map(|states| &states[k]);
            puma560_f32::inverse_dynamics(black_box(q), qd, qdd)
        });
    }
    rounds.print("puma560, functions");
}

fn main() {
    inverse_dynamics!(puma560);
    inverse_dynamics!(stanford);
    inverse_dynamics!(ur10);
    inverse_dynamics!(panda);
    variants();
}
