//! How tight bounds are, and how long a quick search takes: measured, not judged.
//! `cargo run --release -p dalembert-codegen --example tightness -- rounding panda`
//!
//! - `rounding ARM …`: what exact programs' rounding is bounded by, in units of
//!   u·T, against the largest error seen in f32. The reference of `falsify` is a
//!   double, so nothing can be seen in f64: there the bound stands alone.
//! - `floor ARM …`: what the same sum of magnitudes comes to at single states: no
//!   bound by first-order terms is less
//! - `narrow HALF ARM …`: what edits in boxes of so many milliradians to both sides of
//!   several poses are bounded by, against the largest error seen
//! - `time FUNCTION ARM …`: a search for a tolerance of a thousandth

use std::time::Instant;

use dalembert_codegen::workspace::{
    Certificate, ErrorBudget, InputBox, Interval, JointState, PruneSettings, Random, SceneRobot,
    Stage, climb, draw, falsify, prune, rounding,
};
use dalembert_codegen::{Function, Program, Request, ScalarType, generate};
use dalembert_model::number::{Angle, Rational};
use dalembert_model::read::{self, Reading};
use dalembert_model::robot::{JointKind, Position, Robot};
use dalembert_model::scene::Scale;

const SAMPLES: usize = 200_000;
const CLIMBS: usize = 12;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match arguments.split_first() {
        Some((what, arms)) if what == "rounding" => arms.iter().for_each(|arm| rounding_of(arm)),
        Some((what, arms)) if what == "floor" => arms.iter().for_each(|arm| floor(arm)),
        Some((what, [half, arms @ ..])) if what == "narrow" => {
            let half = half.parse().expect("half a width in milliradians");
            arms.iter().for_each(|arm| narrow(half, arm));
        }
        Some((what, [function, arms @ ..])) if what == "time" => {
            arms.iter().for_each(|arm| time(function, arm));
        }
        _ => println!("rounding ARM …, floor ARM …, narrow HALF ARM … or time FUNCTION ARM …"),
    }
}

/// Returns a robot, with more in its file.
fn reading(name: &str, more: &str) -> Reading {
    let root = env!("CARGO_MANIFEST_DIR");
    let places = ["../generated/robots", "tests/data"];
    let file = places.map(|place| format!("{root}/{place}/{name}.toml"));
    let text = file
        .iter()
        .find_map(|path| std::fs::read_to_string(path).ok());
    let text = text.unwrap_or_else(|| panic!("no file of {name}")) + more;
    read::parse(&text, &read::Options::default()).unwrap_or_else(|errors| panic!("{errors}"))
}

/// Returns a robot that moves within limits: its own, or some.
fn limited(name: &str) -> Robot {
    let mut robot = reading(name, "").robot;
    let milli = |x: i64| Rational::new(x.into(), 1000.into());
    for joint in &mut robot.joints {
        let limits = &mut joint.limits;
        if joint.kind == JointKind::Prismatic && limits.position.is_none() {
            limits.position = Some([-300, 500].map(|x| Position::Length(milli(x))));
        }
        limits.velocity.get_or_insert_with(|| milli(2000));
        limits.acceleration.get_or_insert_with(|| milli(10_000));
    }
    robot
}

fn exact(robot: &Robot, function: Function) -> Program {
    let request = Request {
        scalars: vec![ScalarType::F64],
        ..Request::of(&[function])
    };
    let mut generated = generate(robot, &request).unwrap_or_else(|error| panic!("{error}"));
    generated.functions.remove(0).program
}

/// Returns the largest of each output's ratio, over all.
fn worst(pairs: impl Iterator<Item = (f64, f64)>) -> f64 {
    let ratios = pairs.map(|(bound, seen)| if bound == 0.0 { 0.0 } else { bound / seen });
    ratios.fold(0.0, f64::max)
}

