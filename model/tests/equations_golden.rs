//! Every formulation in f64 against torques, D, h and c of an independent
//! library.

mod equations_support;

use dalembert_model::equations::lagrange_euler;
use dalembert_model::equations::newton_euler::table2::{self, Moment};
use equations_support::{golden, normwise, positions};

#[test]
fn quick() {
    for name in golden::ROBOTS {
        let (arm, states) = golden::read(name);
        let mut worst = [0.0f64; 5];
        for s in &states {
            let at = arm.at(&positions(&arm, &s.q));
            let t = table2::inverse_dynamics(&arm, &at, &s.qd, &s.qdd, Moment::RotateFirst, None);
            let t2 = table2::inverse_dynamics(&arm, &at, &s.qd, &s.qdd, Moment::AsPrinted, None);
            let h = lagrange_euler::velocity_terms(&lagrange_euler::christoffel(&arm, &at), &s.qd);
            let d = lagrange_euler::inertia(&arm, &at).concat();
            let c = lagrange_euler::gravity(&arm, &at);
            let e = [
                normwise(&t, &s.tau),
                normwise(&t2, &s.tau),
                normwise(&h, &s.h),
                normwise(&d, &s.d),
                normwise(&c, &s.c),
            ];
            for (w, e) in worst.iter_mut().zip(e) {
                *w = w.max(e);
            }
        }
        println!("{name}: {worst:?}");
    }
}
