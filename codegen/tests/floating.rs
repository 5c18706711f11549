//! Robots whose base floats: every output, shown by the checker; and none in another order.

use dalembert_codegen::{Function, Request, generate};
use dalembert_model::equations::Formulation;
use dalembert_model::number::Rational;
use dalembert_model::read;
use dalembert_model::robot::Joint;

use crate::certified::Certified;
use crate::support::{Case, is_close, largest, read_robot, rows, says, source, variants};

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
        let is_of_hand = function.is_of_hand();
        let at = if is_of_hand { "@left_foot" } else { "" };
        format!("{}{at}", function.name())
    });
    names.collect::<Vec<_>>().join(", ")
}

#[test]
fn every_output_is_shown() {
    let robot = source("two_legs", "");
    let outputs = every_output();
    for language in ["rust", "c"] {
        let options = format!("scalar: f64; prefer: operations; language: {language}");
        Certified::shown(&robot, None, &format!("outputs: {outputs}; {options}"), 39);
    }
}

#[test]
fn what_is_of_a_fixed_base_is_refused_with_the_reason() {
    let robot = read_robot(&source("two_legs", ""));
    for (name, reason) in REFUSED {
        let request = Request::new(&[Function::from_name(name).unwrap()]);
        let error = generate(&robot, &request).unwrap_err().to_string();
        says(&error, "the base floats");
        says(&error, reason);
    }
}

/// Twelve joints of four legs are no longer a way to a tip than nine coordinates after each other.
#[test]
fn legs_are_proved_by_the_formula_as_written() {
    let case = Case::read(&source("go2", ""), "outputs: gravity; scalar: f64");
    let by = case.generated().functions[0].proof.reference_formulation;
    assert_eq!(by, Some(Formulation::LagrangeEuler));
}

/// The box has an entry a coordinate, the base's six first; lists of another length are refused.
#[test]
fn a_box_bounds_the_rates_of_the_base() {
    let within = |velocity: &str| {
        let scene = format!("\n[scene.test]\nbox = {{ velocity = [{velocity}] }}\n");
        source("two_legs", &scene)
    };
    let robot = within("1, 2, 3, 4, 5, 6, 7, 8, 9, 10");
    let asked = "scene: test; outputs: coriolis; scalar: f64";
    let file = Certified::shown(&robot, Some("test"), asked, 1);
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
    let lengths = "4 entries, but the robot has a base that floats and 4 joints";
    says(&error, lengths);
    file.with_robot(&robot).is_refused("has another length");
}

