//! Parameters of the robot that are arguments: a payload by its load, gravity. What
//! is generated gives what the robot file with that payload, or that gravity, gives.

use dalembert_codegen::workspace::{BOUND, Emitted, Granted, JointState, Runtime};
use dalembert_codegen::{Function, Generated, Request, ScalarType, generate};
use dalembert_model::number::{Angle, Rational};
use dalembert_model::robot::{Inertia, Robot};
use dalembert_model::scene::{Payload, Scene};

use crate::support;
use crate::support::case::Case;

/// Returns the robot of a file in which the last link carries the payload, merged exactly,
/// and gravity is as the state says where it says anything.
fn in_the_file(robot: &Robot, state: &JointState) -> Robot {
    let number = |x: f64| Rational::from_float(x).unwrap();
    let mut scene = Scene {
        name: "carrying".to_owned(),
        ..Scene::default()
    };
    if let [mass, x, y, z, inertia @ ..] = state.payload.as_slice() {
        let inertia = <[f64; 6]>::try_from(inertia).expect("a payload has ten numbers");
        scene.payload = Some(Payload {
            mass: number(*mass),
            com: [*x, *y, *z].map(number),
            inertia: Inertia::of(inertia.map(number)),
        });
    }
    if let &[x, y, z] = state.g.as_slice() {
        scene.gravity = Some([x, y, z].map(number));
    }
    scene.apply(robot)
}

/// Returns the emitted code at a state, the load as the emitted `load` gives it.
fn run(generated: &Generated, emitted: &Emitted, state: &JointState) -> Vec<f64> {
    let mut state = state.clone();
    let mut all = generated.emitted.iter();
    let load = all.find(|e| e.function == Function::Load && e.scalar == emitted.scalar);
    if let Some(load) = load {
        state.load = load.run(&state);
    }
    emitted.run(&state)
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most, x| most.max(x.abs()))
}

/// Compares emitted code with the runtime of the robot in its scene, and with that of the robot
/// with all that in its file, by the rule of every function: 100 u of a vector's largest entry, or
/// of a sixteenth of the largest met.
#[track_caller]
fn check(case: &Case, count: usize) {
    let generated = case.rounds_well(count, &case.robot().name);
    let (_, states) = case.runtime(count, 0x6c6f_6164);
    let plain = Request {
        scene: case.request.scene.clone(),
        ..Request::default()
    };
    for emitted in generated
        .emitted
        .iter()
        .filter(|own| own.function != Function::Load)
    {
        let function = emitted.function;
        let cases = states.iter().map(|state| {
            let state = state.in_scalar(emitted.scalar);
            let merged = in_the_file(case.robot(), &state);
            let runtime = Runtime::in_scene(plain.setup(&merged).unwrap());
            let granted = runtime.granted(function, &state);
            let expected = runtime.run(function, &state);
            (run(&generated, emitted, &state), expected, granted)
        });
        let cases: Vec<(Vec<f64>, Vec<f64>, Granted)> = cases.collect();
        let mut start = 0;
        for quantity in function.quantities() {
            let range = start..start + quantity.len(emitted.sizes);
            start = range.end;
            let sizes = cases.iter().map(|(_, b, _)| largest(&b[range.clone()]));
            let least = sizes.fold(0.0, f64::max) / 16.0;
            for (found, expected, granted) in &cases {
                let (found, expected) = (&found[range.clone()], &expected[range.clone()]);
                let unit = BOUND * emitted.scalar.unit_roundoff() * granted.to(*quantity);
                let most = unit * largest(expected).max(least);
                let mut pairs = found.iter().zip(expected);
                let is_close = pairs.all(|(a, b)| (a - b).abs() <= most);
                assert!(is_close, "{} {function} {quantity:?}", case.robot().name);
            }
        }
    }
}

const STILL: &str = "\n[scene.still]\nlock = { 4 = 0, 5 = 0, 6 = 0 }\nvelocity = \"zero\"\n";

/// Of every function that takes a load, and with gravity of both arguments; a locked wrist carries
/// the payload too, and rates that are zero take nothing from what D needs.
#[test]
fn a_load_is_the_payload_in_the_robot_file() {
    let all = "outputs: inverse_dynamics, gravity, inertia, coriolis, manipulator_equation, \
        dynamic_coefficients, kinetic_energy, momentum, coriolis_matrix, \
        inverse_dynamics_derivatives, passivity, forward_dynamics, inertia_inverse; \
        parameters: payload, gravity";
    check(&Case::new("planar3r", "", all), 20);
    let few = "outputs: inverse_dynamics, forward_dynamics; parameters: payload";
    check(&Case::new("puma560", "", few), 10);
    check(&Case::new("stanford", "", few), 10);
    let still = "outputs: inverse_dynamics, inertia; parameters: payload; scene: still";
    check(&Case::new("puma560", STILL, still), 10);
}

