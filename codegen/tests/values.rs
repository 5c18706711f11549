//! Values of code in both scalars, by a table: each row is proved and read back as it is
//! generated, and held against the runtime of the robot in its scene, at 100 u of the largest
//! entry. A scene's code is held against the whole robot, too, and friction against the textbook.

use std::collections::BTreeSet;

use dalembert_codegen::workspace::{
    Argument, JointState, Literal, Node, Quantity, Reference, RegressorColumns, Runtime, Setup,
    TrueValue, testing::seeded,
};
use dalembert_codegen::{Function, ScalarType};
use dalembert_model::outputs::Axis;
use dalembert_model::scene::write;

use crate::support::{self, BOUND, Case, all_but_one_in, is_close, largest, one_in, rows, says};

const NAMES: &str = "
FRAMES := jacobian@camera:local, jacobian_rate@elbow:world, operational_inertia@camera:x_y_rz, operational_bias@elbow:linear, inverse_dynamics_with_wrench@camera:local, forward_dynamics_with_wrench@elbow, contact_wrench@camera:linear, momentum_observer, task=operational_inertia@camera:linear+consistent_inverse@camera:linear+null_space_projector@camera:linear
SECOND := inverse_dynamics_second_derivatives, forward_dynamics_second_derivatives
BUNDLES := servo=inverse_dynamics+jacobian+forward_kinematics, task=forward_dynamics+kinetic_energy+jacobian_rate, slopes=inverse_dynamics_derivatives+gravity, adapt=regressor+momentum
RUBBED := inverse_dynamics, passivity, forward_dynamics, inverse_dynamics_derivatives, forward_dynamics_derivatives, SECOND
LINKED := inverse_dynamics, manipulator_equation, forward_dynamics
FIRST := inverse_dynamics, inertia, coriolis, gravity, manipulator_equation, dynamic_coefficients
";

/// Robot files, outputs with options, the lines of a scene, and the number of states.
const ROWS: [&str; 2] = [
    r#"
frames/planar3r | FRAMES | | 60
wafer    | LINKED, jacobian; scalar: f64 | lock = { shoulder = 0.5 } | 20
planar3r | SECOND | lock = { 2 = 0.4 } | 60
planar3r | forward_dynamics, inertia_inverse, forward_dynamics_derivatives, forward_dynamics_second_derivatives | joints = [3, 1]; lock = { 2 = 0.5 }; velocity = "zero" | 100
planar2r | BUNDLES; batch: on | | 100
coulomb  | inverse_dynamics; parameters: payload, gravity | | 40
planar2r | inertia, gravity; parameters: payload, gravity; sincos: polynomial | | 20
base_and_tool   | inverse_dynamics, forward_kinematics, link_poses, jacobian, jacobian_rate, reaction_wrenches, potential_energy | | 50
"#,
    r#"
planar3r | reach = gravity + jacobian, coriolis | lock = { 2 = "pi/2" }; velocity = "zero" | 50
coulomb  | inverse_dynamics; formulation: lagrange_euler | | 20
nearpar | inverse_dynamics, inertia | | 50
nearly_parallel | inverse_dynamics, coriolis, forward_kinematics, jacobian_rate | | 50
frames/planar3r | FRAMES; parameters: payload, gravity | | 60
frames/planar3r | FRAMES | lock = { 2 = 0.4 } | 60
wafer    | LINKED, jacobian; scalar: f64 | joints = ["shoulder"] | 20
wafer    | LINKED; parameters: payload, gravity; scalar: f64 | | 20
planar3r | SECOND | | 60
planar3r | SECOND; parameters: payload, gravity | | 60
coulomb  | passivity, forward_dynamics, inverse_dynamics_derivatives, forward_dynamics_derivatives, SECOND; formulation: lagrange_euler | | 20
coulomb  | RUBBED; formulation: newton_euler | | 20
coulomb  | RUBBED | velocity = "zero" | 40
coulomb  | RUBBED | lock = { waist = 0.4 }; joints = ["slide", "wrist"] | 40
"#,
];

