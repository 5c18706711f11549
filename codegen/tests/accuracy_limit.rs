//! The limit on rounding errors: what it refuses and takes, whatever a robot's last digits.

use std::ops::Range;

use dalembert_codegen::workspace::{
    Runtime, Setup,
    testing::{Rounding, seeded},
};
use dalembert_codegen::{Function, GeneratedFunction, Request, ScalarType, Start, generate};
use dalembert_model::equations::Formulation;
use dalembert_model::number::Rational;

use crate::support::draw::robots;
use crate::support::{Case, daily_and_campaign, largest, source};

const TORQUES: &str = "inverse_dynamics";

fn found(source: &str, output: &str, prefer: &str) -> GeneratedFunction {
    let asked = format!("outputs: {output}; scalar: f64; prefer: {prefer}");
    Case::read(source, &asked).generated().functions.remove(0)
}

fn operations(function: &GeneratedFunction) -> usize {
    function.counts().operations()
}

fn heavier(source: &str, factor: f64) -> String {
    let line = |line: &str| match line.strip_prefix("mass = ") {
        Some(mass) => format!("mass = {:.6}\n", mass.parse::<f64>().unwrap() * factor),
        None => format!("{line}\n"),
    };
    source.lines().map(line).collect()
}

daily_and_campaign! {
    neighbours_cost_about_the_same: (0..2), (2..6);
    heavy_rotors_cost_few_digits: (&ROTORS[..2]), (&ROTORS[2..]);
    rotors_of_random_arms_cost_few_digits: (0x40..0x43), (0x43..0x4c);
}

fn neighbours_cost_about_the_same(places: Range<usize>) {
    let file = source("gen3", "");
    let count = operations(&found(&file, TORQUES, "accuracy"));
    let neighbours = [
        file.replace("9.81", "9.80665"),
        heavier(&file, 1.01),
        file.replace("9.81", "9.83"),
        heavier(&file, 0.99),
        file.replace("d = -0.0016", "d = -0.0013"),
        file.replace("d = -0.0016", "d = -0.002"),
    ];
    for neighbour in &neighbours[places] {
        assert_ne!(*neighbour, file);
        let other = operations(&found(neighbour, TORQUES, "accuracy"));
        assert!(count.abs_diff(other) * 50 <= count, "{count} and {other}");
    }
}

#[test]
fn what_the_limit_costs_is_little_and_said() {
    let file = source("gen3", "").replace("d = -0.0016", "d = -0.0003501");
    let taken = found(&file, TORQUES, "accuracy");
    let cheapest = found(&file, TORQUES, "operations");
    let refused = taken.refused.unwrap();
    assert_eq!(cheapest.refused, None);
    assert_eq!(operations(&cheapest), refused.counts.operations());
    assert!(refused.error > 4.0 * refused.taken, "{refused:?}");
    let (few, more) = (operations(&cheapest), operations(&taken));
    assert!(few < more && (more - few) * 50 <= few, "{few} and {more}");
}

/// The cheapest D breaks the limit in one entry, and what keeps it has a larger largest error.
#[test]
fn what_is_cheaper_and_more_exact_is_taken() {
    let file = source("j2s7s300", "");
    let [taken, cheapest] =
        ["accuracy", "operations"].map(|prefer| found(&file, "inertia", prefer));
    assert_eq!(taken.counts(), cheapest.counts());
    assert_eq!(taken.refused, None);
}

#[test]
fn the_estimate_is_what_is_observed() {
    for name in ["gen3", "scara", "gantry", "rprpr", "general6r"] {
        let case = Case::in_scene(name, "", "inverse_dynamics; scalar: f32");
        let (robot, generated) = (case.robot(), case.generated());
        let program = &generated.functions[0].program;
        let estimate = Rounding::estimate(&Setup::whole(robot), program).worst();
        let runtime = Runtime::in_scene(Setup::whole(robot));
        let mut observed = 0.0f64;
        for state in seeded(robot, 300, 7) {
            let state = state.in_scalar(ScalarType::F32);
            let truth = runtime.run(Function::InverseDynamics, &state);
            let torques = generated.emitted[0].run(&state);
            let errors: Vec<f64> = torques.iter().zip(&truth).map(|(x, y)| x - y).collect();
            let error = largest(&errors) / largest(&truth);
            observed = observed.max(error / ScalarType::F32.unit_roundoff());
        }
        let ratio = estimate / observed;
        let what = format!("{name}: estimated {estimate}, observed {observed}");
        assert!((0.3..3.0).contains(&ratio), "{what}");
    }
}

/// Armatures from 0 to 1e6 kg m², or kg.
fn rotors_of_random_arms_cost_few_digits(seeds: Range<u64>) {
    const ARMATURES: [i64; 6] = [0, 0, 1, 100, 10_000, 1_000_000];
    let drawn = robots(12, 0x40).filter(|(seed, ..)| seeds.contains(seed));
    for (seed, mut robot, mut draw) in drawn.filter(|(_, robot, _)| robot.joints.len() <= 4) {
        for joint in &mut robot.joints {
            let armature = ARMATURES[draw.0.below(ARMATURES.len())];
            joint.armature = Rational::from_integer(armature.into());
        }
        let error = |start: Start| {
            let request = Request {
                scalars: vec![ScalarType::F64],
                start,
                ..Request::new(&[Function::ForwardDynamics])
            };
            let generated = generate(&robot, &request).unwrap();
            let program = &generated.functions[0].program;
            Rounding::estimate(&Setup::whole(&robot), program).worst()
        };
        let textbook = error(Start::Only(Formulation::NewtonEulerLink));
        costs_few_digits(error(Start::Auto), textbook, &format!("seed {seed}"));
    }
}

#[track_caller]
fn costs_few_digits(error: f64, textbook: f64, what: &str) {
    let most = 4.0 * textbook.max(4.0);
    assert!(error <= most, "{what}: {error} u, not {most}");
}

/// A robot, the output, and the inertia of the last joint's rotor.
const ROTORS: [[&str; 3]; 8] = [
    ["planar3r", "forward_dynamics", "100"],
    ["planar3r", "forward_dynamics", "1e6"],
    ["planar3r", "inertia_inverse", "1e4"],
    ["planar3r", "forward_dynamics_with_wrench", "1e6"],
    ["stanford", "forward_dynamics", "1e3"],
    ["puma560", "forward_dynamics", "1e5"],
    ["puma560", "inertia_inverse", "1e6"],
    ["scara", "forward_dynamics", "1e4"],
];

/// Beside a heavy rotor, parameters that are added up lose the digits of the others.
fn heavy_rotors_cost_few_digits(cases: &[[&str; 3]]) {
    for [name, output, armature] in cases {
        let file = source(name, "");
        let at = file.rfind("\nmass = ").unwrap();
        let file = format!("{}\narmature = {armature}{}", &file[..at], &file[at..]);
        let error = |formulation: &str| {
            let asked = format!("outputs: {output}; scalar: f64{formulation}");
            let case = Case::read(&file, &asked);
            let program = &case.generated().functions[0].program;
            Rounding::estimate(&Setup::whole(case.robot()), program).worst()
        };
        let [default_error, textbook] = ["", "; formulation: newton_euler"].map(error);
        let what = format!("{name} {output} {armature}");
        costs_few_digits(default_error, textbook, &what);
    }
}
