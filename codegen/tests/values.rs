//! Values of code in both scalars, by a table: each row is proved and read back as it is
//! generated, and held against the runtime of the robot in its scene, at 100 u of the largest
//! entry.

use dalembert_codegen::workspace::{Argument, BOUND, Literal, Node, Quantity, seeded};
use dalembert_codegen::{Function, Language, ScalarType};

use crate::support;
use crate::support::case::Case;

/// A robot file, more tables of it, what is asked, and the number of states.
type Row = (&'static str, &'static str, &'static str, usize);

#[track_caller]
fn check(rows: &[Row]) {
    for (file, more, asked, states) in rows {
        let case = Case::new(file, more, asked);
        let generated = case.rounds_well(*states, &format!("{file} {asked}"));
        let functions = generated.functions.len();
        assert_eq!(generated.emitted.len(), 2 * functions, "{file} {asked}");
    }
}

const FIRST: &str = "outputs: inverse_dynamics, inertia, coriolis, gravity, \
                     manipulator_equation, dynamic_coefficients";

/// The six robots, with products rounded and fused.
#[test]
fn six_robots() {
    let robots = [
        "planar2r", "stanford", "puma560", "planar3r", "ur10", "panda",
    ];
    for robot in support::dose(&robots, 3) {
        check(&[(robot, "", FIRST, 200)]);
    }
    for robot in support::dose(
        &[
            "stanford", "planar3r", "planar2r", "puma560", "ur10", "panda",
        ],
        2,
    ) {
        let asked = format!("{FIRST}; fma: on");
        let generated = Case::new(robot, "", &asked).rounds_well(200, robot);
        for own in &generated.emitted {
            let is_torque = own.function == Function::InverseDynamics;
            assert!(!is_torque || own.text.counts().fma > 0, "{robot}");
        }
    }
}

const RUBBED: &str = "outputs: inverse_dynamics, passivity, forward_dynamics, \
    inverse_dynamics_derivatives, forward_dynamics_derivatives, \
    inverse_dynamics_second_derivatives, forward_dynamics_second_derivatives";
const STILL: &str = "\n[scene.still]\nvelocity = \"zero\"\n";
const HELD: &str = "\n[scene.held]\nlock = { waist = 0.4 }\njoints = [\"slide\", \"wrist\"]\n";

/// Coulomb friction, and what it is not in; from every formulation the same, whose arithmetic is
/// not; in scenes that drop it; beside arguments.
#[test]
fn friction() {
    let and_others = format!(
        "{RUBBED}, coriolis, manipulator_equation, dynamic_coefficients, kinetic_energy, \
         inertia_inverse, reaction_wrenches"
    );
    let generated = Case::new("coulomb", "", &and_others).rounds_well(200, "friction");
    for function in &generated.functions {
        let rubbed = RUBBED
            .split([' ', ','])
            .any(|word| word == function.function.name());
        assert_eq!(function.counts().sqrt > 0, rubbed, "{}", function.function);
    }
    for (more, asked, states) in [
        ("", "formulation: lagrange_euler", 20),
        ("", "formulation: newton_euler", 20),
        (STILL, "scene: still", 40),
        (HELD, "scene: held", 40),
    ] {
        let asked = format!("{RUBBED}; {asked}");
        Case::new("coulomb", more, &asked).rounds_well(states, &asked);
    }
    check(&[(
        "coulomb",
        "",
        "outputs: inverse_dynamics; parameters: payload, gravity",
        40,
    )]);
}

const FRAMES: &str = "outputs: jacobian@camera:local, jacobian_rate@elbow:world, \
    operational_inertia@camera:x_y_rz, operational_bias@elbow:linear, \
    inverse_dynamics_with_wrench@camera:local, forward_dynamics_with_wrench@elbow, \
    contact_wrench@camera:linear, momentum_observer, \
    task=operational_inertia@camera:linear+consistent_inverse@camera:linear+null_space_projector@camera:linear";

/// Outputs at frames, with arguments and with a joint locked.
#[test]
fn frames() {
    for (more, asked) in [
        ("", ""),
        ("", "; parameters: payload, gravity"),
        ("\n[scene.held]\nlock = { 2 = 0.4 }\n", "; scene: held"),
    ] {
        Case::new("frames/planar3r", more, &format!("{FRAMES}{asked}")).rounds_well(60, asked);
    }
}

/// Joints that follow others: a leader locked, one asked for alone, arguments.
#[test]
fn followers() {
    let asked = "outputs: inverse_dynamics, manipulator_equation, forward_dynamics";
    for (more, rest) in [
        (
            "\n[scene.held]\nlock = { shoulder = 0.5 }\n",
            ", jacobian; scene: held",
        ),
        (
            "\n[scene.one]\njoints = [\"shoulder\"]\n",
            ", jacobian; scene: one",
        ),
        ("", "; parameters: payload, gravity"),
    ] {
        Case::new("wafer", more, &format!("{asked}{rest}; scalar: f64")).rounds_well(20, rest);
    }
}

const SECOND: &str =
    "outputs: inverse_dynamics_second_derivatives, forward_dynamics_second_derivatives";
const LOCKED: &str = "\n[scene.held]\nlock = { 2 = 0.4 }\n";
const REACH: &str = "\n[scene.held]\njoints = [3, 1]\nlock = { 2 = 0.5 }\nvelocity = \"zero\"\n";

/// Second derivatives, and what divides.
#[test]
fn derivatives_and_quotients() {
    for (more, rest) in [
        ("", ""),
        ("", "; parameters: payload, gravity"),
        (LOCKED, "; scene: held"),
    ] {
        Case::new("planar3r", more, &format!("{SECOND}{rest}")).rounds_well(60, rest);
    }
    check(&[(
        "planar3r",
        REACH,
        "outputs: forward_dynamics, inertia_inverse, forward_dynamics_derivatives, \
         forward_dynamics_second_derivatives; scene: held",
        100,
    )]);
}

/// Bundles, quantity by quantity: what divides among them, and what is over parameters; cut by a
/// scene.
#[test]
fn bundles() {
    check(&[
        (
            "planar2r",
            "",
            "outputs: servo=inverse_dynamics+jacobian+forward_kinematics, \
             task=forward_dynamics+kinetic_energy+jacobian_rate, \
             slopes=inverse_dynamics_derivatives+gravity, adapt=regressor+momentum; batch: on",
            100,
        ),
        (
            "planar3r",
            "\n[scene.reach]\nlock = { 2 = \"pi/2\" }\nvelocity = \"zero\"\n",
            "outputs: reach = gravity + jacobian, coriolis; scene: reach",
            50,
        ),
    ]);
    // π is the module's, whoever needs it.
    let both = "outputs: adapt=regressor+momentum, regressor";
    let text = Case::new("planar2r", "", both).generated().text();
    assert_eq!(text.matches("pub const BASE_PARAMETERS").count(), 2);
}

/// A base, a tool, axes that are nearly parallel, payloads in frames of their own.
#[test]
fn placements() {
    let asked = "outputs: inverse_dynamics, forward_kinematics, link_poses, jacobian, \
                 jacobian_rate, reaction_wrenches, potential_energy";
    let said = [
        "gravity (0.1, 0, -9.81) m/s² in base axes",
        "frame 0 is at xyz (0.2, -0.3, 1.1) m, rpy (0.4, pi/2, pi/6)",
        "the tool, in the last link's at xyz (0.01, 0, 0.12) m, rpy (pi, -0.2, 0)",
    ];
    let arm = support::arm_file("base_and_tool");
    for convention in ["standard", "modified"] {
        let case = Case::of(&arm.replace("standard", convention), asked);
        let text = case.rounds_well(50, convention).text();
        assert!(said.iter().all(|line| text.contains(line)), "{text}");
    }
    // A base that stands elsewhere and a tool cost the torques nothing.
    let arm = support::source("planar2r", "");
    let code = |more: &str| {
        let source = arm.replacen("[[joint]]", &format!("{more}\n[[joint]]"), 1);
        let text = Case::of(&source, "outputs: inverse_dynamics")
            .generated()
            .text();
        let lines = text
            .lines()
            .filter(|line| !line.trim_start().starts_with("//"));
        lines.map(str::to_owned).collect::<Vec<_>>()
    };
    let placed = code("base = { xyz = [0, 0, 2] }\ntool = { xyz = [0.1, 0, 0] }");
    assert_eq!(placed, code(""));
    let asked = "outputs: inverse_dynamics, coriolis, forward_kinematics, jacobian_rate";
    let case = Case::new("nearly_parallel", "", asked);
    assert!(!case.robot().joints[0].beta.is_zero() && case.robot().base.is_some());
    let text = case.rounds_well(50, asked).text();
    assert!(text.contains("After its twist each of these turns about y: joint 1 by 0.00"));
    // Of D with a payload the range of polynomial sines was once looked for in a box without one.
    check(&[(
        "planar2r",
        "",
        "outputs: inertia, gravity; parameters: payload, gravity; sincos: polynomial",
        20,
    )]);
}

/// At 1e5 rad the f64 state is 4e-3 rad away from the f32 one, at which single precision is
/// compared.
#[test]
fn single_precision_at_its_own_state() {
    let case = Case::new("planar2r", "", "outputs: inverse_dynamics");
    let (runtime, mut states) = case.runtime(50, 11);
    for q in states.iter_mut().flat_map(|state| &mut state.q) {
        *q *= 1e5;
    }
    let emitted = case.generated().emitted;
    assert!(emitted.iter().any(|own| own.scalar == ScalarType::F32));
    assert_eq!(emitted[0].function, Function::InverseDynamics);
    support::rounds_well(&emitted, &runtime, &states, "far");
}

/// Second derivatives are symmetric where they should be, linear in λ, and what the joints at rest
/// leave: nothing depends on the first joint's position but by gravity, which is along its axis.
#[test]
fn second_derivatives_keep_what_every_arm_keeps() {
    let asked = "outputs: inverse_dynamics_second_derivatives; scalar: f64";
    let case = Case::new("stanford", "", asked);
    let (emitted, n) = (
        case.generated().emitted.remove(0),
        case.robot().joints.len(),
    );
    let mut state = case.runtime(1, 3).1.remove(0);
    let found = emitted.run(&state);
    let entry = |matrix: usize, i: usize, k: usize| found[(matrix * n + i) * n + k];
    for (i, k) in (0..n).flat_map(|i| (0..n).map(move |k| (i, k))) {
        assert_eq!(
            [entry(0, i, k), entry(2, i, k)],
            [entry(0, k, i), entry(2, k, i)]
        );
        assert_eq!([entry(0, 0, k), entry(1, 0, k), entry(3, k, 0)], [0.0; 3]);
    }
    state.multiplier.iter_mut().for_each(|x| *x *= 2.0);
    let doubled = emitted.run(&state);
    assert!(found.iter().zip(&doubled).all(|(x, y)| 2.0 * x == *y));
}

/// A planar arm is singular in three of six components everywhere: without damping there is
/// no Λ, and infinities or no numbers say so; with as little as 1e-9 all is finite. Of the
/// three components that it moves in nothing is singular but where it is stretched out.
#[test]
fn singular_poses_give_no_numbers_without_damping() {
    let asked = "outputs: operational_inertia, operational_inertia@hand:x_y_rz; scalar: f64";
    let case = Case::new("frames/planar3r", "", asked);
    let (generated, mut state) = (case.generated(), case.runtime(1, 5).1.remove(0));
    let mut is_finite = |output: usize, q: [f64; 3], damping: f64| {
        (state.q, state.damping) = (q.to_vec(), vec![damping]);
        generated.emitted[output]
            .run(&state)
            .iter()
            .all(|x| x.is_finite())
    };
    let (bent, straight) = ([0.3, -0.8, 1.1], [0.3, 0.0, 0.0]);
    assert!(!is_finite(0, bent, 0.0) && is_finite(0, bent, 1e-9));
    assert!(is_finite(1, bent, 0.0) && is_finite(1, straight, 1e-9));
}

/// The measure sees a literal that is off, and what is no number.
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
                other.against_runtime(&runtime, &states)[0]
            };
            assert!(error(1.5 * value.0).in_units() > 100.0 * BOUND);
            // NaN must not pass for a small error.
            assert_eq!(error(f64::NAN).error, f64::INFINITY);
        }
    }
}

