//! Every formulation in f64 against τ, D, h and c of an independent library.

use crate::equations_support::{golden, normwise, positions};
use dalembert_model::equations::{Arm, Formulation};
use dalembert_model::read;
use dalembert_model::reference::Reference;
use nalgebra::DVector;

/// The bound of the golden states, normwise.
const BOUND: f64 = 1e-12;

#[test]
fn golden_states() {
    for name in golden::ROBOTS {
        let (arm, states) = golden::read(name);
        for formulation in Formulation::ALL {
            // Worst error of τ, D, h, c.
            let mut worst = [0.0f64; 4];
            for state in &states {
                let at = arm.at(&positions(&arm, &state.q));
                let tau = formulation.inverse_dynamics(&arm, &at, &state.qd, &state.qdd);
                let d = formulation.inertia(&arm, &at).concat();
                let h = formulation.velocity_terms(&arm, &at, &state.qd);
                let c = formulation.gravity(&arm, &at);
                let errors = [
                    normwise(&tau, &state.tau),
                    normwise(&d, &state.d),
                    normwise(&h, &state.h),
                    normwise(&c, &state.c),
                ];
                for (worst, error) in worst.iter_mut().zip(errors) {
                    *worst = worst.max(error);
                }
            }
            println!("{name} {formulation:?}: {worst:?}");
            assert!(
                worst.iter().all(|e| *e <= BOUND),
                "{name} {formulation:?}: {worst:?}"
            );
        }
    }
}

/// Returns the runtime of the arm in the golden file, and of the robot file.
fn runtimes(name: &str, arm: Arm<f64>) -> [Reference<f64>; 2] {
    let robots = concat!(env!("CARGO_MANIFEST_DIR"), "/../generated/robots");
    let text = std::fs::read_to_string(format!("{robots}/{name}.toml")).unwrap();
    let reading = read::parse(&text, &read::Options::default()).unwrap();
    [Reference::new(arm), Reference::from_robot(&reading.robot)]
}

#[test]
fn runtime_on_golden_states() {
    let bound = 100.0 * f64::EPSILON / 2.0;
    for name in golden::ROBOTS {
        let (arm, states) = golden::read(name);
        let vector = |values: &[f64]| DVector::from_column_slice(values);
        let runtimes = runtimes(name, arm);
        for (runtime, state) in runtimes
            .iter()
            .flat_map(|r| states.iter().map(move |s| (r, s)))
        {
            let [q, qd, qdd] = [&state.q, &state.qd, &state.qdd].map(|x| vector(x));
            let tau = runtime.inverse_dynamics(&q, &qd, &qdd).unwrap();
            let d = runtime.inertia(&q).unwrap();
            let h = runtime.coriolis(&q, &qd).unwrap();
            let c = runtime.gravity(&q).unwrap();
            assert!(normwise(tau.as_slice(), &state.tau) <= bound, "{name}");
            // Symmetric: its columns are its rows.
            assert!(normwise(d.as_slice(), &state.d) <= bound, "{name}");
            assert!(normwise(h.as_slice(), &state.h) <= bound, "{name}");
            assert!(normwise(c.as_slice(), &state.c) <= bound, "{name}");
        }
    }
}
