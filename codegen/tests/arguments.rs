//! Parameters of the robot that are arguments: a payload by its load, gravity. What
//! is generated gives what the robot file with that payload, or that gravity, gives.

use dalembert_codegen::workspace::{
    Argument, BOUND, Emitted, Granted, Input, JointState, Operand, Runtime, RuntimeParameter, keep,
    prove,
};
use dalembert_codegen::{Function, Generated, Plan, Program, Request, ScalarType, SinCos, Start};
use dalembert_model::equations::Formulation;
use dalembert_model::number::{Angle, Rational};
use dalembert_model::robot::{Inertia, Placement, Position, Robot};
use dalembert_model::scene::{Payload, Scene};

use crate::support;

const PAYLOAD: &[RuntimeParameter] = &[RuntimeParameter::Payload];
const GRAVITY: &[RuntimeParameter] = &[RuntimeParameter::Gravity];
const BOTH: &[RuntimeParameter] = &RuntimeParameter::ALL;

/// Every function that a payload has to do with.
const LOADED: [Function; 13] = [
    Function::InverseDynamics,
    Function::Gravity,
    Function::Inertia,
    Function::Coriolis,
    Function::ManipulatorEquation,
    Function::DynamicCoefficients,
    Function::KineticEnergy,
    Function::Momentum,
    Function::CoriolisMatrix,
    Function::InverseDynamicsDerivatives,
    Function::Passivity,
    Function::ForwardDynamics,
    Function::InertiaInverse,
];

fn request(functions: &[Function], parameters: &[RuntimeParameter]) -> Request {
    Request {
        parameters: parameters.to_vec(),
        ..Request::of(functions)
    }
}

fn generate(robot: &Robot, request: &Request) -> Generated {
    dalembert_codegen::generate(robot, request).unwrap_or_else(|error| panic!("{error}"))
}

fn number(x: f64) -> Rational {
    Rational::from_float(x).unwrap()
}

