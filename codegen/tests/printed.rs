//! Printed files: what their text says in every language, that it has no branch and no loop, and
//! that formatter, compiler and documentation of somebody's crate have nothing to warn of.

use std::collections::BTreeSet;
use std::fs;

use dalembert_codegen::workspace::{input_hash, keep};
use dalembert_codegen::{Function, Plan};

use crate::support::compiled::{folder, run};
use crate::support::{self, Case, every_output, rows, says};

/// A robot file, the lines of a scene, what is asked, and words of the text in their order; without
/// comment marks and with one space where there are more. Behind `¬` stands what must not follow.
const ROWS: &str = r#"
FRAMES := jacobian@camera:local, contact_wrench@camera, operational_inertia@camera, forward_dynamics_with_wrench, task=operational_inertia@elbow:linear+null_space_projector@elbow:linear
planar2r | | inverse_dynamics, gravity; parameters: payload, gravity | pub struct Payload([f64; 10]); … ) -> Option<Payload> { … pub struct Load([f64; 6]); … pub fn load(payload: &Payload) -> Load { … pub fn gravity(q: &[f64; 2], g: &Gravity, load: &Load) -> [f64; 2] {
planar2r | | inverse_dynamics, gravity; parameters: payload, gravity | pub fn inverse_dynamics(q: &[f64; 2], qd: &[f64; 2], qdd: &[f64; 2], g: &Gravity, load: &Load) -> [f64; 2] { … pub fn gravity(q: &[f32; 2], g: &Gravity, load: &Load) -> [f32; 2] {
planar2r | | inertia, jacobian; parameters: gravity | ¬g: &
planar2r | | servo_load=jacobian+manipulator_equation; batch: on | pub struct ServoLoad { … pub jacobian: … pub d: … pub h: … pub c: … `jacobian` and `manipulator_equation` in one … pub fn servo_load(q: &[f64; 2], qd: &[f64; 2]) -> ServoLoad { … for ServoLoadBatch { … pub fn servo_load_columns(
planar3r | outputs = ["reach = gravity + jacobian", "coriolis"]; lock = { 2 = "pi/2" }; velocity = "zero" | | pub c: [f64; 2], … pub jacobian: [[f64; 2]; 6], … pub fn reach(q: &[f64; 3]) -> Reach {
puma560 | lock = { 4 = 0, 5 = 0, 6 = 0 }; velocity = "zero" | inverse_dynamics, inertia | - q4 = 0 rad, q̇4 = q̈4 = 0; … pub const N: usize = 6; … pub const JOINTS: [usize; 3] = [0, 1, 2]; … pub fn inverse_dynamics(q: &[f64; 6], qdd: &[f64; 6]) -> [f64; 3] { … pub fn inertia(q: &[f64; 6]) -> [[f64; 3]; 3] {
coulomb | | inverse_dynamics; sincos: libm; scalar: f64 | let r1 = 1.0 / libm::sqrt(qd[0] * qd[0] + 0.0001); … ¬let r1 = 1.0 / libm::
coulomb | | inverse_dynamics; sincos: libm; scalar: f32; batch: on | let r2 = 1.0 / libm::sqrtf(qd[1] * qd[1] + 1.1111111e-5); … ¬let r2 = 1.0 / libm::
coulomb | | inverse_dynamics; sincos: together; scalar: f64; batch: on | let r1 = 1.0 / dalembert_sines::sqrt(qd[0] * qd[0] + 0.0001); … ¬let r1 = 1.0 / dalembert_sines::
coulomb | | inverse_dynamics; sincos: together; scalar: f32 | let r2 = 1.0 / dalembert_sines::sqrtf(qd[1] * qd[1] + 1.1111111e-5); … ¬let r2 = 1.0 /
coulomb | lock = { waist = 0.4 }; joints = ["slide", "wrist"] | inverse_dynamics, inverse_dynamics_derivatives | ¬let r1 = … let r2 =
coulomb | velocity = "zero" | inverse_dynamics, inverse_dynamics_derivatives | ¬sqrt
coulomb | | full_regressor | Armature and friction, viscous and Coulomb, have none.
payload_frame | | inverse_dynamics; parameters: payload | in that of joint 3 in the table at xyz (0.1, -0.05, -0.2) m, rpy (pi/2, 0, 0)
payload_frame | | gravity; parameters: payload; sincos: together; language: c | A body fixed to the last link … `numbers` has [0] its `mass`, [1] to [3] its `com` and [4] to [9] its `inertia` … the centre of mass in m, in the last link's frame … table at xyz (0.1, -0.05, -0.2) m, rpy (pi/2, 0, 0) … Ixx, Iyy, Izz, Ixy, Iyz, Ixz … static inline int arm_payload(const double numbers[ … } arm_load_t; … _load(const arm_payload_t payload[ … _gravity(const double q[ARM_RESTRICT 3], const arm_load_t load[
planar2r | | gravity; parameters: payload; sincos: together; language: c | in the last link's frame … that of joint 2 in the table (a tool's pose moves … _load(const planar2r_payload_t payload[
base_and_tool | | link_poses, potential_energy | gravity (0.1, 0, -9.81) m/s² in base axes … frame 0 is at xyz (0.2, -0.3, 1.1) m, rpy (0.4, pi/2, pi/6) … the tool, in the last link's at xyz (0.01, 0, 0.12) m, rpy (pi, -0.2, 0)
nearly_parallel | | inverse_dynamics | After its twist each of these turns about y: joint 1 by 0.00
wafer | | inverse_dynamics | pub const N: usize = 4;
wafer | | inverse_dynamics; language: c | -2 q3 … q[4]
wafer | | inverse_dynamics; language: cuda | -2 q3 … q[4]
frames/planar2r | | FRAMES; scalar: f64; name: d | pub fn
frames/planar2r | | FRAMES; batch: on; scalar: f64; name: d | _columns(
frames/planar2r | | FRAMES; scalar: f64; name: d; language: c | d_jacobian_camera_local(
frames/planar2r | | FRAMES; scalar: f64; name: d; language: cuda | d_jacobian_camera_local(
"#;

fn flat(text: &str) -> String {
    let marks = ["///", "//!", "/*", "*"];
    let lines = text.lines().map(|line| {
        let line = line.trim_start();
        let mark = marks.iter().find_map(|mark| line.strip_prefix(mark));
        mark.unwrap_or(line)
    });
    let words: Vec<&str> = lines.flat_map(str::split_whitespace).collect();
    words.join(" ")
}

#[test]
fn texts_say_what_was_asked() {
    let mut plan: Option<Plan> = None;
    for [file, scene, asked, words] in rows(ROWS) {
        let mut case = Case::in_scene(&file, &scene, &asked);
        // Programs of the row before are not searched for again.
        let input = input_hash(case.robot());
        case.request.plan = plan.filter(|plan| plan.input == input && scene.is_empty());
        let generated = case.generated();
        let previous_plan = case.request.plan.clone();
        plan = Some(keep(case.robot(), &case.request, &generated, previous_plan).plan);
        let text = flat(&generated.text());
        for function in &generated.functions {
            says(&text, &format!("{}(", function.function));
        }
        let mut rest = text.as_str();
        for word in words.split(" … ") {
            if let Some(word) = word.strip_prefix('¬') {
                assert!(!rest.contains(word), "{asked}: {word}");
                continue;
            }
            let Some((_, behind)) = rest.split_once(word) else {
                panic!("{asked}: {word} is not behind\n{rest}")
            };
            rest = behind;
        }
    }
}

support::daily_and_campaign! {
    a_robot_is_generated_alike_every_time: ("puma560"), ("panda");
}

fn a_robot_is_generated_alike_every_time(name: &str) {
    let text = || Case::new(name, "", "").searched().text();
    assert!(text() == text());
}

#[test]
fn long_functions_are_in_blocks() {
    let case = Case::in_scene("panda", "", "dynamic_coefficients; fma: on");
    let text = case.generated().text();
    let blocks = text.split("= {\n");
    let lengths = blocks.map(|part| part.lines().take_while(|l| l.contains("let t")).count());
    assert!(lengths.max().unwrap() <= 1001);
    assert!(text.contains("let (t") && text.contains(",) = {\n") && text.contains(".mul_add("));
}

const BRANCHES: [&str; 10] = [
    "if", "else", "match", "switch", "while", "for", "loop", "do", "goto", "break",
];

fn functions(text: &str) -> Vec<(&str, Vec<&str>)> {
    let lines: Vec<&str> = text.lines().collect();
    let is_head = |line: &str| line.starts_with("pub fn ") || line.starts_with("static ");
    let heads = lines.iter().enumerate().filter(|(_, line)| is_head(line));
    let functions = heads.map(|(index, head)| {
        let body = lines[index + 1..].iter().copied();
        (*head, body.take_while(|line| *line != "}").collect())
    });
    functions.collect()
}

/// True if a word stands before a bracket; a product of CUDA is a macro.
fn calls(line: &str) -> bool {
    let plain = line.replace("DALEMBERT_MUL(", "(");
    let is_letter = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let mut before = plain.match_indices('(').map(|(place, _)| &plain[..place]);
    before.any(|text| text.ends_with(is_letter))
}

/// Code that gives sines by the crate's algorithm in C is a loop, and says so by its name.
#[test]
fn functions_are_straight_lines() {
    for options in [
        "sincos: libm",
        "sincos: polynomial",
        "sincos: together; language: c",
        "sincos: polynomial; language: c",
        "sincos: polynomial; language: cuda",
    ] {
        let asked = format!("{}; scalar: f64; {options}", every_output());
        let text = Case::planar2r(&asked).generated().text();
        let (functions, calls_nothing) = (functions(&text), options.contains("polynomial"));
        let has_sines = functions.iter().any(|(head, _)| head.contains("_sines_"));
        assert_eq!(has_sines, options.contains("together"));
        let is_output = |head: &str| !head.contains("_sines_") && !head.contains("in_box");
        let outputs = functions.iter().filter(|(head, _)| is_output(head));
        let count = outputs.clone().count();
        assert!(count >= every_output().split(',').count(), "{count}");
        for (head, body) in outputs {
            for line in body {
                let mut words = line.split(|c: char| !c.is_ascii_alphanumeric() && c != '_');
                let branches = words.any(|word| BRANCHES.contains(&word));
                assert!(!branches && !line.contains(['?', '|']), "{head}: {line}");
                assert!(!calls(line) || !calls_nothing, "{head}: {line}");
            }
        }
    }
    assert!(calls("let t1 = f(x) + (y);") && !calls("let t1 = x + (y);"));
}

#[test]
fn nobody_has_anything_to_say() {
    let asked = "inverse_dynamics, dynamic_coefficients; sincos: polynomial; sincos_error: 1e-4";
    let mut case = Case::in_scene("planar3r", "", asked);
    let robot = &mut case.reading.robot;
    let names = ["`a` | <b>", "[N](http://x.y) \\ *_&lt;", "~~wrist~~ #1"];
    for (joint, name) in robot.joints.iter_mut().zip(names) {
        joint.name = Some(name.to_owned());
    }
    robot.joints[2].limits.position = None;
    assert!(robot.validate().is_empty());
    let folder = folder("printed_file");
    for (name, text) in ["arm.rs", "arm_f32.rs"].iter().zip(case.generated().texts) {
        assert!(text.contains("\npub const N: usize = 3;\n") && !text.contains("pub mod"));
        fs::write(folder.join(name), text).unwrap();
    }
    let main = "//! A program.\n\n/// Its module.\npub mod arm;\nmod arm_f32;\n\nfn main() {\n    \
                assert!(arm::in_box(&[0.5, -0.5, 700.0]));\n    \
                assert!(!arm::in_box(&[0.5, 3.5, 0.0]));\n    \
                assert!(!arm::in_box(&[f64::NAN, 0.0, 0.0]));\n    \
                let high = arm_f32::BOX.q[0][1];\n    \
                assert!(arm_f32::in_box(&[high, 0.0, 0.0]));\n    \
                assert!(!arm_f32::in_box(&[high.next_up(), 0.0, 0.0]));\n}\n";
    fs::write(folder.join("main.rs"), main).unwrap();
    for (program, flags) in [
        ("rustfmt", "--check"),
        ("rustc", "-Dwarnings -Dmissing_docs -Dunreachable_pub"),
        ("rustdoc", "-Dwarnings --document-private-items"),
        ("./main", ""),
    ] {
        let ends = ["--edition", "2024", "main.rs"];
        let said = run(program, flags.split_whitespace().chain(ends), &folder);
        assert!(said.is_empty(), "{program}:\n{said}");
    }
}

#[test]
fn names_are_short_and_distinct() {
    for options in ["sincos: together", "sincos: libm; name: stanford"] {
        let asked = format!("{}; batch: on; {options}; language: c", every_output());
        let text = Case::planar2r(&asked).generated().text();
        let declared = text.lines().filter_map(|line| {
            let head = line.strip_prefix("static inline ")?;
            head.split_once('(').unwrap().0.rsplit(' ').next()
        });
        let names: Vec<&str> = declared.collect();
        let count = every_output().split(',').count();
        assert!(names.len() >= 4 * count, "{names:?}");
        assert!(names.iter().all(|name| name.len() <= 31), "{names:?}");
        assert_eq!(BTreeSet::from_iter(&names).len(), names.len());
    }
}

#[test]
fn long_names_are_cut() {
    let mut heads = BTreeSet::new();
    let names = Function::by_default().into_iter().map(Function::name);
    let (few, many) = (names.collect::<Vec<_>>().join(", "), every_output());
    for (name, asked) in [
        ("a_robot_of_nineteen", &few),
        ("gen3_7dof_novision_for_urdf_arm_v12", &few),
        ("gen3_7dof_novision_for_urdf_arm_v13", &few),
        ("gen3_7dof_novision_for_urdf_arm_v12", &many),
    ] {
        for options in ["batch: off; language: c", "batch: on; language: cuda"] {
            let asked = format!("{asked}; sincos: together; {options}");
            let mut case = Case::planar2r(&asked);
            case.reading.robot.name = name.to_owned();
            let input = input_hash(case.robot());
            case.request.plan = case.request.plan.map(|plan| Plan { input, ..plan });
            let generated = case.generated();
            let said = generated.warnings.join("\n");
            let short = said.split('`').nth(1).unwrap();
            says(&said, &format!("with `{name}`"));
            assert!(short.starts_with(&name[..3]));
            for words in [format!(" {short}_gravity("), format!("robot `{name}`")] {
                says(&generated.text(), &words);
            }
            heads.insert(short.to_owned());
            case.request.module = Some(short.to_owned());
            let chosen = case.generated();
            assert_eq!(chosen.texts, generated.texts);
            assert_eq!(chosen.warnings, [""; 0]);
        }
    }
    assert!(heads.len() >= 4, "{heads:?}");
}
