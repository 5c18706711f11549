//! Bodies and drives that are arguments: what is generated gives what the robot file with other bodies
//! gives, and the checker shows it.

use dalembert_checker::certify::{Demand, FunctionReport, Report, certify};
use dalembert_codegen::workspace::{JointState, RunnableCode, Runtime, claim, keep};
use dalembert_codegen::{Function, GeneratedCode, Request};
use dalembert_model::outputs::RuntimeParameter;
use dalembert_model::robot::write;

use crate::support::{self, Case, daily_and_campaign, hold, read, read_robot};

fn run(generated: &GeneratedCode, emitted: &RunnableCode, state: &JointState) -> Vec<f64> {
    let mut state = state.clone();
    let mut codes = generated.emitted.iter();
    let load = codes.find(|code| code.function == Function::Load && code.scalar == emitted.scalar);
    if let Some(load) = load {
        state.load = load.run(&state);
    }
    emitted.run(&state)
}

/// Returns a robot file in which links have a state's bodies, a base that floats as link 0, and rows a
/// state's drives.
fn with_bodies(source: &str, state: &JointState, links: &[usize]) -> String {
    let mut text = String::new();
    // The table of a base that floats comes first.
    let mut link = if source.contains("\"floating\"") {
        -1
    } else {
        0
    };
    let body = |link: i64| {
        let place = links.iter().position(|number| *number as i64 == link)?;
        state.bodies.chunks(10).nth(place)
    };
    let drives = |link: i64| {
        let row = usize::try_from(link - 1).ok()?;
        let mut lines = String::new();
        for (key, values) in [("armature", &state.armature), ("viscous", &state.viscous)] {
            if let Some(value) = values.get(row) {
                lines += &format!("{key} = {value:?}\n");
            }
        }
        Some(lines)
    };
    let mut is_of_link = false;
    for line in source.lines() {
        let key = line.split('=').next().unwrap_or("").trim();
        let is_replaced = is_of_link
            && match key {
                "mass" | "com" | "inertia" => body(link).is_some(),
                "armature" => !state.armature.is_empty(),
                "viscous" => !state.viscous.is_empty(),
                _ => false,
            };
        if !is_replaced {
            text += &format!("{line}\n");
        }
        if line.starts_with('[') {
            is_of_link = line.starts_with("[[joint]]");
            link += i64::from(is_of_link);
            if let (true, Some([mass, x, y, z, inertia @ ..])) = (is_of_link, body(link)) {
                text += &format!(
                    "mass = {mass:?}\ncom = [{x:?}, {y:?}, {z:?}]\ninertia = {inertia:?}\n"
                );
            }
            text += &drives(link).filter(|_| is_of_link).unwrap_or_default();
        }
    }
    text
}

/// Compares with the runtime of robot files that have these bodies, and has the checker show all.
#[track_caller]
fn check(source: &str, asked: &str, count: usize) -> GeneratedCode {
    let case = Case::read(source, asked);
    let name = &case.robot().name;
    let generated = case.rounds_well(count, name);
    let setup = case.request.prepare(case.robot()).unwrap();
    let (_, states) = case.runtime(count, 0x626f_6479);
    let plain = Request {
        scene: case.request.scene.clone(),
        parameters: case.request.parameters.clone(),
        ..Request::default()
    };
    let is_plain = |parameter: &RuntimeParameter| {
        parameter.given().is_none() || *parameter == RuntimeParameter::Payload
    };
    let plain = Request {
        parameters: plain.parameters.iter().copied().filter(is_plain).collect(),
        ..plain
    };
    let codes = generated.emitted.iter();
    for emitted in codes.filter(|code| code.function != Function::Load) {
        let function = emitted.function;
        let compared = states.iter().map(|state| {
            let mut state = state.in_scalar(emitted.scalar);
            let zeros = setup.zeros().iter().zip(&mut state.bodies);
            zeros
                .filter(|(is_zero, _)| **is_zero)
                .for_each(|(_, x)| *x = 0.0);
            let merged = read_robot(&with_bodies(source, &state, &setup.body_links()));
            let runtime = Runtime::in_scene(plain.prepare(&merged).unwrap());
            let granted = runtime.granted(function, &state);
            let expected = runtime.run(function, &state);
            (run(&generated, emitted, &state), expected, granted)
        });
        hold(emitted, &compared.collect::<Vec<_>>(), name);
    }
    let claim = claim(case.robot(), source, &case.request, &generated)
        .unwrap()
        .write();
    let demand = Demand {
        scene: case.request.scene.as_ref().map(|scene| &*scene.name),
        ..Demand::default()
    };
    let report = certify(&generated.texts[0], &claim, source, &demand).unwrap();
    assert!(report.passes(false), "{name}: {:?}", report.lines);
    generated
}