#[test]
fn states_keep_to_the_limits() {
    let drawn = |name: &str, seed: u64| seeded(&support::robot(name), 200, seed);
    let states = drawn("stanford", 1);
    assert!(states == drawn("stanford", 1) && states != drawn("stanford", 2));
    let largest =
        |values: &mut dyn Iterator<Item = f64>| values.fold(0.0f64, |m, x| m.max(x.abs()));
    let most = largest(&mut states.iter().flat_map(|s| s.q.clone()));
    assert!((2.5..=std::f64::consts::PI).contains(&most));
    let states = drawn("planar2r", 1);
    let most = largest(&mut states.iter().flat_map(|s| s.qd.clone()));
    assert!((2.5..=3.0).contains(&most));
    let most = largest(&mut states.iter().flat_map(|s| s.qdd.clone()));
    assert!((9.0..=10.0).contains(&most));
}

/// No two keys of given states are one.
#[test]
fn keys_of_states_are_told_apart() {
    let quantities = Quantity::ALL.iter().filter_map(|quantity| quantity.given());
    let arguments = Argument::ALL.iter().filter_map(|argument| argument.given());
    let mut keys: Vec<&str> = quantities.chain(arguments).collect();
    let count = keys.len();
    keys.sort_unstable();
    keys.dedup();
    assert_eq!(keys.len(), count);
}

/// Every language prints outputs at frames and reads them back, by names of their own; C and CUDA
/// as far as names are short enough for every compiler.
#[test]
fn every_language_has_frames() {
    let outputs = [
        "jacobian@camera:local",
        "contact_wrench@camera",
        "operational_inertia@camera",
        "forward_dynamics_with_wrench",
        "task=operational_inertia@elbow:linear+null_space_projector@elbow:linear",
    ];
    for (language, batch) in [
        (Language::Rust, "off"),
        (Language::Rust, "on"),
        (Language::C, "off"),
        (Language::Cuda, "off"),
    ] {
        let asked = format!(
            "outputs: {}; batch: {batch}; scalar: f64; name: d",
            outputs.join(", ")
        );
        let mut case = Case::new("frames/planar2r", "", &asked);
        case.request.language = language;
        let generated = case.generated();
        for function in &generated.functions {
            let call = format!("{}(", function.function);
            assert!(generated.text().contains(&call), "{language:?} {call}");
        }
    }
}
