//! Robots whose base floats: every output, shown by the checker; and none in another order.

use dalembert_codegen::{Function, Request, generate};
use dalembert_model::equations::Formulation;
use dalembert_model::number::Rational;
use dalembert_model::read;
use dalembert_model::robot::Joint;

use serde_json::Value;

use crate::certified::Certified;
use crate::support::{Case, changes, read_robot, source};

/// Outputs that are refused where the base floats, with a word of the reason.
const REFUSED: [(&str, &str); 4] = [
    ("dynamic_coefficients", "coriolis_matrix"),
    ("dalembert_terms", "coriolis_matrix"),
    ("inverse_dynamics_second_derivatives", "do not commute"),
    ("forward_dynamics_second_derivatives", "do not commute"),
];

fn every_output() -> String {
    let is_there = |function: &Function| REFUSED.iter().all(|refusal| refusal.0 != function.name());
    let names = Function::ALL.into_iter().filter(is_there).map(|function| {
        let at = if function.is_of_hand() {
            "@left_foot"
        } else {
            ""
        };
        format!("{}{at}", function.name())
    });
    names.collect::<Vec<_>>().join(", ")
}

#[test]
fn every_output_is_shown() {
    let robot = source("two_legs", "");
    let asked = format!(
        "outputs: {}; scalar: f64; prefer: operations",
        every_output()
    );
    for language in ["rust", "c"] {
        let asked = format!("{asked}; language: {language}");
        let file = Certified::of(&robot, None, &asked).remove(0);
        file.is_shown(39, language);
    }
}

#[test]
fn what_is_of_a_fixed_base_is_refused_with_the_reason() {
    let robot = read_robot(&source("two_legs", ""));
    for (name, reason) in REFUSED {
        let request = Request {
            functions: vec![Function::from_name(name).unwrap()],
            ..Request::default()
        };
        let error = generate(&robot, &request).unwrap_err().to_string();
        assert!(
            error.contains("the base floats") && error.contains(reason),
            "{error}"
        );
    }
}

/// It is the way to a tip that makes the formula as written long: twelve joints of four legs are no more
/// than nine coordinates one after the other.
#[test]
fn legs_are_proved_by_the_formula_as_written() {
    let case = Case::read(&source("go2", ""), "outputs: gravity; scalar: f64");
    let proof = &case.generated().functions[0].proof;
    let by = proof.reference_formulation;
    assert_eq!(by, Some(Formulation::LagrangeEuler));
}

/// The box has an entry a coordinate, the base's six first: the checker's bound follows it, and lists
/// of another length are refused, by the checker too.
#[test]
fn a_box_bounds_the_rates_of_the_base() {
    let within = |velocity: &str| {
        source(
            "two_legs",
            &format!("\n[scene.test]\nbox = {{ velocity = [{velocity}] }}\n"),
        )
    };
    let robot = within("1, 2, 3, 4, 5, 6, 7, 8, 9, 10");
    let asked = "scene: test; outputs: coriolis; scalar: f64";
    let file = Certified::of(&robot, Some("test"), asked).remove(0);
    file.is_shown(1, "coriolis");
    let reading = read::parse(&robot).unwrap();
    let scene = reading.scenes.iter().find(|scene| scene.name == "test");
    let held = scene.unwrap().apply(&reading.robot);
    let base = held.floating.unwrap().limits.velocity.unwrap();
    let of_joint = |joint: &Joint| joint.limits.velocity.clone().unwrap();
    let rates = base.into_iter().chain(held.joints.iter().map(of_joint));
    let expected = (1..=10).map(|rate| Rational::from_integer(rate.into()));
    assert!(rates.eq(expected));
    let robot = within("0.1, 0.1, 0.1, 0.1");
    let error = read::parse(&robot).unwrap_err().to_string();
    assert!(
        error.contains("4 entries, but the robot has a base that floats and 4 joints"),
        "{error}"
    );
    let why = Certified { robot, ..file }.refusal().unwrap();
    assert!(why.contains("has another length"), "{why}");
}

