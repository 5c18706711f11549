//! The matrix of extremes: every category, f64 and f32, generic runtime and
//! emitted code, each by its criterion.
#![cfg(feature = "stress")]

mod extremes_support;

use std::collections::{BTreeMap, BTreeSet};

use dalembert_codegen::emit::ScalarType;
use dalembert_codegen::function::{Function, Quantity};
use dalembert_codegen::generate::{Request, Start};
use dalembert_codegen::stress::deviation::{Deviation, Measure};
use dalembert_codegen::stress::rounding::rounded;
use dalembert_codegen::stress::scale;
use dalembert_codegen::stress::subject::{Code, Subject};
use dalembert_codegen::stress::truth::Truth;
use dalembert_model::equations::Formulation;
use dalembert_model::robot::Robot;
use dalembert_model::scalar::big::Big;
use extremes_support::Extreme;

/// Errors above this, normwise, fail.
const NORMWISE: f64 = 100.0;
/// Errors above this, of a joint against what it meets, fail.
const PER_JOINT: f64 = 50.0;

/// What a category is held to.
#[derive(Clone, Copy, PartialEq)]
enum Criterion {
    Both,
    Normwise,
    PerJoint,
}

fn criterion(category: &str) -> Criterion {
    let starts = |prefixes: &[&str]| prefixes.iter().any(|p| category.starts_with(p));
    if starts(&[
        "static_near_balance",
        "tiny_",
        "folded_2link",
        "pointmass_tip",
    ]) {
        Criterion::PerJoint
    } else if starts(&["massratio", "length", "snake"]) {
        Criterion::Normwise
    } else {
        Criterion::Both
    }
}

/// Worst error of a quantity.
#[derive(Default)]
struct Worst {
    normwise: f64,
    per_joint: f64,
}

/// The programs of a robot: they do not depend on the state.
struct Robots(Vec<(Robot, ScalarType, Truth, [Code; 2])>);

impl Robots {
    fn get(&mut self, robot: &Robot, scalar: ScalarType) -> (&Truth, &[Code; 2]) {
        let at = self
            .0
            .iter()
            .position(|(r, s, ..)| r == robot && *s == scalar);
        let at = at.unwrap_or_else(|| {
            let start = start(robot);
            let request = Request {
                functions: functions(robot).to_vec(),
                scalars: vec![scalar],
                start,
                ..Request::default()
            };
            let emitted = Code::emitted(robot, &request).unwrap_or_else(|e| panic!("{e}"));
            let [emitted] = <[Code; 1]>::try_from(emitted).expect("one scalar");
            let codes = [Code::runtime(robot, scalar), emitted];
            self.0
                .push((robot.clone(), scalar, Truth::new(robot), codes));
            self.0.len() - 1
        });
        let (_, _, truth, codes) = &self.0[at];
        (truth, codes)
    }
}

/// Lagrange–Euler with many different angles is written out in no reasonable
/// size: it is left out there.
fn start(robot: &Robot) -> Start {
    let angles = robot.joints.iter().flat_map(|j| [&j.alpha, &j.theta]);
    let mut angles: Vec<_> = angles.filter(|a| a.quarter_turns().is_none()).collect();
    angles.sort();
    angles.dedup();
    if robot.joints.len() <= 10 && angles.len() <= 6 {
        Start::Auto
    } else {
        Start::Only(Formulation::NewtonEulerLink)
    }
}

fn functions(robot: &Robot) -> &'static [Function] {
    match robot.joints.len() {
        0..=20 => &[Function::InverseDynamics, Function::ManipulatorEquation],
        _ => &[Function::InverseDynamics],
    }
}

