//! Every formulation in f64 against τ, D, h and c of an independent library.

use crate::equations_support::golden::{by_runtime, check, numbers, read};
use crate::equations_support::{placed, sincos};
use crate::support::{ROBOTS, generated, reading};
use dalembert_model::equations::Formulation;
use dalembert_model::reference::Reference;

#[test]
fn formulations_give_the_golden_states() {
    for name in ROBOTS {
        let (arm, states) = read(name);
        for state in &states {
            let [q, qd, qdd] = ["q", "qd", "qdd"].map(|key| numbers(&state[key]));
            let at = placed(&arm, &q, |x| x, sincos);
            for formulation in Formulation::ALL {
                let found = [
                    ("tau", formulation.inverse_dynamics(&arm, &at, &qd, &qdd)),
                    ("D", formulation.inertia(&arm, &at).concat()),
                    ("h", formulation.velocity_terms(&arm, &at, &qd)),
                    ("c", formulation.gravity(&arm, &at)),
                ];
                check(&found, state, 1e-12, &format!("{name} {formulation:?}"));
            }
        }
    }
}

#[test]
fn runtimes_give_the_golden_states() {
    for name in ROBOTS {
        let (arm, states) = read(name);
        let robot = reading(&generated(name)).robot;
        for runtime in [Reference::new(arm), Reference::from_robot(&robot)] {
            for state in &states {
                let found = by_runtime(&runtime, state);
                check(&found, state, 100.0 * f64::EPSILON / 2.0, name);
            }
        }
    }
}
