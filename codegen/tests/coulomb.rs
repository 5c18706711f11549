//! Coulomb friction in what is generated: its torque by hand, and scenes that drop it. `values` has
//! its numbers, `random` robots that nobody chose, `text` lines that say something else, `refused`
//! what cannot be.

use dalembert_codegen::workspace::JointState;
use dalembert_codegen::{Generated, ScalarType};

use crate::support::{self, Case, is_close, largest};

/// The force and the width of each joint of the arm, whose last one has no friction.
const FRICTION: [(f64, f64); 3] = [(2.5, 0.01), (14.0, 1.0 / 300.0), (0.0, 1.0)];

/// Returns the arm's file without friction.
fn smooth() -> String {
    let source = support::source("coulomb", "");
    let lines = source.lines().filter(|line| !line.starts_with("coulomb"));
    lines.map(|line| format!("{line}\n")).collect()
}

/// Runs the code of a function in f64 at a state.
fn run(generated: &Generated, name: &str, state: &JointState) -> Vec<f64> {
    let mut emitted = generated.emitted.iter();
    let own = emitted.find(|own| own.function.name() == name && own.scalar == ScalarType::F64);
    own.unwrap().run(state)
}

/// The torques beside those of the arm without, in all velocities; forward dynamics
/// takes them of τ, passivity has them of v.
#[test]
fn torques_are_those_of_the_textbook() {
    let asked = "outputs: inverse_dynamics, passivity, forward_dynamics; scalar: f64";
    let case = Case::new("coulomb", "", asked);
    let (with, plain) = (case.generated(), Case::read(&smooth(), asked).generated());
    for state in case.runtime(100, 0x636f_756c).1 {
        let friction = |v: &[f64]| -> Vec<f64> {
            let each = FRICTION.iter().zip(v).zip(&state.qd);
            each.map(|((&(force, width), v), qd)| force * v / qd.hypot(width))
                .collect()
        };
        let holds = |name: &str, expected: &[f64]| {
            let (own, size) = (run(&with, name, &state), largest(expected).max(1.0));
            let is_close = is_close(&own, expected, 1e-12 * size);
            assert!(is_close, "{name} at {state:?}");
        };
        for (name, v) in [("inverse_dynamics", &state.qd), ("passivity", &state.v)] {
            let rest = run(&plain, name, &state).into_iter().zip(friction(v));
            let sum: Vec<f64> = rest.map(|(x, f)| x + f).collect();
            holds(name, &sum);
        }
        let tau = state.tau.iter().zip(friction(&state.qd));
        let less = JointState {
            tau: tau.map(|(tau, f)| tau - f).collect(),
            ..state.clone()
        };
        let name = "forward_dynamics";
        holds(name, &run(&plain, name, &less));
    }
}

/// A joint that does not move has no friction, but its slope where it is at rest:
/// F/w + b.
#[test]
fn scenes_drop_what_does_not_move() {
    let asked = "inverse_dynamics_derivatives";
    let still = Case::in_scene("coulomb", "velocity = \"zero\"", asked);
    let slopes = run(&still.generated(), asked, &still.runtime(1, 3).1[0]);
    let known = [2.5 / 0.01 + 0.3, 14.0 * 300.0, 0.05];
    for (i, expected) in known.into_iter().enumerate() {
        assert!((slopes[9 + 4 * i] - expected).abs() < 1e-10 * expected);
    }
}

/// A function without friction in it is certified, and inside all limits nothing overflows.
#[test]
fn what_has_no_friction_is_as_ever() {
    let limits = "limits = { position = [-1, 1], velocity = 2, acceleration = 9, torque = 90 }";
    let scene = "\n[scene.test]\ntolerance = { value = 0.1, relative_to = \"actuator\" }\n";
    let source = support::source("coulomb", scene).replace("mass =", &format!("{limits}\nmass ="));
    let said = |asked: &str| Case::read(&source, asked).generated().warnings;
    assert_eq!(said("outputs: inverse_dynamics"), [""; 0]);
    let rough = Case::read(&source, "outputs: gravity; scene: test").generated();
    let admitted = rough.functions[0].admitted.as_ref();
    assert!(admitted.is_some_and(|own| !own.certificates.is_empty()));
}