const MOST: &str = "outputs: inverse_dynamics, gravity, inertia, forward_dynamics";

#[test]
fn a_load_is_the_bodies_in_the_robot_file() {
    for name in ["planar3r", "puma560", "stanford", "scara"] {
        let source = support::source(name, "");
        check(&source, &format!("{MOST}; parameters: bodies"), 4);
    }
    let request = "outputs: inverse_dynamics, coriolis, manipulator_equation, kinetic_energy, momentum, \
        coriolis_matrix, inverse_dynamics_derivatives, passivity, inertia_inverse; parameters: bodies, gravity";
    check(&support::source("planar2r", ""), request, 4);
}

#[test]
fn drives_and_a_payload_go_with_bodies() {
    for name in ["planar2r", "puma560"] {
        let source = support::source(name, "");
        check(
            &source,
            &format!("{MOST}; parameters: bodies, armature, viscous"),
            4,
        );
        check(&source, &format!("{MOST}; parameters: armature"), 4);
    }
    let source = support::source("planar3r", "");
    let case = Case::read(&source, &format!("{MOST}; parameters: bodies, payload"));
    case.rounds_well(10, "planar3r");
}

#[test]
fn some_links_alone_have_other_bodies() {
    let source = support::source("puma560", "");
    let some = check(
        &source,
        &format!("{MOST}; parameters: bodies; bodies: 2, 5"),
        4,
    );
    let full = check(&source, &format!("{MOST}; parameters: bodies"), 4);
    let load = |code: &GeneratedCode| code.functions[0].program.load;
    assert!(load(&some) < load(&full));
}

/// A PUMA with other numbers where it has some costs hardly more than the PUMA.
#[test]
fn zeros_may_stay_zeros() {
    let source = support::source("puma560", "");
    let kept = format!("{MOST}; parameters: bodies; keep_zeros: on");
    let counts = |asked: &str| -> usize {
        let generated = check(&source, asked, 4);
        let mut functions = generated.functions.iter();
        let function = functions.find(|function| function.function == Function::InverseDynamics);
        let counts = function.unwrap().program.counts();
        counts.mul + counts.add
    };
    let (kept, free) = (
        counts(&kept),
        counts(&format!("{MOST}; parameters: bodies")),
    );
    // With constants 258.
    assert!(kept * 100 <= 258 * 135, "{kept}");
    assert!(kept < free, "{kept} {free}");
}

/// Frames of links that are not those of rows, limbs, joints that follow others, a base that floats.
#[test]
fn bodies_are_in_the_frames_of_the_file() {
    let asked = "outputs: inverse_dynamics, inertia; parameters: bodies; scalar: f64";
    let source = support::source("payload_frame", "");
    check(&source, asked, 2);
    let tilted = source.replace(
        "axis = [0, 1, 0]\nmass = 1\n",
        "axis = [0.2, 0.9, -0.4]\nmass = 1\n",
    );
    check(&tilted, &asked.replace(", inertia", ""), 2);
    // Sine and cosine of π/4 are equal, and their squares one half.
    let eighth = source.replace("rpy = [\"pi/2\", 0, 0]", "rpy = [\"pi/4\", 0, 0]");
    assert!(!eighth.contains("pi/2"));
    check(&eighth, asked, 2);
    for name in ["slide_with_follower", "slides_on_limbs"] {
        let path = format!(
            "{}/../crates/formulas/tests/data/{name}.toml",
            env!("CARGO_MANIFEST_DIR")
        );
        let source = write(&read_robot(&std::fs::read_to_string(path).unwrap()));
        check(&source, asked, 2);
    }
}

