//! A payload, by its load, and gravity as arguments: code gives what robot files with them give.

use dalembert_codegen::workspace::{JointState, RunnableCode, Runtime};
use dalembert_codegen::{Function, GeneratedCode, Request};
use dalembert_model::number::{Angle, Rational};
use dalembert_model::robot::{Inertia, Robot};
use dalembert_model::scene::{Payload, Scene};

use crate::support::{self, Case, hold, is_close, largest};

fn in_the_file(robot: &Robot, state: &JointState) -> Robot {
    let number = |x: &f64| Rational::from_float(*x).unwrap();
    let payload = state.payload.as_chunks::<10>().0.first().map(|numbers| {
        let [mass, x, y, z, inertia @ ..] = numbers.each_ref().map(number);
        Payload {
            mass,
            com: [x, y, z],
            inertia: Inertia::of(inertia),
        }
    });
    let gravity = <&[f64; 3]>::try_from(state.g.as_slice()).ok();
    let scene = Scene {
        name: "carrying".to_owned(),
        payload,
        gravity: gravity.map(|g| g.each_ref().map(number)),
        ..Scene::default()
    };
    scene.apply(robot)
}

fn run(generated: &GeneratedCode, emitted: &RunnableCode, state: &JointState) -> Vec<f64> {
    let mut state = state.clone();
    let mut codes = generated.emitted.iter();
    let load = codes.find(|e| e.function == Function::Load && e.scalar == emitted.scalar);
    if let Some(load) = load {
        state.load = load.run(&state);
    }
    emitted.run(&state)
}

/// Compares code with the runtimes of `plain` and of robots whose files have what the states give:
/// 100 u of a vector's largest entry, or of a sixteenth of the largest met.
#[track_caller]
pub fn hold_in_files(
    generated: &GeneratedCode,
    states: &[JointState],
    plain: &Request,
    what: &str,
    robot: impl Fn(&mut JointState) -> Robot,
) {
    let codes = generated.emitted.iter();
    for emitted in codes.filter(|code| code.function != Function::Load) {
        let function = emitted.function;
        let compared = states.iter().map(|state| {
            let mut state = state.in_scalar(emitted.scalar);
            let merged = robot(&mut state);
            let runtime = Runtime::in_scene(plain.prepare(&merged).unwrap());
            let granted = runtime.granted(function, &state);
            let expected = runtime.run(function, &state);
            (run(generated, emitted, &state), expected, granted)
        });
        hold(emitted, &compared.collect::<Vec<_>>(), what);
    }
}

#[track_caller]
fn check(case: &Case, count: usize) {
    let name = &case.robot().name;
    let generated = case.rounds_well(count, name);
    let (_, mut states) = case.runtime(count, 0x6c6f_6164);
    states[0].payload.fill(0.0);
    let plain = Request {
        scene: case.request.scene.clone(),
        ..Request::default()
    };
    hold_in_files(&generated, &states, &plain, name, |state| {
        in_the_file(case.robot(), state)
    });
}

#[test]
fn a_load_is_the_payload_in_the_robot_file() {
    let many = "inverse_dynamics, gravity, inertia, coriolis, manipulator_equation, \
        dynamic_coefficients, kinetic_energy, momentum, coriolis_matrix, \
        inverse_dynamics_derivatives, passivity, forward_dynamics, inertia_inverse; \
        parameters: payload, gravity";
    let few = "inverse_dynamics, forward_dynamics; parameters: payload";
    let still = "lock = { 4 = 0, 5 = 0, 6 = 0 }; velocity = \"zero\"";
    let in_it = "inverse_dynamics, inertia; parameters: payload";
    for (name, scene, asked, count) in [
        ("planar3r", "", many, 20),
        ("puma560", "", few, 10),
        ("stanford", "", few, 10),
        ("puma560", still, in_it, 10),
    ] {
        check(&Case::in_scene(name, scene, asked), count);
    }
}

/// A payload is given in the last link's own frame, at run time as in a scene.
#[test]
fn a_payload_is_in_the_links_own_frame() {
    let asked = "outputs: inverse_dynamics; parameters: payload";
    let case = Case::new("payload_frame", "", asked);
    check(&case, 10);
    // Any angle: numbers that are no permutation of others.
    let file = support::source("payload_frame", "");
    let tilted = file.replace("[0, 1, 0]\nmass = 1\n", "[0.2, 0.9, -0.4]\nmass = 1\n");
    check(&Case::read(&tilted, asked), 10);
    let mut rows = Case::new("payload_frame", "", &format!("{asked}; scalar: f64"));
    let of_frames = rows.generated();
    let frame = rows.reading.robot.payload_frame.take().unwrap();
    assert_eq!(frame.rpy[0], Angle::right_angles(1));
    let of_rows = rows.generated();
    for state in case.runtime(10, 7).1 {
        let &[mass, x, y, z, xx, yy, zz, xy, yz, xz] = state.payload.as_slice() else {
            panic!("a payload has ten numbers");
        };
        let (x, y, z) = (x + 0.1, y - 0.2, z + 0.05);
        let turned = JointState {
            payload: vec![mass, x, -z, y, xx, zz, yy, -xz, -yz, xy],
            ..state.clone()
        };
        for (one, other) in of_frames.emitted.iter().zip(&of_rows.emitted) {
            let (found, expected) = (run(&of_frames, one, &state), run(&of_rows, other, &turned));
            let most = 1e-12 * largest(&expected);
            assert!(is_close(&found, &expected, most), "{}", one.function);
        }
    }
}

#[test]
fn gravity_is_that_of_the_robot_file() {
    let asked = "inverse_dynamics, gravity, potential_energy, forward_dynamics";
    let base = "base = { xyz = [1, 2, 3], rpy = [\"1/3\", \"-1/3\", \"2/3\"] }\n\n[[joint]]";
    for name in ["planar2r", "stanford"] {
        let asked = format!("outputs: {asked}; parameters: gravity");
        let source = support::source(name, "");
        let more = asked.replace(';', ", full_regressor;");
        let placed = source.replacen("[[joint]]", base, 1);
        check(&Case::read(&source, &more), 10);
        check(&Case::read(&placed, &asked), 10);
    }
}