const ROBOTS: [&str; 2] = [
    "
planar2r stanford | FIRST | | 200
planar3r | FIRST; fma: on | | 200
",
    "
puma560 planar3r ur10 panda | FIRST | | 200
planar2r stanford puma560 ur10 panda | FIRST; fma: on | | 200
",
];

support::daily_and_campaign! {
    six_robots: (ROBOTS[0]), (ROBOTS[1]);
    scenes_arguments_and_frames: (ROWS[0]), (ROWS[1]);
    followers_beside_the_truth: (one_in::<8>), (all_but_one_in::<8>);
    a_parallelogram_costs_less_than_free_joints: (TIED[0]), (TIED[1]);
}

#[track_caller]
fn check(table: &str) {
    for [files, asked, scene, states] in rows(&format!("{NAMES}{table}")) {
        for file in files.split(' ') {
            let case = Case::in_scene(file, &scene, &asked);
            let what = format!("{file} {asked} {scene}");
            let generated = case.rounds_well(states.parse().unwrap(), &what);
            let count = generated.functions.len() * case.request.scalars.len();
            assert_eq!(generated.emitted.len(), count, "{what}");
            for emitted in generated.emitted {
                let is_torque = emitted.function == Function::InverseDynamics;
                let is_fused = !is_torque || emitted.text.counts().fma > 0;
                assert!(is_fused || !asked.contains("fma: on"), "{what}");
            }
        }
    }
}

use self::{check as scenes_arguments_and_frames, check as six_robots};

/// Nothing here goes through what the generator makes of the scene. A joint that is locked or zero
/// must not be read: it would show.
pub fn is_whole_robots(case: &Case) {
    let (robot, scene) = (case.robot(), case.request.scene.as_ref().unwrap());
    let generated = case.generated();
    let whole = Runtime::new(&scene.apply(robot));
    let n = robot.joints.len();
    let rows = scene.rows(n);
    for mut state in seeded(robot, 20, 7) {
        let mut unread = state.clone();
        for (joint, at) in &scene.lock {
            state.q[*joint] = at.to_f64();
            (state.qd[*joint], state.qdd[*joint]) = (0.0, 0.0);
            for entries in [&mut unread.q, &mut unread.qd, &mut unread.qdd] {
                entries[*joint] = f64::NAN;
            }
        }
        if scene.velocity_zero {
            state.qd.fill(0.0);
            unread.qd.fill(f64::NAN);
        }
        if scene.acceleration_zero {
            state.qdd.fill(0.0);
            unread.qdd.fill(f64::NAN);
        }
        for emitted in &generated.emitted {
            let full = whole.run(emitted.function, &state);
            let found = emitted.run(&unread);
            let mut start = 0;
            let mut expected = Vec::new();
            for quantity in emitted.function.quantities() {
                let mut wanted = vec![0];
                for axis in quantity.shape().0 {
                    let (length, places) = match axis {
                        Axis::Coordinates | Axis::Links => (n, rows.clone()),
                        axis => {
                            let length = axis.length(emitted.sizes);
                            (length, (0..length).collect())
                        }
                    };
                    let along = |from: usize| places.iter().map(move |at| from * length + at);
                    wanted = wanted.into_iter().flat_map(along).collect();
                }
                expected.extend(wanted.into_iter().map(|index| full[start + index]));
                start += quantity.len(emitted.sizes.over_all(n));
            }
            let most = 1e-13 * largest(&full).max(1.0);
            let is_close = is_close(&found, &expected, most);
            assert!(is_close, "{}: {found:?} {expected:?}", emitted.function);
        }
    }
}

/// A robot, the lines of a scene, and outputs; the last scene asks for the torque that a brake holds.
const SCENES: &str = r#"
PAYLOAD := payload = { mass = 2.5, com = [0.05, 0, 0.1] }
SOME := inverse_dynamics, gravity, manipulator_equation
puma560  | lock = { 4 = 0, 5 = "pi/2", 6 = "1/3" } | SOME
puma560  | lock = { 1 = 0.5, 4 = "pi", 6 = "pi/6" } | SOME
puma560  | lock = { 2 = "-pi/4", 3 = "pi/4" } | SOME
stanford | lock = { 3 = 0.5 } | SOME
stanford | lock = { 1 = 0, 2 = "pi/2", 5 = -0.3 } | SOME
panda    | lock = { 1 = 0, 3 = "pi/2", 5 = 0, 7 = "pi/4" } | SOME
planar3r | joints = [3, 1]; PAYLOAD | SOME, inertia, coriolis, dynamic_coefficients
planar3r | lock = { 2 = "pi/3" }; gravity = [1, -3, 0.5]; acceleration = "zero" | SOME, inertia, coriolis, dynamic_coefficients
planar3r | joints = [2, 1]; lock = { 2 = "pi/3", 3 = "pi/2" }; velocity = "zero"; PAYLOAD | SOME, inertia, coriolis, dynamic_coefficients
"#;

