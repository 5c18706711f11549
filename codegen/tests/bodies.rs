//! Bodies and drives that are arguments: code gives what robot files with these bodies give.

use dalembert_checker::certify::{Demand, FunctionReport, Report, certify};
use dalembert_codegen::workspace::{JointState, claim};
use dalembert_codegen::{Function, GeneratedCode, Request, generate};
use dalembert_model::outputs::RuntimeParameter;
use dalembert_model::read::parse;
use dalembert_model::robot::write;

use crate::arguments::hold_in_files;
use crate::support::{self, Case, daily_and_campaign, read, read_robot, says};

/// Returns a robot file with a state's bodies, of which a base that floats is link 0, and drives.
fn with_bodies(source: &str, state: &JointState, links: &[usize]) -> String {
    let mut text = String::new();
    // The table of a base that floats comes first.
    let mut link = -i64::from(source.contains("\"floating\""));
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
    let mut plain = Request {
        scene: case.request.scene.clone(),
        parameters: case.request.parameters.clone(),
        ..Request::default()
    };
    plain
        .parameters
        .retain(|parameter| parameter.given().is_none() || *parameter == RuntimeParameter::Payload);
    hold_in_files(&generated, &states, &plain, name, |state| {
        for (is_zero, x) in setup.zeros().iter().zip(&mut state.bodies) {
            *x = if *is_zero { 0.0 } else { *x };
        }
        read_robot(&with_bodies(source, state, &setup.body_links()))
    });
    shown(&case, source, &generated);
    generated
}

#[track_caller]
fn shown(case: &Case, source: &str, generated: &GeneratedCode) -> Report {
    let claim = claim(case.robot(), source, &case.request, generated).unwrap();
    let demand = Demand {
        scene: case.request.scene.as_ref().map(|scene| &*scene.name),
        ..Demand::default()
    };
    let report = certify(&generated.texts[0], &claim.write(), source, &demand).unwrap();
    assert!(report.passes(false), "{:?}", report.lines);
    report
}

#[track_caller]
fn report(source: &str, asked: &str) -> Report {
    let case = Case::read(source, asked);
    shown(&case, source, &case.generated())
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
        for parameters in ["bodies, armature, viscous", "armature"] {
            check(&source, &format!("{MOST}; parameters: {parameters}"), 4);
        }
    }
    let source = support::source("planar3r", "");
    let case = Case::read(&source, &format!("{MOST}; parameters: bodies, payload"));
    case.rounds_well(10, "planar3r");
}

#[test]
fn some_links_alone_have_other_bodies() {
    let source = support::source("puma560", "");
    let [some, full] = ["; bodies: 2, 5", ""].map(|more| {
        let code = check(&source, &format!("{MOST}; parameters: bodies{more}"), 4);
        code.functions[0].program.load
    });
    assert!(some < full);
}

/// A PUMA with other numbers where it has some costs hardly more than the PUMA.
#[test]
fn zeros_may_stay_zeros() {
    let source = support::source("puma560", "");
    let [kept, free] = ["; keep_zeros: on", ""].map(|more| {
        let generated = check(&source, &format!("{MOST}; parameters: bodies{more}"), 4);
        let mut functions = generated.functions.iter();
        let function = functions.find(|function| function.function == Function::InverseDynamics);
        let counts = function.unwrap().program.counts();
        counts.mul + counts.add
    });
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
    let tilted = source.replace("[0, 1, 0]\nmass = 1\n", "[0.2, 0.9, -0.4]\nmass = 1\n");
    check(&tilted, &asked.replace(", inertia", ""), 2);
    // Sine and cosine of π/4 are equal, and their squares one half.
    let eighth = source.replace("rpy = [\"pi/2\", 0, 0]", "rpy = [\"pi/4\", 0, 0]");
    assert!(!eighth.contains("pi/2"));
    check(&eighth, asked, 2);
    for name in ["slide_with_follower", "slides_on_limbs"] {
        let file = support::text(&format!("../crates/formulas/tests/data/{name}.toml"));
        check(&write(&read_robot(&file)), asked, 2);
    }
}

#[test]
fn a_base_that_floats_is_link_zero() {
    let asked = "outputs: inverse_dynamics, inertia; parameters: bodies; scalar: f64";
    check(FLOATING, asked, 4);
    check(FLOATING, &format!("{asked}; bodies: 0"), 4);
    assert!(read(FLOATING).robot.floating.is_some());
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
        match generate(&robot, &request) {
            Ok(generated) => {
                assert_eq!(generated.functions[0].function, Function::Load, "{seed}");
                proved += 1;
            }
            Err(error) => says(&error.to_string(), "no effect"),
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
    let [around, explicit] = [&file, &source].map(|source| ranges(&report(source, asked)));
    assert_eq!(explicit[0], (1, [1.0, 30.0], 1.5));
    assert_eq!(explicit[1], around[1]);
    assert!(around[0].1[0] < around[0].1[1] && around[0].2 > 0.0);
    let empty = source.replace("[1, 30]", "[30, 1]");
    let why = parse(&empty).unwrap_err().to_string();
    says(&why, "the range of its mass is empty or negative");
    let robot = read_robot(&source);
    assert_eq!(read_robot(&write(&robot)), robot);
}

fn ranges(report: &Report) -> Vec<(usize, [f64; 2], f64)> {
    let bodies = report.bodies.iter();
    let ranges = bodies.map(|(link, body)| (*link, body.mass, body.radius));
    ranges.collect()
}

/// Ranges contain the robot's bodies and drives, also links without mass and point masses.
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
    let expected = [(1, [450.0, 1800.0], 0.6), (2, [0.0, 2.0], 0.6)];
    assert_eq!(ranges(&report(&source, asked)), expected);
}

/// Without the minus that some numbers of the load are printed with they are of no body.
#[test]
fn loads_that_are_measured_have_their_signs() {
    for name in ["swimmer", "diver", "crawler", "otter"] {
        let source = FLOATING.replacen("swimmer", name, 1);
        let asked = "outputs: forward_dynamics; parameters: bodies; scalar: f64";
        let lines = report(&source, asked).lines;
        let is_small = |line: &FunctionReport| match &line.result {
            Ok(findings) => findings.costs[0].rounding < 1e-10,
            Err(_) => false,
        };
        assert!(lines.iter().all(is_small), "{lines:?}");
    }
}

/// Loads of armatures and of friction may have as many numbers.
#[test]
fn plans_tell_loads_apart() {
    let case = |parameter: &str| {
        let asked = format!("outputs: inverse_dynamics; parameters: {parameter}; scalar: f64");
        Case::new("planar2r", "", &asked)
    };
    let armature = case("armature");
    let plan = armature.plan(&armature.searched());
    let is_planned = |code: &GeneratedCode| code.functions[1].planned;
    assert!(is_planned(&armature.by(&plan)) && !is_planned(&case("viscous").by(&plan)));
}