#[test]
fn places_are_those_of_the_robot_file() {
    let robot = source("two_legs", "");
    let in_rust = "
pub const BASE: usize = 0; → pub const BASE: usize = 4;
pub const LEFT_KNEE: usize = 7; → pub const LEFT_KNEE: usize = 9;
pub const Q_LEFT_KNEE: usize = 1; → pub const Q_LEFT_KNEE: usize = 7;
pub const NV: usize = 10; → pub const NV: usize = 4;
\"left_knee\",↵    \"right_hip\", → \"right_hip\",↵    \"left_knee\",
\"left_knee\", → \"left_kn{e\",
\"left_knee\", → \"left_knee\\\",
pub const LIMBS: [usize; 3] = [0, 2, 4]; → pub const LIMBS: [usize; 3] = [0, 1, 4];
";
    let in_c = "
TWO_LEGS_BASE = 0 → TWO_LEGS_BASE = 4
TWO_LEGS_RIGHT_HIP = 8 → TWO_LEGS_RIGHT_HIP = 6
TWO_LEGS_Q_RIGHT_HIP = 2 → TWO_LEGS_Q_RIGHT_HIP = 8
\"left_hip\", \"left_knee\" → \"left_knee\", \"left_hip\"
TWO_LEGS_JOINT_NAMES { → TWO_LEGS_RESTRICT {
TWO_LEGS_LIMBS {0, 2, 4} → TWO_LEGS_LIMBS {0, 1, 4}
";
    for (language, table) in [("rust", in_rust), ("c", in_c)] {
        let asked = format!("outputs: gravity; scalar: f64; language: {language}");
        Certified::shown(&robot, None, &asked, 1).refuses(table);
    }
}

#[test]
fn points_in_contact_are_told_apart() {
    let robot = source("two_legs", "");
    let asked = "outputs: contact_forward_dynamics@left_foot, right_foot, contact_bias@left_foot,right_foot; \
                 scalar: f64; language: c";
    let file = Certified::shown(&robot, None, asked, 2);
    let claim = (file.claim).replace("left_foot,right_foot", "right_foot,left_foot");
    file.with_claim(&claim).is_refused("has other results");
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
        says(&refusal, words);
    }
}

/// Lines of a scene, the outputs, and lines that make it another scene, whose claim is refused.
const SCENES: &str = r#"
lock = { trunk = "level" } | inverse_dynamics, gravity, inertia, inverse_dynamics_derivatives, coriolis_matrix, dynamic_coefficients, potential_energy, forward_dynamics, jacobian@left_foot, regressor, centroidal_momentum_matrix | lock = { trunk = "level" }; gravity = [0, 0, -9.8]
lock = { base = "level", right_slide = 0.05 }; gravity = [0, 3, -9] | inverse_dynamics, gravity, manipulator_equation, contact_jacobians@left_foot,right_foot | lock = { right_slide = 0.05 }; gravity = [0, 3, -9]
payload = { link = "trunk", mass = 2, com = [0.1, -0.2, 0.3], inertia = [0.1, 0.1, 0.1, 0, 0, 0] } | inverse_dynamics, gravity, inertia, forward_dynamics, inertia_blocks, joint_torques_free | payload = { link = "trunk", mass = 2, com = [0.1, -0.2, 0.31], inertia = [0.1, 0.1, 0.1, 0, 0, 0] }
"#;

fn two_legs_in(lines: &str) -> String {
    let robot = source("two_legs", "");
    let (robot, _) = robot.split_once("[scene.").unwrap();
    format!("{robot}[scene.test]\n{}\n", lines.replace("; ", "\n"))
}

#[test]
fn scenes_of_a_base_are_shown() {
    for [lines, outputs, other] in rows(SCENES) {
        let robot = two_legs_in(&lines);
        for language in ["rust", "c"] {
            let asked =
                format!("scene: test; outputs: {outputs}; scalar: f64; language: {language}");
            let count = outputs.split(", ").count();
            let file = Certified::shown(&robot, Some("test"), &asked, count);
            let is_held = lines.contains("level");
            let places = ["pub const BASE:", "TWO_LEGS_TEST_BASE = 0"];
            let has_base = places.iter().any(|place| file.text.contains(place));
            assert_eq!(has_base, !is_held, "{lines}");
            let has_joints = file.text.contains("JOINTS");
            assert_eq!(has_joints, is_held && language == "rust", "{lines}");
            file.with_robot(&two_legs_in(&other)).is_refused("");
        }
    }
}

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
        assert!(is_close(&found, &expected, 1e-14 * largest(&expected)));
    }
}

#[test]
fn a_frame_on_a_locked_base_is_refused() {
    let robot = two_legs_in("lock = { trunk = \"level\" }");
    for (output, words) in [
        ("jacobian@imu", "is on the base, which does not move"),
        ("inertia_blocks", "scene `test` locks the base"),
    ] {
        let asked = format!("scene: test; outputs: {output}; scalar: f64");
        says(&Case::read(&robot, &asked).refusal(), words);
    }
}

/// Lines of a scene with a tolerance, and its output; rates and tolerances begin with the base's.
const TOLERATED: &str = r#"
NEAR := position = [[-1, 1], [-1, 1], [-1, 1], [0, 0.1]]
box = { NEAR }; tolerance = { value = 1e-2, relative_to = "range" } | gravity
box = { NEAR, velocity = [0, 0, 0, 2, 2, 2, 5, 5, 5, 0] }; tolerance = { value = [1e-2, 1e-2, 1e-2, 2e-2, 2e-2, 2e-2, 1e-2, 1e-2, 1e-2, 1e-2], relative_to = "range" } | coriolis
box = { position = [[-0.1, 0.1], [-0.1, 0.1], [-0.1, 0.1], [0, 0.1]] }; lock = { left_knee = 0, right_hip = 0, right_slide = 0.05 }; tolerance = { value = 1e-3, relative_to = "range" } | inertia
"#;