#[test]
fn a_base_that_floats_is_link_zero() {
    let source = FLOATING;
    let asked = "outputs: inverse_dynamics, inertia; parameters: bodies; scalar: f64";
    check(source, asked, 4);
    check(source, &format!("{asked}; bodies: 0"), 4);
}

const FLOATING: &str = r#"name = "swimmer"
gravity = [0, 0, -9.81]
allow = ["large_inertia"]

[[joint]]
name = "torso"
kind = "floating"
mass = 3
com = [0.01, 0.02, 0.03]
inertia = [0.1, 0.11, 0.12, 0.01, 0, 0]

[[joint]]
name = "left"
kind = "revolute"
placement = { xyz = [0.1, 0, 0] }
axis = [0, 1, 0]
mass = 1
com = [0.1, 0, 0]
inertia = [0.01, 0.02, 0.02, 0, 0, 0]

[[joint]]
name = "right"
parent = "torso"
kind = "revolute"
placement = { xyz = [-0.1, 0, 0] }
axis = [0, 1, 0]
mass = 1
com = [-0.1, 0, 0]
inertia = [0.01, 0.02, 0.02, 0, 0, 0]
"#;

/// Each is proved with the bodies as variables of the field.
fn arms_that_nobody_chose(count: usize) {
    let request = Request {
        parameters: vec![RuntimeParameter::Bodies],
        ..Request::new(&[Function::InverseDynamics])
    };
    let mut proved = 0;
    for (seed, robot, _) in support::draw::robots(count, 0xb0d1e5) {
        match dalembert_codegen::generate(&robot, &request) {
            Ok(generated) => {
                assert_eq!(generated.functions[0].function, Function::Load, "{seed}");
                proved += 1;
            }
            Err(error) => assert!(error.to_string().contains("no effect"), "{seed}: {error}"),
        }
    }
    assert!(10 * proved >= 8 * count, "{proved}");
}

daily_and_campaign! {
    arms_that_nobody_chose: (6), (100);
}

/// Rounding is bounded for the bodies of a link's limits, or for those around the file's.
#[test]
fn bodies_have_ranges() {
    let file = support::source("planar2r", "");
    let limits = "\"pi\"], body = { mass = [1, 30], radius = 1.5 } }";
    let source = file.replacen("\"pi\"] }", limits, 1);
    let asked = "outputs: inverse_dynamics; parameters: bodies; scalar: f64";
    let (around, explicit) = (report(&file, asked), report(&source, asked));
    assert!(
        around.passes(false) && explicit.passes(false),
        "{:?}",
        explicit.lines
    );
    let ranges = |report: &Report| -> Vec<(usize, [f64; 2], f64)> {
        let bodies = report.bodies.iter();
        bodies
            .map(|(link, body)| (*link, body.mass, body.radius))
            .collect()
    };
    let (around, explicit_ranges) = (ranges(&around), ranges(&explicit));
    assert_eq!(explicit_ranges[0], (1, [1.0, 30.0], 1.5));
    assert_eq!(explicit_ranges[1], around[1]);
    assert!(around[0].1[0] < around[0].1[1] && around[0].2 > 0.0);
    let empty = source.replace("[1, 30]", "[30, 1]");
    let why = dalembert_model::read::parse(&empty)
        .unwrap_err()
        .to_string();
    assert!(
        why.contains("the range of its mass is empty or negative"),
        "{why}"
    );
    assert_eq!(
        read_robot(&write(&read_robot(&source))),
        read_robot(&source)
    );
}

/// Ranges around the robot's bodies and drives contain them, also for links without mass and for point
/// masses.
#[test]
fn ranges_hold_the_robots_numbers() {
    let point = "mass = 900\ncom = [0, 1e-19, 0]\ninertia = [0, 0, 0, 0, 0, 0]\nviscous = 12";
    let source = support::source("planar2r", "");
    let (before, behind) = source.split_once("mass = 1\n").unwrap();
    let (_, behind) = behind.split_once("limits").unwrap();
    let source = format!("{before}{point}\nlimits{behind}");
    let (before, behind) = source.rsplit_once("mass = 1\n").unwrap();
    let (_, behind) = behind.split_once("limits").unwrap();
    let source = format!("{before}mass = 0\narmature = 3\nlimits{behind}");
    let asked = "outputs: inverse_dynamics; parameters: bodies, armature, viscous; scalar: f64";
    let report = report(&source, asked);
    assert!(report.passes(false), "{:?}", report.lines);
    let ranges: Vec<_> = report
        .bodies
        .iter()
        .map(|(_, body)| (body.mass, body.radius))
        .collect();
    assert_eq!(ranges, [([450.0, 1800.0], 0.6), ([0.0, 2.0], 0.6)]);
}