/// A payload is given in the last link's own frame, at run time as in a scene: the
/// same arm by its table takes the same body with its numbers turned by hand.
#[test]
fn a_payload_is_in_the_links_own_frame() {
    let asked = "outputs: inverse_dynamics; parameters: payload";
    let case = Case::new("payload_frame", "", asked);
    check(&case, 10);
    // Any angle: numbers that are no permutation of others.
    let tilted = Case::source("payload_frame", "").replace(
        "axis = [0, 1, 0]\nmass = 1\n",
        "axis = [0.2, 0.9, -0.4]\nmass = 1\n",
    );
    check(&Case::of(&tilted, asked), 10);

    let own = case.robot().payload_frame.clone().unwrap();
    assert_eq!(own.rpy[0], Angle::right_angles(1));
    let rows = Robot {
        payload_frame: None,
        ..case.robot().clone()
    };
    let of_frames = case.generated();
    let of_rows = generate(&rows, &case.request).unwrap_or_else(|error| panic!("{error}"));
    for state in case.runtime(10, 7).1 {
        let &[mass, x, y, z, xx, yy, zz, xy, yz, xz] = state.payload.as_slice() else {
            panic!("a payload has ten numbers");
        };
        let (x, y, z) = (x + 0.1, y - 0.2, z + 0.05);
        let turned = JointState {
            payload: vec![mass, x, -z, y, xx, zz, yy, -xz, -yz, xy],
            ..state.clone()
        };
        let pairs = of_frames.emitted.iter().zip(&of_rows.emitted);
        for (one, other) in pairs.filter(|(one, _)| one.scalar == ScalarType::F64) {
            let (found, expected) = (run(&of_frames, one, &state), run(&of_rows, other, &turned));
            let most = 1e-12 * largest(&expected);
            let mut both = found.iter().zip(&expected);
            assert!(both.all(|(a, b)| (a - b).abs() <= most), "{}", one.function);
        }
    }
    let frame =
        "in that of joint 3 in the table\n/// at xyz (0.1, -0.05, -0.2) m, rpy (pi/2, 0, 0)";
    assert!(of_frames.text().contains(frame), "{}", of_frames.text());
}

/// All zero, the payload is none.
#[test]
fn a_load_of_nothing_is_the_robot() {
    let case = Case::new(
        "planar2r",
        "",
        "outputs: inverse_dynamics; parameters: payload",
    );
    let (generated, runtime) = (case.generated(), Runtime::new(case.robot()));
    for mut state in case.runtime(20, 5).1 {
        state.payload.fill(0.0);
        let emitted = &generated.emitted[1];
        let found = run(&generated, emitted, &state);
        for (a, b) in found.iter().zip(runtime.run(emitted.function, &state)) {
            assert!((a - b).abs() <= 1e-13 * b.abs().max(1.0), "{a} {b}");
        }
    }
}

/// Gravity is in base axes, wherever frame 0 stands; and the robot file's own
/// gravity is as good as any.
#[test]
fn gravity_is_that_of_the_robot_file() {
    let asked = "inverse_dynamics, gravity, potential_energy, forward_dynamics";
    let base = "base = { xyz = [1, 2, 3], rpy = [\"1/3\", \"-1/3\", \"2/3\"] }\n\n[[joint]]";
    for name in ["planar2r", "stanford"] {
        let asked = format!("outputs: {asked}; parameters: gravity");
        let source = support::source(name, "");
        check(
            &Case::of(&source, &asked.replace(';', ", full_regressor;")),
            10,
        );
        check(
            &Case::of(&source.replacen("[[joint]]", base, 1), &asked),
            10,
        );
    }
    // What reads no gravity has no argument for it.
    let case = Case::new(
        "planar2r",
        "",
        "outputs: inertia, jacobian; parameters: gravity",
    );
    assert!(!case.generated().text().contains("g: &["));
}

/// Base parameters are fewer where gravity has one direction than where it may have
/// any: those of the argument are for all of these.
#[test]
fn a_regressor_is_over_what_any_gravity_shows() {
    for function in ["regressor", "passivity_regressor"] {
        let [fixed, any] = ["", "; parameters: gravity"].map(|rest| {
            let generated = Case::new("puma560", "", &format!("outputs: {function}{rest}"));
            generated.generated().functions[0].program.sizes().base
        });
        assert!(any > fixed, "{function}: {any} {fixed}");
    }
}

/// The heads of both scalars' functions have the arguments, each of a type of its own.
#[test]
fn functions_have_the_arguments() {
    let asked = "outputs: inverse_dynamics, gravity; parameters: payload, gravity";
    let text = Case::new("planar2r", "", asked).generated().text();
    for expected in [
        "pub struct Payload(pub [f64; 10]);",
        "pub fn load(payload: &Payload) -> Load {",
        "pub fn inverse_dynamics(q: &[f64; 2], qd: &[f64; 2], qdd: &[f64; 2], g: &Gravity, load: &Load) -> [f64; 2] {",
        "pub fn gravity(q: &[f32; 2], g: &Gravity, load: &Load) -> [f32; 2] {",
    ] {
        assert!(text.contains(expected), "{expected}\n{text}");
    }
}