/// The checker shows what a tolerance leaves, in any direction of gravity; errors at states are
/// below what it shows; and a stricter tolerance refuses it.
#[test]
fn tolerances_of_a_base_are_shown() {
    for [lines, output] in rows(TOLERATED) {
        let robot = two_legs_in(&format!("outputs = [\"{output}\"]\n{lines}"));
        let asked = format!("scene: test; outputs: {output}; scalar: f64; sincos: libm");
        let case = Case::read(&robot, &asked);
        let file = Certified::shown(&robot, Some("test"), &asked, 1);
        let generated = case.generated();
        let admitted = generated.functions[0].admitted.as_ref().unwrap();
        let variant = &admitted.variants[0];
        assert!(admitted.is_other(), "{output}: nothing was left out");
        let (exact, emitted) = (variant.exact.in_doubles(), variant.emitted.in_doubles());
        let (_, states) = case.runtime(200, 8);
        for mut state in states {
            // Gravity is drawn from the box, and gets its usual length.
            let length = state.g.iter().map(|x| x * x).sum::<f64>().sqrt();
            state.g.iter_mut().for_each(|x| *x *= 9.81 / length);
            let [found, expected] = [&emitted, &exact].map(|code| code.run_at(&state));
            for (index, (found, expected)) in found.iter().zip(&expected).enumerate() {
                let bound = variant.bounds[index].total() * variant.scales[index];
                assert!((found - expected).abs() <= bound, "{output} {index}");
            }
        }
        let strict = robot
            .replace("value = 1e-2", "value = 1e-4")
            .replace("1e-2, 1e-2", "1e-5, 1e-5")
            .replace("value = 1e-3", "value = 1e-6");
        file.with_robot(&strict).is_refused("");
    }
}

/// No state of a claim has a longer gravity than the robot file: T would be larger, and errors smaller.
#[test]
fn gravity_is_no_longer_than_the_files() {
    let [lines, output] = rows(TOLERATED).remove(0);
    let robot = two_legs_in(&format!("outputs = [\"{output}\"]\n{lines}"));
    let asked = format!("scene: test; outputs: {output}; scalar: f64; sincos: libm");
    let file = Certified::of(&robot, Some("test"), &asked).remove(0);
    for (factor, is_refused) in [(1.0, false), (1.0 / 1.0001, false), (1.0001, true)] {
        let mut claim = file.json();
        let reached = &mut claim["functions"][0]["tolerated"]["reached"][0];
        let state = reached.as_array_mut().unwrap();
        assert_eq!(state.len(), 4 + 3);
        for entry in &mut state[4..] {
            *entry = (entry.as_f64().unwrap() * factor).into();
        }
        let refusal = file.with_claim(&claim).refusal();
        assert_eq!(refusal.is_some(), is_refused, "{refusal:?}");
    }
}

#[test]
fn the_wrench_on_the_base_has_limits() {
    let lines = "outputs = [\"gravity\"]\n\
                 box = { position = [[-1, 1], [-1, 1], [-1, 1], [0, 0.1]] }\n\
                 tolerance = { value = 1e-2, relative_to = \"actuator\" }";
    let limits = "limits = { torque = 20 }\nviscous";
    let mut limited = two_legs_in(lines).replace("viscous = 0.3", &format!("{limits} = 0.3"));
    for joint in ["left_knee", "right_hip", "right_slide"] {
        let name = format!("name = \"{joint}\"");
        limited = limited.replace(&name, &format!("{name}\nlimits = {{ torque = 10 }}"));
    }
    let asked = "scene: test; outputs: gravity; scalar: f64; sincos: libm";
    let case = Case::read(&limited, asked);
    let generated = case.generated();
    let scales = &variants(&generated)[0].scales;
    let rounded: Vec<i32> = scales.iter().map(|scale| scale.round() as i32).collect();
    assert_eq!(rounded, [100, 100, 300, 40, 40, 40, 20, 10, 10, 10]);
    Certified::from(&case, &limited, Some("test"))[0].is_shown(1, "actuator");
    let without = limited.replace(", torque = [100, 100, 300, 40, 40, 40]", "");
    let error = read::parse(&without).unwrap_err().to_string();
    says(&error, "torque limit of the base");
}