#[test]
fn scenes_are_the_full_model() {
    for [robot, scene, outputs] in rows(SCENES) {
        let asked = format!("{outputs}; scalar: f64");
        is_whole_robots(&Case::in_scene(&robot, &scene, &asked));
    }
}

#[test]
fn friction() {
    let rubbed = "inverse_dynamics, passivity, forward_dynamics, inverse_dynamics_derivatives, \
        forward_dynamics_derivatives, inverse_dynamics_second_derivatives, \
        forward_dynamics_second_derivatives";
    let others = "coriolis, manipulator_equation, dynamic_coefficients, kinetic_energy, \
        inertia_inverse, reaction_wrenches";
    let case = Case::in_scene("coulomb", "", &format!("{rubbed}, {others}"));
    for function in case.rounds_well(200, "friction").functions {
        let mut rubbed = rubbed.split(", ");
        let is_rubbed = rubbed.any(|word| word == function.function.name());
        let has_roots = function.counts().sqrt > 0;
        assert_eq!(has_roots, is_rubbed, "{}", function.function);
    }
}

const FRICTION: [(f64, f64); 3] = [(2.5, 0.01), (14.0, 1.0 / 300.0), (0.0, 1.0)];

/// A joint that does not move has no friction, but its slope: F/w + b.
#[test]
fn friction_is_that_of_the_textbook() {
    let asked = "outputs: inverse_dynamics, passivity, forward_dynamics; scalar: f64";
    let source = support::source("coulomb", "");
    let mut smooth: Vec<&str> = source.lines().collect();
    smooth.retain(|line| !line.starts_with("coulomb"));
    let [case, smooth] = [source.clone(), smooth.join("\n")].map(|file| Case::read(&file, asked));
    let [with, plain] = [&case, &smooth].map(|case| case.generated().emitted);
    for state in case.runtime(100, 0x636f_756c).1 {
        let rubbed = |x: &[f64], sign: f64, v: &[f64]| -> Vec<f64> {
            let joints = FRICTION.iter().zip(v).zip(&state.qd);
            let friction = joints.map(|(((force, width), v), qd)| force * v / qd.hypot(*width));
            x.iter().zip(friction).map(|(x, f)| x + sign * f).collect()
        };
        let less = JointState {
            tau: rubbed(&state.tau, -1.0, &state.qd),
            ..state.clone()
        };
        let expected = [
            rubbed(&plain[0].run(&state), 1.0, &state.qd),
            rubbed(&plain[1].run(&state), 1.0, &state.v),
            plain[2].run(&less),
        ];
        for (emitted, expected) in with.iter().zip(expected) {
            let most = 1e-12 * largest(&expected).max(1.0);
            let is_close = is_close(&emitted.run(&state), &expected, most);
            assert!(is_close, "{} at {state:?}", emitted.function);
        }
    }
    let asked = "inverse_dynamics_derivatives; scalar: f64";
    let still = Case::in_scene("coulomb", "velocity = \"zero\"", asked);
    let slopes = still.generated().emitted[0].run(&still.runtime(1, 3).1[0]);
    let known = [2.5 / 0.01 + 0.3, 14.0 * 300.0, 0.05];
    for (i, expected) in known.into_iter().enumerate() {
        assert!((slopes[9 + 4 * i] - expected).abs() < 1e-10 * expected);
    }
}