/// Returns the robot of a file in which the last link carries the payload, merged exactly,
/// and gravity is as the state says where it says anything.
fn in_the_file(robot: &Robot, state: &JointState) -> Robot {
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

/// Compares emitted code against the runtime of the robot with all that in its file, by the rule
/// of every function: 100 u of a vector's largest entry, or of a sixteenth of the largest met.
fn check(robot: &Robot, request: &Request, states: usize) {
    let generated = generate(robot, request);
    let scene_robot = request.scene_robot(robot).unwrap();
    let states = scene_robot.states(states, 0x6c6f_6164);
    let own = Runtime::in_scene(scene_robot);
    for emitted in &generated.emitted {
        let name = (&robot.name, emitted.function, emitted.scalar);
        // What verifies the functions of a command.
        for measure in emitted.against_runtime(&own, &states) {
            assert!(measure.in_units() < BOUND, "{name:?}: {measure:?}");
        }
        if emitted.function == Function::Load {
            continue;
        }
        let cases = states.iter().map(|state| {
            let state = state.in_scalar(emitted.scalar);
            let runtime = Runtime::new(&in_the_file(robot, &state));
            let granted = runtime.granted(emitted.function, &state);
            let expected = runtime.run(emitted.function, &state);
            (run(&generated, emitted, &state), expected, granted)
        });
        let cases: Vec<(Vec<f64>, Vec<f64>, Granted)> = cases.collect();
        let mut start = 0;
        for quantity in emitted.function.quantities() {
            let range = start..start + quantity.len(emitted.sizes);
            start = range.end;
            let size = |values: &[f64]| values.iter().fold(0.0f64, |most, x| most.max(x.abs()));
            let sizes = cases.iter().map(|(_, b, _)| size(&b[range.clone()]));
            let least = sizes.fold(0.0, f64::max) / 16.0;
            for (found, expected, granted) in &cases {
                let (found, expected) = (&found[range.clone()], &expected[range.clone()]);
                let unit = emitted.scalar.unit_roundoff();
                let granted = granted.to(*quantity);
                let most = BOUND * unit * granted * size(expected).max(least);
                for (a, b) in found.iter().zip(expected) {
                    assert!((a - b).abs() <= most, "{name:?} {quantity:?}: {a} {b}");
                }
            }
        }
    }
}

/// Of every function that takes a load, and with gravity of both arguments.
#[test]
fn a_load_is_the_payload_in_the_robot_file() {
    check(&support::robot("planar3r"), &request(&LOADED, BOTH), 20);
    let few = [Function::InverseDynamics, Function::ForwardDynamics];
    for name in ["puma560", "stanford"] {
        check(&support::robot(name), &request(&few, PAYLOAD), 10);
    }
}

/// The last joint turns about the y axis of its own frame, which so is turned by a
/// quarter about x in the frame of the table's last row; payloads are given beside it.
const PLACED: &str = "\
name = \"arm\"
gravity = [0.3, 0, -9.81]
payload_frame = { xyz = [0.1, -0.2, 0.05] }
[[joint]]
kind = \"revolute\"
placement = { xyz = [0, 0, 0.3] }
axis = [0, 0, 1]
mass = 2
com = [0.2, -0.1, 0.03]
inertia = [0.02, 0.03, 0.04, 0, 0, 0.001]
[[joint]]
kind = \"revolute\"
placement = { xyz = [0.1, 0, 0.2], rpy = [\"pi/2\", 0, 0] }
axis = [0, 0, 1]
mass = 1.5
com = [0.2, 0.1, 0.03]
inertia = [0.01, 0.02, 0.02, 0, 0.001, 0]
[[joint]]
kind = \"revolute\"
placement = { xyz = [0.3, 0, 0], rpy = [\"pi/2\", 0, 0] }
axis = [0, 1, 0]
mass = 1
com = [-0.1, 0.02, 0.05]
inertia = [0.02, 0.03, 0.04, 0, 0, 0]
";

/// A payload is given in the last link's own frame, at run time as in a scene: the
/// same arm by its table takes the same body with its numbers turned by hand.
#[test]
fn a_payload_is_in_the_links_own_frame() {
    let placed = support::read_robot(PLACED);
    let request = request(&[Function::InverseDynamics], PAYLOAD);
    check(&placed, &request, 10);
    // Any angle: numbers that are no permutation of others.
    let tilted = "axis = [0.2, 0.9, -0.4]\nmass = 1\n";
    check(
        &support::read_robot(&PLACED.replace("axis = [0, 1, 0]\nmass = 1\n", tilted)),
        &request,
        10,
    );

    let own = placed.payload_frame.clone().unwrap();
    assert_eq!(own.rpy[0], Angle::right_angles(1));
    let rows = Robot {
        payload_frame: None,
        ..placed.clone()
    };
    let [of_frames, of_rows] = [&placed, &rows].map(|robot| generate(robot, &request));
    for state in request.scene_robot(&placed).unwrap().states(10, 7) {
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
            let found = run(&of_frames, one, &state);
            let expected = run(&of_rows, other, &turned);
            let size = expected.iter().fold(0.0f64, |most, x| most.max(x.abs()));
            for (a, b) in found.iter().zip(&expected) {
                assert!((a - b).abs() <= 1e-12 * size, "{}: {a} {b}", one.function);
            }
        }
    }
    let frame =
        "in that of joint 3 in the table\n/// at xyz (0.1, -0.05, -0.2) m, rpy (pi/2, 0, 0)";
    assert!(of_frames.text().contains(frame), "{}", of_frames.text());
}

/// All zero, the payload is none.
#[test]
fn a_load_of_nothing_is_the_robot() {
    let robot = support::robot("planar2r");
    let request = request(&[Function::InverseDynamics], PAYLOAD);
    let generated = generate(&robot, &request);
    let runtime = Runtime::new(&robot);
    for mut state in request.scene_robot(&robot).unwrap().states(20, 5) {
        state.payload.fill(0.0);
        let [_, emitted] = [0, 1].map(|place| &generated.emitted[place]);
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
    let functions = [
        Function::InverseDynamics,
        Function::Gravity,
        Function::PotentialEnergy,
        Function::ForwardDynamics,
        Function::FullRegressor,
    ];
    for name in ["planar2r", "stanford"] {
        let mut robot = support::robot(name);
        check(&robot, &request(&functions, GRAVITY), 10);
        robot.base = Some(Placement {
            xyz: [1, 2, 3].map(|x| Rational::from_integer(x.into())),
            rpy: [1, -1, 2].map(|x| Angle::Radians(Rational::new(x.into(), 3.into()))),
        });
        check(&robot, &request(&functions[..4], GRAVITY), 10);
    }
    // What reads no gravity has no argument for it.
    let generated = generate(
        &support::robot("planar2r"),
        &request(&[Function::Inertia, Function::Jacobian], GRAVITY),
    );
    assert!(!generated.text().contains("g: &["));
}

/// Base parameters are fewer where gravity has one direction than where it may have
/// any: those of the argument are for all of these.
#[test]
fn a_regressor_is_over_what_any_gravity_shows() {
    let robot = support::robot("puma560");
    for function in [Function::Regressor, Function::PassivityRegressor] {
        let columns = |parameters: &[RuntimeParameter]| {
            let generated = generate(&robot, &request(&[function], parameters));
            generated.functions[0].program.sizes().base
        };
        let [fixed, any] = [&[][..], GRAVITY].map(columns);
        assert!(any > fixed, "{function}: {any} {fixed}");
    }
}

/// A locked wrist carries the payload too, and rates that are zero take nothing
/// from what D needs.
#[test]
fn loads_in_scenes() {
    let robot = support::robot("puma560");
    let zero = || Position::Angle(Angle::right_angles(0));
    let scene = Scene {
        name: "still".to_owned(),
        lock: vec![(3, zero()), (4, zero()), (5, zero())],
        velocity_zero: true,
        ..Scene::default()
    };
    let functions = [Function::InverseDynamics, Function::Inertia];
    let request = Request {
        scene: Some(scene.clone()),
        ..request(&functions, PAYLOAD)
    };
    let generated = generate(&robot, &request);
    let scene_robot = request.scene_robot(&robot).unwrap();
    for state in scene_robot.states(10, 9) {
        let carrying = Scene {
            payload: None,
            ..scene.clone()
        };
        let merged = in_the_file(&robot, &state);
        let expected = Request {
            scene: Some(carrying),
            ..Request::default()
        };
        let runtime = Runtime::in_scene(expected.scene_robot(&merged).unwrap());
        for emitted in &generated.emitted {
            if emitted.function == Function::Load || emitted.scalar == ScalarType::F32 {
                continue;
            }
            let expected = runtime.run(emitted.function, &state);
            let size = expected.iter().fold(0.0f64, |most, x| most.max(x.abs()));
            for (a, b) in run(&generated, emitted, &state).iter().zip(&expected) {
                assert!((a - b).abs() <= 1e-12 * size, "{a} {b}");
            }
        }
    }
}

/// A program that reads another number of the load, or of gravity, is refused; so
/// is a load that is another.
#[test]
fn wrong_entries_are_disproved() {
    let robot = support::robot("planar3r");
    let request = request(&[Function::InverseDynamics], BOTH);
    let scene_robot = request.scene_robot(&robot).unwrap();
    let generated = generate(&robot, &request);
    let mut planted = 0;
    for function in &generated.functions {
        let program = &function.program;
        assert!(prove(&scene_robot, program).is_ok());
        for argument in [Argument::Load, Argument::Gravity, Argument::Payload] {
            let length = argument.length(program.sizes());
            for entry in 0..length {
                let other = |input: Input| match input {
                    Input::Entry(own, index) if (own, index) == (argument, entry) => {
                        Input::Entry(own, (index + 1) % length)
                    }
                    input => input,
                };
                let wrong = with_inputs(program, other);
                if wrong != *program {
                    assert!(prove(&scene_robot, &wrong).is_err(), "{argument:?} {entry}");
                    planted += 1;
                }
            }
        }
        let mut swapped = program.clone();
        swapped.outputs.swap(0, 1);
        assert!(prove(&scene_robot, &swapped).is_err());
    }
    assert!(planted > 10, "{planted}");
}

/// Returns the program with other inputs.
fn with_inputs(program: &Program, other: impl Fn(Input) -> Input) -> Program {
    let mut program = program.clone();
    let change = |operand: &mut Operand| {
        if let Operand::Input(input) = operand {
            *input = other(*input);
        }
    };
    for step in &mut program.steps {
        change(&mut step.left);
        change(&mut step.right);
    }
    program
        .outputs
        .iter_mut()
        .for_each(|o| change(&mut o.value));
    program
}

/// What cannot be is refused, by name and with what to do.
#[test]
fn refusals() {
    let robot = support::robot("planar2r");
    let torques = request(&[Function::InverseDynamics], PAYLOAD);
    let gravity_in_scene = Scene {
        name: "moon".to_owned(),
        gravity: Some([0, -2, 0].map(|x| Rational::from_integer(x.into()))),
        ..Scene::default()
    };
    let cases = [
        (
            request(&[Function::ReactionWrenches], PAYLOAD),
            "`reaction_wrenches` depends on parameters of the payload that have no effect on joint torques",
        ),
        (
            Request {
                start: Start::Only(Formulation::LagrangeEuler),
                ..torques.clone()
            },
            "the formulation `lagrange_euler` has no regrouped parameters",
        ),
        (
            Request {
                batch: true,
                ..torques.clone()
            },
            "batches in Rust take arguments with an entry a joint, and payload is none",
        ),
        (
            Request {
                scene: Some(gravity_in_scene),
                ..request(&[Function::Gravity], GRAVITY)
            },
            "the scene `moon` says what gravity is",
        ),
    ];
    for (request, expected) in cases {
        let error = dalembert_codegen::generate(&robot, &request).unwrap_err();
        assert!(error.to_string().starts_with(expected), "{error}");
    }
    let reading = support::reading_with(
        "planar2r",
        "[scene.rough]\ntolerance = { value = 1e-3, relative_to = \"range\" }\n\
         box = { position = [[-1, 1], [-1, 1]], velocity = [1, 1], acceleration = [1, 1] }\n",
    );
    for (parameters, argument) in [(PAYLOAD, "load"), (GRAVITY, "g")] {
        let request = Request {
            scene: reading.scenes.first().cloned(),
            ..request(&[Function::InverseDynamics], parameters)
        };
        let error = dalembert_codegen::generate(&robot, &request).unwrap_err();
        let expected = format!("no box bounds its argument `{argument}`");
        assert!(error.to_string().contains(&expected), "{error}");
    }
}

/// A plan keeps programs of constants and of arguments side by side: neither is taken
/// for the other, nor for one with other parameters or another load.
#[test]
fn plans_keep_programs_by_what_is_an_argument() {
    let robot = support::robot("planar2r");
    let plain = request(&[Function::Gravity, Function::Jacobian], &[]);
    let plan: Plan = keep(&robot, &plain, &generate(&robot, &plain), None).plan;
    let taking = Request {
        plan: Some(plan.clone()),
        parameters: BOTH.to_vec(),
        ..plain
    };
    let generated = generate(&robot, &taking);
    let planned: Vec<bool> = generated.functions.iter().map(|f| f.planned).collect();
    assert_eq!(planned, [false, false, true], "load, gravity, jacobian");
    let kept = keep(&robot, &taking, &generated, Some(plan.clone())).plan;
    assert_eq!(
        kept.entries.len(),
        plan.entries.len() + 2,
        "gravity, a scalar each"
    );
    let text = kept.write();
    assert!(text.contains("\nparameters payload,gravity "), "{text}");
    assert_eq!(Plan::parse(&text).unwrap(), kept);
    let planned = |plan: &Plan, parameters: &[RuntimeParameter]| {
        let request = Request {
            plan: Some(plan.clone()),
            ..request(&[Function::Gravity], parameters)
        };
        let generated = generate(&robot, &request);
        let gravity = generated.functions.last().unwrap();
        (gravity.planned, generated.text())
    };
    let fresh = generate(&robot, &request(&[Function::Gravity], BOTH)).text();
    assert_eq!(planned(&kept, BOTH), (true, fresh));
    assert!(planned(&kept, &[]).0);
    assert!(!planned(&kept, PAYLOAD).0 && !planned(&kept, GRAVITY).0);
    // Numbers of another load: searched for anew, not refused.
    let line = text
        .lines()
        .find(|line| line.starts_with("parameters "))
        .unwrap();
    let (rest, _) = line.rsplit_once(' ').unwrap();
    let other = text.replace(line, &format!("{rest} 0123456789abcdef"));
    assert!(!planned(&Plan::parse(&other).unwrap(), BOTH).0);
    for (words, said) in [
        ("payload,gravity", "expected `payload`"),
        ("payload,wind 4 0", "expected `payload`"),
        ("payload,payload 4 0", "expected `payload`"),
        ("payload -1 0", "expected `payload`"),
        ("payload 99999999999 0", "expected `payload`"),
        ("payload 4 0\nparameters gravity 0 0", "once"),
    ] {
        let error = Plan::parse(&text.replace(line, &format!("parameters {words}")));
        let error = error.unwrap_err().to_string();
        assert!(error.contains(said), "{words}: {error}");
    }
}

/// The heads of both scalars' functions have the arguments, each of a type of its own.
#[test]
fn functions_have_the_arguments() {
    let request = request(&[Function::InverseDynamics, Function::Gravity], BOTH);
    let text = generate(&support::robot("planar2r"), &request).text();
    for expected in [
        "pub struct Payload(pub [f64; 10]);",
        "pub fn load(payload: &Payload) -> Load {",
        "pub fn inverse_dynamics(q: &[f64; 2], qd: &[f64; 2], qdd: &[f64; 2], g: &Gravity, load: &Load) -> [f64; 2] {",
        "pub fn gravity(q: &[f32; 2], g: &Gravity, load: &Load) -> [f32; 2] {",
    ] {
        assert!(text.contains(expected), "{expected}\n{text}");
    }
}

/// D with a payload and polynomial sines was once looked for in a box without payloads.
#[test]
fn polynomial_sines_of_an_inertia_with_a_payload() {
    let request = Request {
        sincos: SinCos::Polynomial { error: None },
        ..request(&[Function::Inertia, Function::Gravity], BOTH)
    };
    let text = generate(&support::robot("planar2r"), &request).text();
    assert!(text.contains("pub fn inertia(q: &[f64; 2], load: &Load) -> [[f64; 2]; 2] {"));
}

/// Operations: `load`, torques with any payload, torques with gravity.
#[test]
fn counts() {
    let bars = [
        ("planar3r", [18, 57, 50]),
        ("puma560", [28, 337, 284]),
        ("stanford", [28, 283, 225]),
        ("ur10", [31, 320, 286]),
        ("panda", [42, 523, 547]),
    ];
    let found = bars.map(|(name, _)| {
        let robot = support::robot(name);
        let count = |parameters: &[RuntimeParameter]| -> Vec<usize> {
            let mut request = request(&[Function::InverseDynamics], parameters);
            request.scalars = vec![ScalarType::F64];
            let functions = generate(&robot, &request).functions;
            functions.iter().map(|f| f.counts().operations()).collect()
        };
        let counts = [count(PAYLOAD), count(GRAVITY)].concat();
        (name, <[usize; 3]>::try_from(counts).unwrap())
    });
    assert_eq!(found, bars, "update the bars if their sum went down");
}