fn rounding_of(name: &str) {
    let robot = limited(name);
    let program = exact(&robot, Function::InverseDynamics);
    let limits = InputBox::of(&robot).unwrap();
    let scene_robot = SceneRobot::whole(&robot);
    let budget = ErrorBudget::new(&scene_robot, &program, Scale::Range).unwrap();
    for scalar in [ScalarType::F64, ScalarType::F32] {
        let start = Instant::now();
        let made = Certificate::make(&robot, &[], &program, scalar, &limits, &budget.scales);
        let seconds = start.elapsed().as_secs_f64();
        let u = scalar.unit_roundoff();
        let total = |index: usize| made.bounds[index].total() / u;
        let largest = (0..made.bounds.len())
            .max_by(|&a, &b| total(a).total_cmp(&total(b)))
            .unwrap_or(0);
        let (arithmetic, sines) = (made.bounds[largest].rounding, made.bounds[largest].sincos);
        print!(
            "{name} {scalar:?}: {:.1} + {:.1} of output {largest}, {seconds:.1} s",
            arithmetic / u,
            sines / u
        );
        if scalar == ScalarType::F32 {
            let seen = falsify(&made, SAMPLES, CLIMBS, 5).unwrap();
            assert_eq!(seen.violation, None);
            let pairs = (0..)
                .map(total)
                .zip(seen.observed.iter().map(|seen| seen / u));
            let pairs: Vec<(f64, f64)> = pairs.collect();
            let most = pairs.iter().map(|pair| pair.1).fold(0.0, f64::max);
            let each = pairs
                .iter()
                .map(|(bound, seen)| format!("{:.1}", bound / seen));
            print!(
                "; seen {most:.1}, largest to largest {:.1}, ratio {:.1} of {}",
                total(largest) / most,
                worst(pairs.iter().copied()),
                each.collect::<Vec<_>>().join(" "),
            );
        }
        println!();
    }
}

/// Searches for the largest sum of |own rounding|·|adjoint| at a state that climbs find.
fn floor(name: &str) {
    let robot = limited(name);
    let program = exact(&robot, Function::InverseDynamics);
    let limits = InputBox::of(&robot).unwrap();
    let scene_robot = SceneRobot::whole(&robot);
    let budget = ErrorBudget::new(&scene_robot, &program, Scale::Range).unwrap();
    let scalar = ScalarType::F32;
    let mut random = Random::new(3);
    let each = budget.scales.iter().enumerate().map(|(output, scale)| {
        let alone = Program {
            outputs: vec![program.outputs[output].clone()],
            ..program.clone()
        };
        let mut at = |state: &JointState| {
            let point = |values: &[f64]| values.iter().map(|&x| Interval::point(x)).collect();
            let here = InputBox {
                position: point(&state.q),
                velocity: point(&state.qd),
                acceleration: point(&state.qdd),
            };
            let found = rounding(&alone, scalar, &[], &here, 1)[0];
            (found.arithmetic + found.sincos) / scale / scalar.unit_roundoff()
        };
        let climbs = (0..4).map(|_| {
            let from = draw(&limits, &mut random);
            climb(&limits, from, 1500, &mut random.clone(), &mut at).1
        });
        climbs.fold(0.0, f64::max)
    });
    let each: Vec<String> = each.map(|most| format!("{most:.1}")).collect();
    println!("{name} at single states: {}", each.join(" "));
}

/// Poses in thousandths, joint after joint in turn.
const POSES: [[i64; 7]; 3] = [
    [300, -700, 900, 400, 1100, -500, 200],
    [-1200, 600, -300, 1500, -800, 700, -1000],
    [0, 1571, 0, -1571, 0, 0, 0],
];

