//! What rounding costs: every robot and function within the bounds, and the
//! measure itself sees what it should.

use dalembert_codegen::workspace::{BOUND, Operand, Runtime, SEED, STATES, seeded};
use dalembert_codegen::{Function, Request, ScalarType, generate};

use crate::support;

const ROBOTS: [&str; 6] = [
    "planar2r", "stanford", "puma560", "planar3r", "ur10", "panda",
];

#[test]
fn six_robots_within_the_bound() {
    for name in support::dose(&ROBOTS, 3) {
        let robot = support::robot(name);
        let request = Request {
            functions: Function::ALL[..6].to_vec(),
            ..Request::default()
        };
        let generated = generate(&robot, &request).unwrap();
        let runtime = Runtime::new(&robot);
        let states = seeded(&robot, STATES, SEED);
        assert_eq!(generated.emitted.len(), 12);
        for emitted in &generated.emitted {
            let measures = emitted.against_runtime(&runtime, &states);
            assert_eq!(measures.len(), emitted.function.quantities().len());
            for measure in measures {
                let (function, scalar) = (measure.function, measure.scalar);
                let error = measure.in_units();
                assert!(error <= BOUND, "{name} {function} {scalar}: {error} u");
                // Rounding is seen: an error of exactly zero would mean that
                // nothing was compared. Planar gravity may be exact.
                if function == Function::InverseDynamics {
                    assert!(error > 0.0, "{name} {function} {scalar}");
                }
            }
        }
    }
}

#[test]
fn a_wrong_literal_is_far_outside() {
    let robot = support::robot("planar3r");
    let generated = support::one(&robot, Function::InverseDynamics);
    let runtime = Runtime::new(&robot);
    let states = seeded(&robot, STATES, SEED);
    for emitted in generated.emitted {
        for index in 0..emitted.text.steps.len() {
            let mut wrong = emitted.clone();
            let Operand::Constant(value) = &mut wrong.text.steps[index].right else {
                continue;
            };
            value.0 *= 1.5;
            let measures = wrong.against_runtime(&runtime, &states);
            assert!(measures[0].in_units() > 100.0 * BOUND);
            // NaN must not pass for a small error.
            let Operand::Constant(value) = &mut wrong.text.steps[index].right else {
                continue;
            };
            value.0 = f64::NAN;
            let measures = wrong.against_runtime(&runtime, &states);
            assert_eq!(measures[0].error, f64::INFINITY);
        }
    }
}

#[test]
fn states_keep_to_the_limits() {
    let robot = support::robot("stanford");
    let states = seeded(&robot, STATES, SEED);
    assert_eq!(states, seeded(&robot, STATES, SEED));
    assert_ne!(states, seeded(&robot, STATES, SEED + 1));
    let largest = |pick: fn(&dalembert_codegen::workspace::JointState) -> &Vec<f64>| {
        let values = states.iter().flat_map(pick);
        values.fold(0.0f64, |most, x| most.max(x.abs()))
    };
    assert!(largest(|s| &s.q) <= std::f64::consts::PI);
    assert!(largest(|s| &s.q) > 2.5);
    let planar = support::robot("planar2r");
    let states = seeded(&planar, STATES, SEED);
    assert!(states.iter().all(|s| s.qd.iter().all(|v| v.abs() <= 3.0)));
    assert!(states.iter().all(|s| s.qdd.iter().all(|a| a.abs() <= 10.0)));
    assert!(states.iter().any(|s| s.qdd.iter().any(|a| a.abs() > 9.0)));
}

#[test]
fn single_precision_is_compared_at_its_own_state() {
    // At 1e5 rad the f64 state is 4e-3 rad away from the f32 one.
    let robot = support::robot("planar2r");
    let generated = support::one(&robot, Function::InverseDynamics);
    let runtime = Runtime::new(&robot);
    let mut states = seeded(&robot, 50, SEED);
    for state in &mut states {
        for q in &mut state.q {
            *q *= 1e5;
        }
    }
    for emitted in generated.emitted {
        let error = emitted.against_runtime(&runtime, &states)[0].in_units();
        match emitted.scalar {
            ScalarType::F64 | ScalarType::F32 => assert!(error < BOUND, "{error}"),
        }
    }
}