#[test]
fn every_category_meets_its_criterion() {
    let mut robots = Robots(Vec::new());
    let mut worst: BTreeMap<(String, ScalarType, Subject, Quantity), Worst> = BTreeMap::new();
    let mut failures = Vec::new();
    for case in extremes_support::read() {
        for scalar in ScalarType::ALL {
            let (robot, state) = match scalar {
                ScalarType::F64 => (case.robot.clone(), case.state.clone()),
                ScalarType::F32 => {
                    let robot = rounded(&case.robot, scalar).expect("parameters within f32");
                    (robot, case.state.in_single())
                }
            };
            let bounds = scale::magnitudes(&robot, &state);
            let measure = Measure::new(&robot, scalar, scale::torques(&robot, &bounds));
            let (truth, codes) = robots.get(&robot, scalar);
            for &function in functions(&robot) {
                let expected = truth.run(function, &state).expect("a finite state");
                for (subject, code) in Subject::ALL.into_iter().zip(codes) {
                    let found = code.run(function, &state).unwrap();
                    let mut start = 0;
                    for &quantity in function.quantities() {
                        let range = start..start + quantity.len(state.q.len());
                        start = range.end;
                        let (found, truth) = (&found[range.clone()], &expected[range]);
                        if overflows(&case, scalar) {
                            assert!(never_silent(found, truth), "{}", case.id);
                            continue;
                        }
                        let deviation = measure.of(found, truth);
                        if fails(&case, quantity, &deviation) {
                            failures.push(format!(
                                "{} {scalar} {subject} {quantity:?}: {deviation:?}",
                                case.id
                            ));
                        }
                        let key = (case.category.clone(), scalar, subject, quantity);
                        let worst = worst.entry(key).or_default();
                        worst.normwise = worst.normwise.max(deviation.normwise);
                        worst.per_joint = worst.per_joint.max(deviation.per_joint);
                    }
                }
            }
        }
    }
    print(&worst);
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

fn fails(case: &Extreme, quantity: Quantity, deviation: &Deviation) -> bool {
    let criterion = criterion(&case.category);
    // Only D and τ are large somewhere in every state of these.
    let normwise = match quantity {
        Quantity::Torque => criterion != Criterion::PerJoint,
        Quantity::Inertia => true,
        _ => false,
    };
    let per_joint = quantity == Quantity::Torque && criterion != Criterion::Normwise;
    let beyond = |error: f64, bound: f64| error.is_nan() || error > bound;
    normwise && beyond(deviation.normwise, NORMWISE)
        || per_joint && beyond(deviation.per_joint, PER_JOINT)
}

/// Whether the state is out of the scalar's range on purpose.
fn overflows(case: &Extreme, scalar: ScalarType) -> bool {
    case.category.starts_with("f32overflow") && scalar == ScalarType::F32
}

/// What is beyond the range must not look like a number.
fn never_silent(found: &[f64], truth: &[Big]) -> bool {
    let largest = f64::from(f32::MAX);
    let beyond = |truth: &Big| truth.abs().to_f64() > largest;
    !truth.iter().any(beyond) || found.iter().any(|x| !x.is_finite())
}

/// One line a category: τ normwise / per joint, then D normwise, of runtime
/// and emitted code in f64, then in f32.
fn print(worst: &BTreeMap<(String, ScalarType, Subject, Quantity), Worst>) {
    let categories: BTreeSet<&String> = worst.keys().map(|key| &key.0).collect();
    println!("| category | runtime f64 | emitted f64 | runtime f32 | emitted f32 |");
    println!("|---|---|---|---|---|");
    for category in categories {
        let mut line = format!("| {category} |");
        for scalar in ScalarType::ALL {
            for subject in Subject::ALL {
                let get = |q| worst.get(&(category.clone(), scalar, subject, q));
                let cell = match (get(Quantity::Torque), get(Quantity::Inertia)) {
                    (None, _) => "out of range".into(),
                    (Some(tau), None) => format!("{:.1} / {:.1}", tau.normwise, tau.per_joint),
                    (Some(tau), Some(d)) => {
                        format!(
                            "{:.1} / {:.1}, D {:.1}",
                            tau.normwise, tau.per_joint, d.normwise
                        )
                    }
                };
                line += &format!(" {cell} |");
            }
        }
        println!("{line}");
    }
}