fn narrow(half: i64, name: &str) {
    let whole = limited(name);
    let program = exact(&whole, Function::InverseDynamics);
    for pose in POSES {
        let mut robot = whole.clone();
        for (joint, middle) in robot.joints.iter_mut().zip(pose) {
            let ends = [middle - half, middle + half];
            joint.limits.position = Some(ends.map(|milli| {
                let value = Rational::new(milli.into(), 1000.into());
                match joint.kind {
                    JointKind::Prismatic => Position::Length(value),
                    JointKind::Revolute => Position::Angle(Angle::Radians(value)),
                }
            }));
        }
        for tolerance in [1e-2, 1e-3] {
            let what = format!("{name} {pose:?} ±{half} mrad at {tolerance}");
            narrowly(&robot, &program, tolerance, &what);
        }
    }
}

fn narrowly(robot: &Robot, program: &Program, tolerance: f64, what: &str) {
    let limits = InputBox::of(robot).unwrap();
    let scene_robot = SceneRobot::whole(robot);
    let budget = ErrorBudget::new(&scene_robot, program, Scale::Range).unwrap();
    let scales = budget.scales;
    let allowances: Vec<f64> = scales.iter().map(|t| t * tolerance).collect();
    let settings = PruneSettings {
        samples: 16,
        guesses: 2,
        retries: 0,
        stages: 1,
        ..PruneSettings::default()
    };
    let start = Instant::now();
    let pruned = prune(program, &limits, &allowances, &settings);
    let searched = start.elapsed().as_secs_f64();
    let start = Instant::now();
    let stages: &[Stage] = &pruned.stages;
    let scalar = ScalarType::F64;
    let made = Certificate::make(robot, stages, &pruned.program, scalar, &limits, &scales);
    let bounded = start.elapsed().as_secs_f64();
    let seen = falsify(&made, SAMPLES / 2, CLIMBS, 5).unwrap();
    assert_eq!(seen.violation, None);
    let model = made.bounds.iter().map(|bound| bound.model);
    let pairs: Vec<(f64, f64)> = model.zip(seen.observed.iter().copied()).collect();
    let largest = pairs
        .iter()
        .copied()
        .fold((0.0, 0.0), |a: (f64, f64), b| (a.0.max(b.0), a.1.max(b.1)));
    // Outputs that nothing was left out of have no ratio.
    let each = pairs.iter().filter(|(bound, _)| *bound > 0.0);
    let each = each.map(|(bound, seen)| format!("{:.2}", bound / seen));
    println!(
        "{what}: {} of {} operations, bound {:.2e}, seen {:.2e}, ratio {:.2} of {}; {searched:.1} + {bounded:.1} s",
        pruned.program.counts().operations(),
        program.counts().operations(),
        largest.0,
        largest.1,
        worst(pairs.iter().copied()),
        each.collect::<Vec<_>>().join(" "),
    );
}

fn time(function: &str, name: &str) {
    let joints = reading(name, "").robot.joints;
    let slides = joints.iter().map(|joint| match joint.kind {
        JointKind::Prismatic => "[-0.3, 0.5]",
        JointKind::Revolute => "[\"-pi\", \"pi\"]",
    });
    let rates = |rate: &str| vec![rate; joints.len()].join(", ");
    let scene = format!(
        "\n[scene.timed]\noutputs = [\"{function}\"]\nbox = {{ position = [{}], velocity = [{}], \
         acceleration = [{}] }}\ntolerance = {{ value = 1e-3, relative_to = \"range\" }}\n",
        slides.collect::<Vec<_>>().join(", "),
        rates("2"),
        rates("10"),
    );
    let reading = reading(name, &scene);
    let scene = reading.scenes.iter().find(|scene| scene.name == "timed");
    let request = Request::default().choose(None, Some(vec![ScalarType::F64]), scene);
    let start = Instant::now();
    let generated = generate(&reading.robot, &request).unwrap_or_else(|error| panic!("{error}"));
    let counts = generated.functions[0].program.counts();
    println!(
        "{name}: {} operations, {} sines, {:.1} s",
        counts.operations(),
        counts.sincos,
        start.elapsed().as_secs_f64()
    );
}