/// Constants say where the base and the joints are; a file that says otherwise is refused.
#[test]
fn places_are_those_of_the_robot_file() {
    let robot = source("two_legs", "");
    let cases = [
        (
            "rust",
            "
pub const BASE: usize = 0; → pub const BASE: usize = 4;
pub const LEFT_KNEE: usize = 7; → pub const LEFT_KNEE: usize = 9;
pub const Q_LEFT_KNEE: usize = 1; → pub const Q_LEFT_KNEE: usize = 7;
pub const NV: usize = 10; → pub const NV: usize = 4;
\"left_knee\",↵    \"right_hip\", → \"right_hip\",↵    \"left_knee\",
\"left_knee\", → \"left_kn{e\",
\"left_knee\", → \"left_knee\\\",
pub const LIMBS: [usize; 3] = [0, 2, 4]; → pub const LIMBS: [usize; 3] = [0, 1, 4];
",
        ),
        (
            "c",
            "
TWO_LEGS_BASE = 0 → TWO_LEGS_BASE = 4
TWO_LEGS_RIGHT_HIP = 8 → TWO_LEGS_RIGHT_HIP = 6
TWO_LEGS_Q_RIGHT_HIP = 2 → TWO_LEGS_Q_RIGHT_HIP = 8
\"left_hip\", \"left_knee\" → \"left_knee\", \"left_hip\"
TWO_LEGS_JOINT_NAMES { → TWO_LEGS_RESTRICT {
TWO_LEGS_LIMBS {0, 2, 4} → TWO_LEGS_LIMBS {0, 1, 4}
",
        ),
    ];
    for (language, table) in cases {
        let asked = format!("outputs: gravity; scalar: f64; language: {language}");
        let file = Certified::of(&robot, None, &asked).remove(0);
        file.is_shown(1, language);
        for [from, to] in changes(table) {
            assert!(file.text.contains(&from), "{from}: {}", file.text);
            let other = file.with(&file.text.replacen(&from, &to, 1));
            assert!(other.refusal().is_some(), "{to}");
        }
    }
}

/// Points in contact have the order in which they are named.
#[test]
fn points_in_contact_are_told_apart() {
    let robot = source("two_legs", "");
    let asked = "outputs: contact_forward_dynamics@left_foot, right_foot, contact_bias@left_foot,right_foot; \
                 scalar: f64; language: c";
    let file = Certified::of(&robot, None, asked).remove(0);
    file.is_shown(2, "c");
    let mut other = file.clone();
    other.claim = (file.claim).replace("left_foot,right_foot", "right_foot,left_foot");
    let why = other.refusal().unwrap();
    assert!(why.contains("has other results"), "{why}");
    let robot = read_robot(&robot);
    for (text, words) in [
        ("contact_bias@left_foot,left_foot", "there twice"),
        ("contact_bias@left_foot:local", "no choice of `:local`"),
        ("jacobian@left_foot,right_foot", "is of one frame"),
        ("contact_bias@left_foot,left_fot", "no frame `left_fot`"),
    ] {
        let refusal = match Function::parse(text) {
            Err(error) => error.message,
            Ok(function) => {
                let request = Request::new(&[function]);
                generate(&robot, &request).unwrap_err().to_string()
            }
        };
        assert!(refusal.contains(words), "{refusal}");
    }
}

/// Lines of a scene, the outputs, and lines that make it another scene, whose claim is refused.
const SCENES: [(&str, &str, &str); 3] = [
    (
        "lock = { trunk = \"level\" }",
        "inverse_dynamics, gravity, inertia, inverse_dynamics_derivatives, coriolis_matrix, \
         dynamic_coefficients, potential_energy, forward_dynamics, jacobian@left_foot, regressor, \
         centroidal_momentum_matrix",
        "lock = { trunk = \"level\" }\ngravity = [0, 0, -9.8]",
    ),
    (
        "lock = { base = \"level\", right_slide = 0.05 }\ngravity = [0, 3, -9]",
        "inverse_dynamics, gravity, manipulator_equation, contact_jacobians@left_foot,right_foot",
        "lock = { right_slide = 0.05 }\ngravity = [0, 3, -9]",
    ),
    (
        "payload = { link = \"trunk\", mass = 2, com = [0.1, -0.2, 0.3], inertia = [0.1, 0.1, 0.1, 0, 0, 0] }",
        "inverse_dynamics, gravity, inertia, forward_dynamics, inertia_blocks, joint_torques_free",
        "payload = { link = \"trunk\", mass = 2, com = [0.1, -0.2, 0.31], inertia = [0.1, 0.1, 0.1, 0, 0, 0] }",
    ),
];

fn two_legs_in(lines: &str) -> String {
    let robot = source("two_legs", "");
    let (robot, _) = robot.split_once("[scene.").unwrap();
    format!("{robot}[scene.test]\n{lines}\n")
}

/// A scene locks the base, or puts a payload on it: every function is shown, and of no other scene.
#[test]
fn scenes_of_a_base_are_shown() {
    for (lines, outputs, other) in SCENES {
        let robot = two_legs_in(lines);
        for language in ["rust", "c"] {
            let asked =
                format!("scene: test; outputs: {outputs}; scalar: f64; language: {language}");
            let file = Certified::of(&robot, Some("test"), &asked).remove(0);
            file.is_shown(outputs.split(", ").count(), lines);
            let is_held = lines.contains("level");
            let places = ["pub const BASE:", "TWO_LEGS_TEST_BASE = 0"];
            let has_base = places.iter().any(|place| file.text.contains(place));
            assert_eq!(has_base, !is_held, "{lines}");
            assert_eq!(
                file.text.contains("JOINTS"),
                is_held && language == "rust",
                "{lines}"
            );
            let another = Certified {
                robot: two_legs_in(other),
                ..file
            };
            assert!(another.refusal().is_some(), "{other}");
        }
    }
}

/// Torques of a base that is locked are those of one that floats and is at rest.
#[test]
fn a_locked_base_is_at_rest() {
    let [held, free] = ["lock = { trunk = \"level\" }", ""].map(|lines| {
        let asked = "scene: test; outputs: inverse_dynamics; scalar: f64";
        Case::read(&two_legs_in(lines), asked)
    });
    let (_, states) = held.runtime(20, 5);
    let [held, free] = [held, free].map(|case| case.generated().emitted.remove(0));
    for mut state in states {
        let found = held.run(&state);
        for rates in [&mut state.qd, &mut state.qdd] {
            rates.splice(0..0, [0.0; 6]);
        }
        state.g = vec![0.0, 0.0, -9.81];
        let expected = free.run(&state).split_off(6);
        let size = expected.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        for (found, expected) in found.iter().zip(&expected) {
            assert!((found - expected).abs() <= 1e-14 * size);
        }
    }
}

#[test]
fn a_frame_on_a_locked_base_is_refused() {
    let robot = two_legs_in("lock = { trunk = \"level\" }");
    for (output, words) in [
        ("jacobian@imu", "is on the base, which does not move"),
        ("inertia_blocks", "scene `test` locks the base"),
    ] {
        let case = Case::read(
            &robot,
            &format!("scene: test; outputs: {output}; scalar: f64"),
        );
        let error = case.refusal();
        assert!(error.contains(words), "{error}");
    }
}

/// Lines of a scene with a tolerance, and its output: of a base that floats rates, limits of the wrench
/// and tolerances begin with six entries.
const TOLERATED: [(&str, &str); 3] = [
    (
        "box = { position = [[-1, 1], [-1, 1], [-1, 1], [0, 0.1]] }\n\
         tolerance = { value = 1e-2, relative_to = \"range\" }",
        "gravity",
    ),
    (
        "box = { position = [[-1, 1], [-1, 1], [-1, 1], [0, 0.1]], velocity = [0, 0, 0, 2, 2, 2, 5, 5, 5, 0] }\n\
         tolerance = { value = [1e-2, 1e-2, 1e-2, 2e-2, 2e-2, 2e-2, 1e-2, 1e-2, 1e-2, 1e-2], relative_to = \"range\" }",
        "coriolis",
    ),
    (
        "box = { position = [[-0.1, 0.1], [-0.1, 0.1], [-0.1, 0.1], [0, 0.1]] }\n\
         lock = { left_knee = 0, right_hip = 0, right_slide = 0.05 }\n\
         tolerance = { value = 1e-3, relative_to = \"range\" }",
        "inertia",
    ),
];

/// The checker shows what a tolerance leaves of functions of a base that floats, whatever the direction
/// of gravity; errors at states are below what it shows; and a stricter tolerance refuses it.
#[test]
fn tolerances_of_a_base_are_shown() {
    for (lines, output) in TOLERATED {
        let robot = two_legs_in(&format!("outputs = [\"{output}\"]\n{lines}"));
        let asked = format!("scene: test; outputs: {output}; scalar: f64; sincos: libm");
        let case = Case::read(&robot, &asked);
        let file = Certified::from(&case, &robot, Some("test")).remove(0);
        file.is_shown(1, output);
        let generated = case.generated();
        let admitted = generated.functions[0].admitted.as_ref().unwrap();
        let variant = &admitted.variants[0];
        assert!(admitted.is_other(), "{output}: nothing was left out");
        let (exact, emitted) = (variant.exact.in_doubles(), variant.emitted.in_doubles());
        let (_, states) = case.runtime(200, 8);
        for mut state in states {
            // Of the box, and as long as gravity is.
            let length = state.g.iter().map(|x| x * x).sum::<f64>().sqrt();
            state.g.iter_mut().for_each(|x| *x *= 9.81 / length);
            let [found, expected] = [&emitted, &exact].map(|code| code.run_at(&state));
            for (index, (found, expected)) in found.iter().zip(&expected).enumerate() {
                let bound = variant.bounds[index].total() * variant.scales[index];
                assert!((found - expected).abs() <= bound, "{output} {index}");
            }
        }
        let strict = Certified {
            robot: file
                .robot
                .replace("value = 1e-2", "value = 1e-4")
                .replace("1e-2, 1e-2", "1e-5, 1e-5")
                .replace("value = 1e-3", "value = 1e-6"),
            ..file
        };
        assert!(strict.refusal().is_some(), "{output}");
    }
}

/// No state of a claim has a longer gravity than the robot file: T would be larger, and errors smaller.
#[test]
fn gravity_is_no_longer_than_the_files() {
    let (lines, output) = TOLERATED[0];
    let robot = two_legs_in(&format!("outputs = [\"{output}\"]\n{lines}"));
    let asked = format!("scene: test; outputs: {output}; scalar: f64; sincos: libm");
    let file = Certified::of(&robot, Some("test"), &asked).remove(0);
    let mut claim: Value = serde_json::from_str(&file.claim).unwrap();
    for (factor, is_refused) in [(1.0, false), (1.0 / 1.0001, false), (1.0001, true)] {
        let state = state_of(&mut claim);
        assert_eq!(state.len(), 4 + 3);
        for entry in &mut state[4..] {
            *entry = (entry.as_f64().unwrap() * factor).into();
        }
        let other = Certified {
            claim: claim.to_string(),
            ..file.clone()
        };
        let refusal = other.refusal();
        assert_eq!(refusal.is_some(), is_refused, "{refusal:?}");
        for entry in &mut state_of(&mut claim)[4..] {
            *entry = (entry.as_f64().unwrap() / factor).into();
        }
    }
}

fn state_of(claim: &mut Value) -> &mut Vec<Value> {
    claim["functions"][0]["tolerated"]["reached"][0]
        .as_array_mut()
        .unwrap()
}

/// Errors are relative to the limits of the wrench on the base, and of the actuators.
#[test]
fn the_wrench_on_the_base_has_limits() {
    let lines = "outputs = [\"gravity\"]\n\
                 box = { position = [[-1, 1], [-1, 1], [-1, 1], [0, 0.1]] }\n\
                 tolerance = { value = 1e-2, relative_to = \"actuator\" }";
    let limits = "limits = { torque = 20 }\nviscous";
    let limited = two_legs_in(lines).replace("viscous = 0.3", &format!("{limits} = 0.3"));
    let names = ["left_knee", "right_hip", "right_slide"];
    let limited = names.iter().fold(limited, |text, name| {
        text.replace(
            &format!("name = \"{name}\""),
            &format!("name = \"{name}\"\nlimits = {{ torque = 10 }}"),
        )
    });
    let asked = "scene: test; outputs: gravity; scalar: f64; sincos: libm";
    let case = Case::read(&limited, asked);
    let generated = case.generated();
    let variant = &generated.functions[0].admitted.as_ref().unwrap().variants[0];
    let scales: Vec<f64> = variant.scales.iter().map(|scale| scale.round()).collect();
    assert_eq!(
        scales,
        [
            100.0, 100.0, 300.0, 40.0, 40.0, 40.0, 20.0, 10.0, 10.0, 10.0
        ]
    );
    Certified::from(&case, &limited, Some("test"))
        .remove(0)
        .is_shown(1, "actuator");
    let without = limited.replace(", torque = [100, 100, 300, 40, 40, 40]", "");
    let error = read::parse(&without).unwrap_err().to_string();
    assert!(error.contains("torque limit of the base"), "{error}");
}