#[test]
fn what_has_no_friction_is_as_ever() {
    let limits = "limits = { position = [-1, 1], velocity = 2, acceleration = 9, torque = 90 }";
    let scene = "\n[scene.test]\ntolerance = { value = 0.1, relative_to = \"actuator\" }\n";
    let source = support::source("coulomb", scene).replace("mass =", &format!("{limits}\nmass ="));
    let torques = Case::read(&source, "outputs: inverse_dynamics").generated();
    assert_eq!(torques.warnings, [""; 0]);
    let rough = Case::read(&source, "outputs: gravity; scene: test").generated();
    let admitted = rough.functions[0].admitted.as_ref();
    assert!(admitted.is_some_and(|set| !set.variants.is_empty()));
}

/// Compared with 256 bits, since the runtime's recursion errs more here than the code does.
fn followers_beside_the_truth(is_tried: fn(usize) -> bool) {
    let robot = support::robot("wafer");
    let (runtime, setup) = (Runtime::new(&robot), Setup::whole(&robot));
    let truth = Reference::new(&setup);
    // It has no base parameters: its axes are turned against each other anyhow.
    let has_no_columns = |function: &Function| function.columns() == RegressorColumns::None;
    let functions = Function::of(&robot)
        .into_iter()
        .filter(has_no_columns)
        .enumerate();
    for (_, function) in functions.filter(|(place, _)| is_tried(*place)) {
        let generated = Case::in_scene("wafer", "", function.name()).generated();
        assert_eq!(generated.functions[0].program.joints, 4);
        for emitted in generated.emitted {
            let compared = setup.states(30, 3).into_iter().map(|state| {
                let state = state.in_scalar(emitted.scalar);
                let known = truth.run(function, &state);
                let granted = runtime.granted(function, &state);
                let expected = known.iter().map(TrueValue::to_f64).collect();
                (emitted.run(&state), expected, granted)
            });
            support::hold(&emitted, &compared.collect::<Vec<_>>(), "");
        }
    }
}

const TIED: [&str; 2] = [
    "inverse_dynamics inertia regressor",
    "forward_dynamics inverse_dynamics_derivatives operational_inertia passivity_regressor",
];

fn a_parallelogram_costs_less_than_free_joints(outputs: &str) {
    let (free, elbow) = (support::source("puma560", ""), "name = \"elbow\"\n");
    let mimic = "mimic = { joint = 2, multiplier = -1 }\n";
    let tied = free.replace(elbow, &format!("{elbow}{mimic}"));
    for function in outputs.split(' ') {
        let asked = format!("outputs: {function}");
        let [free, tied] = [&free, &tied].map(|source| Case::read(source, &asked));
        assert_eq!(tied.robot().joints.len(), 5);
        let tied_code = match function.contains("regressor") {
            true => tied.generated(),
            false => tied.rounds_well(30, function),
        };
        let [free, tied] =
            [free.generated(), tied_code].map(|code| code.functions[0].counts().operations());
        assert!(3 * tied < 2 * free, "{function}: {tied} against {free}");
    }
}

#[test]
fn the_manipulator_equation_is_a_bundle() {
    let outputs = ["manipulator_equation", "equation=inertia+coriolis+gravity"];
    let [equation, made] = outputs.map(|asked| {
        let mut generated = Case::in_scene("planar3r", "", asked).generated();
        generated.functions.remove(0).program.dag
    });
    assert_eq!(equation, made);
    // Read, a bundle has no blanks; nor in the text of its scene, of which its hash is made.
    let lines = "outputs = [\"reach = gravity + jacobian\"]";
    let case = Case::in_scene("planar3r", lines, "servo = gravity + inertia");
    assert_eq!(case.request.functions[0].text(), "servo=gravity+inertia");
    let written = write(case.request.scene.as_ref().unwrap());
    says(&written, "\"reach=gravity+jacobian\"");
    // π is the module's, whoever needs it.
    let both = "outputs: adapt=regressor+momentum, regressor";
    let text = Case::new("planar2r", "", both).generated().text();
    assert_eq!(text.matches("pub const BASE_PARAMETERS").count(), 2);
}