/// Some of the load's numbers are printed with a minus. Without it they are of no body, and D need not
/// have an inverse.
#[test]
fn loads_that_are_measured_have_their_signs() {
    for name in ["swimmer", "diver", "crawler", "otter"] {
        let source = FLOATING.replacen("swimmer", name, 1);
        let asked = "outputs: forward_dynamics; parameters: bodies; scalar: f64";
        let report = report(&source, asked);
        let lines = &report.lines;
        let is_small = |line: &FunctionReport| match &line.result {
            Ok(findings) => findings.costs[0].rounding < 1e-10,
            Err(_) => false,
        };
        assert!(lines.iter().all(is_small), "{lines:?}");
    }
}

fn report(source: &str, asked: &str) -> Report {
    let case = Case::read(source, asked);
    let generated = case.generated();
    let claim = claim(case.robot(), source, &case.request, &generated).unwrap();
    let demand = Demand::default();
    certify(&generated.texts[0], &claim.write(), source, &demand).unwrap()
}

/// Loads of armatures and of friction may have as many numbers.
#[test]
fn plans_tell_loads_apart() {
    let case = |parameter: &str| {
        let asked = format!("outputs: inverse_dynamics; parameters: {parameter}; scalar: f64");
        Case::new("planar2r", "", &asked)
    };
    let armature = case("armature");
    let plan = keep(
        armature.robot(),
        &armature.request,
        &armature.searched(),
        None,
    )
    .plan;
    let is_planned = |code: &GeneratedCode| code.functions[1].planned;
    assert!(is_planned(&armature.by(&plan)) && !is_planned(&case("viscous").by(&plan)));
}

#[test]
fn requests_that_cannot_be_are_refused() {
    let said = |lines: &str, asked: &str| Case::refused("planar2r", lines, asked);
    for (asked, why) in [
        ("gravity; bodies: 2", "none are: add `parameters: bodies`"),
        (
            "gravity; keep_zeros: on",
            "none are: add `parameters: bodies`",
        ),
        (
            "gravity; parameters: bodies; bodies: 18446744073709551615",
            "there is no link",
        ),
        (
            "gravity; parameters: bodies; bodies: 1 2",
            "the number of a link",
        ),
        (
            "gravity; parameters: bodies; bodies: +1",
            "the number of a link",
        ),
        ("grav ity", "unknown output `grav ity`"),
        (
            "gravity; parameters: bodies; bodies: 3",
            "there is no link 3: links are 1 to 2",
        ),
        (
            "gravity; parameters: bodies; bodies: two",
            "expected the number of a link",
        ),
        ("gravity; parameters: bodies; bodies: 2, 2", "given twice"),
        (
            "centre_of_mass; parameters: bodies",
            "`load` does not have these",
        ),
        (
            "gravity; parameters: bodies; formulation: lagrange_euler",
            "no regrouped parameters",
        ),
    ] {
        let refusal = said("", asked);
        assert!(refusal.contains(why), "{asked}: {refusal}");
    }
    let payload = "payload = { mass = 2.5, com = [0.05, 0, 0.1] }";
    let payload_refusal = said(payload, "gravity; parameters: bodies");
    assert!(
        payload_refusal.contains("has a payload, which is part of a link"),
        "{payload_refusal}"
    );
    let tolerance = "tolerance = { value = 1e-3, relative_to = \"range\" }\n\
                     box = { velocity = [1, 1], acceleration = [1, 1] }";
    let tolerance_refusal = said(tolerance, "gravity; parameters: bodies");
    assert!(tolerance_refusal.contains("bodies"), "{tolerance_refusal}");
    assert!(read(FLOATING).robot.floating.is_some());
}
