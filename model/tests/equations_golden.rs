//! Every formulation in f64 against τ, D, h and c of an independent library.

mod equations_support;

use dalembert_model::equations::Formulation;
use equations_support::{golden, normwise, positions};

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