#[test]
fn placements() {
    let asked = "outputs: inverse_dynamics, forward_kinematics, link_poses, jacobian, \
        jacobian_rate, reaction_wrenches, potential_energy";
    let arm = support::source("base_and_tool", "").replace("standard", "modified");
    Case::read(&arm, asked).rounds_well(50, &arm);
    let arm = support::source("planar2r", "");
    let code = |more: &str| {
        let source = arm.replacen("[[joint]]", &format!("{more}\n[[joint]]"), 1);
        let generated = Case::read(&source, "outputs: inverse_dynamics").generated();
        let texts = generated.emitted.into_iter().map(|emitted| emitted.text);
        texts.collect::<Vec<_>>()
    };
    let placed = code("base = { xyz = [0, 0, 2] }\ntool = { xyz = [0.1, 0, 0] }");
    assert_eq!(placed, code(""));
}

/// At 1e5 rad the f64 state is 4e-3 rad away from the f32 one.
#[test]
fn single_precision_at_its_own_state() {
    let case = Case::new("planar2r", "", "outputs: inverse_dynamics");
    let (runtime, mut states) = case.runtime(50, 11);
    for q in states.iter_mut().flat_map(|state| &mut state.q) {
        *q *= 1e5;
    }
    let generated = case.generated();
    assert_eq!(generated.scalars, [ScalarType::F64, ScalarType::F32]);
    support::rounds_well(&generated, &runtime, &states, "far");
}

/// A planar arm is singular in three of six components everywhere: there is no Λ undamped.
#[test]
fn singular_poses_give_no_numbers_without_damping() {
    let asked = "outputs: operational_inertia, operational_inertia@hand:x_y_rz; scalar: f64";
    let case = Case::new("frames/planar3r", "", asked);
    let (generated, mut state) = (case.generated(), case.runtime(1, 5).1.remove(0));
    let mut is_finite = |output: usize, q: [f64; 3], damping: f64| {
        (state.q, state.damping) = (q.to_vec(), vec![damping]);
        let results = generated.emitted[output].run(&state);
        results.iter().all(|x| x.is_finite())
    };
    let (bent, straight) = ([0.3, -0.8, 1.1], [0.3, 0.0, 0.0]);
    assert!(!is_finite(0, bent, 0.0) && is_finite(0, bent, 1e-9));
    assert!(is_finite(1, bent, 0.0) && is_finite(1, straight, 1e-9));
}

#[test]
fn a_wrong_literal_is_far_outside() {
    let case = Case::new("planar3r", "", "outputs: inverse_dynamics");
    let (runtime, states) = case.runtime(200, 11);
    for emitted in case.generated().emitted {
        for index in 0..emitted.text.dag.nodes.len() {
            let Node::Constant(value) = emitted.text.dag.nodes[index] else {
                continue;
            };
            let error = |wrong: f64| {
                let mut other = emitted.clone();
                other.text.dag.nodes[index] = Node::Constant(Literal(wrong));
                let compared = support::with_runtime(&other, &runtime, &states);
                support::errors(&other, &compared)[0]
            };
            assert!(error(1.5 * value.0) > 100.0 * BOUND);
            // NaN must not pass for a small error.
            assert_eq!(error(f64::NAN), f64::INFINITY);
        }
    }
}

#[test]
fn states_keep_to_the_limits() {
    let drawn = |name: &str, seed: u64| seeded(&support::robot(name), 200, seed);
    let states = drawn("stanford", 1);
    assert!(states == drawn("stanford", 1) && states != drawn("stanford", 2));
    let most = |states: &[JointState], argument| {
        let sizes = states.iter().map(|s| largest(s.entries(argument)));
        sizes.fold(0.0, f64::max)
    };
    let q = most(&states, Argument::Position);
    assert!((2.5..=std::f64::consts::PI).contains(&q));
    let states = drawn("planar2r", 1);
    assert!((2.5..=3.0).contains(&most(&states, Argument::Velocity)));
    assert!((9.0..=10.0).contains(&most(&states, Argument::Acceleration)));
}

#[test]
fn keys_of_states_are_told_apart() {
    let quantities = Quantity::ALL.iter().map(|quantity| quantity.facts().given);
    let arguments = Argument::ALL.iter().map(|argument| argument.given());
    let keys: Vec<&str> = quantities.chain(arguments).flatten().collect();
    assert_eq!(BTreeSet::from_iter(&keys).len(), keys.len());
}
