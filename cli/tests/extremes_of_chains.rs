//! The 114 states of the file of extremes, f64 and f32, generic runtime and emitted code, each by
//! its criterion. Without optimisation, the first case of each category, and no search of long arms:
//! minutes are for release mode.

use std::collections::BTreeMap;
use std::ops::Range;

use crate::extremes_support::runtime::runtime;
use crate::extremes_support::{self, Extreme, drawn_like};
use dalembert_cli::extremes::Held;
use dalembert_cli::measure::{Bench, Code, ENTRY, VECTOR};
use dalembert_codegen::workspace::{Emitted, Quantity, SceneRobot};
use dalembert_codegen::{Function, Request, ScalarType, Start, generate};
use dalembert_model::equations::Formulation;
use dalembert_model::robot::Robot;

fn held(category: &str) -> Held {
    let starts = |prefixes: &[&str]| prefixes.iter().any(|p| category.starts_with(p));
    if starts(&[
        "static_near_balance",
        "tiny_",
        "folded_2link",
        "pointmass_tip",
    ]) {
        Held::Entries
    } else if starts(&["massratio", "length", "snake"]) {
        Held::Vector
    } else {
        Held::Both
    }
}

/// The programs of a robot: they do not depend on the state.
struct Programs {
    robot: Robot,
    bench: Bench,
    emitted: Vec<Emitted>,
}

impl Programs {
    fn new(robot: &Robot, scalar: ScalarType, first: bool) -> Programs {
        let functions = functions(robot, scalar).iter();
        let emitted = functions.flat_map(|&function| {
            let request = Request {
                scalars: vec![scalar],
                start: start(robot, scalar, function, first),
                ..Request::of(&[function])
            };
            generate(robot, &request)
                .unwrap_or_else(|e| panic!("{e}"))
                .emitted
        });
        Programs {
            robot: robot.clone(),
            bench: Bench::new(SceneRobot::whole(robot)),
            emitted: emitted.collect(),
        }
    }
}

/// Returns what is searched; but where that takes long, with many different angles
/// and in long chains, only τ of each category's first robot in f64, and else
/// the recursion as it is. Without optimisation, only short arms are searched.
fn start(robot: &Robot, scalar: ScalarType, function: Function, first: bool) -> Start {
    let angles = robot.joints.iter().flat_map(|j| [&j.alpha, &j.theta]);
    let mut odd: Vec<_> = angles.filter(|a| a.quarter_turns().is_none()).collect();
    odd.sort();
    odd.dedup();
    let quick = match (scalar, function) {
        (ScalarType::F64, Function::InverseDynamics) => first && robot.joints.len() <= 12,
        _ => robot.joints.len() <= 3 || odd.len() <= 2 && robot.joints.len() <= 7,
    };
    if quick && (!cfg!(debug_assertions) || robot.joints.len() <= 4) {
        Start::Auto
    } else {
        Start::Only(Formulation::NewtonEulerLink)
    }
}

/// The criteria are on τ. D, h and c come from the same recursion and the same
/// search; their programs are larger, so that not all are generated here.
fn functions(robot: &Robot, scalar: ScalarType) -> &'static [Function] {
    let most = match scalar {
        ScalarType::F64 => 7,
        ScalarType::F32 => 4,
    };
    if robot.joints.len() <= most {
        &[Function::InverseDynamics, Function::ManipulatorEquation]
    } else {
        &[Function::InverseDynamics]
    }
}

// In two halves, to share the work between threads.
#[test]
fn the_first_categories_meet_their_criteria_in_f64() {
    categories_meet_their_criteria(ScalarType::F64, 0..57);
}

#[test]
fn the_last_categories_meet_their_criteria_in_f64() {
    categories_meet_their_criteria(ScalarType::F64, 57..114);
}

#[test]
fn every_category_meets_its_criterion_in_f32() {
    categories_meet_their_criteria(ScalarType::F32, 0..114);
}

fn categories_meet_their_criteria(scalar: ScalarType, range: Range<usize>) {
    let mut robots: Vec<Programs> = Vec::new();
    let mut worst: BTreeMap<(String, &str), [f64; 2]> = BTreeMap::new();
    let mut failures = Vec::new();
    let cases = extremes_support::read(scalar);
    assert_eq!(cases.len(), 114);
    let is_first = |case: &Extreme| case.id.ends_with("_00");
    let is_tried = |case: &&Extreme| !cfg!(debug_assertions) || is_first(case);
    for case in cases[range].iter().filter(is_tried) {
        let (robot, state) = (&case.robot, &case.state);
        let known = robots.iter().position(|programs| programs.robot == *robot);
        let known = known.unwrap_or_else(|| {
            robots.push(Programs::new(robot, scalar, is_first(case)));
            robots.len() - 1
        });
        let Programs { bench, emitted, .. } = &robots[known];
        let scales = drawn_like(robot, state);
        for own in emitted {
            let codes = [
                ("runtime", runtime(robot, own.function, scalar)),
                ("emitted", Code::of(own)),
            ];
            for (subject, code) in codes {
                // A vector is compared with what it is at this state.
                let alone = [state.clone()];
                for found in bench.measure(&code, &alone, &alone) {
                    if overflows(case, scalar) {
                        let truth = bench.truth(own.function, state);
                        let largest = f64::from(f32::MAX);
                        let beyond = truth.iter().any(|x| x.magnitude() > largest);
                        // No result looks like a number where the truth is beyond the range.
                        assert!(!beyond || found.overflows, "{}", case.id);
                        continue;
                    }
                    let is_vector = match found.quantity {
                        Quantity::Torque => held(&case.category) != Held::Entries,
                        // D is large somewhere in every state; h and c may vanish.
                        quantity => quantity == Quantity::Inertia,
                    };
                    let mut entry = 0.0;
                    if found.quantity == Quantity::Torque {
                        entry = bench.measure(&code, &alone, &scales)[0].entry;
                        let key = (case.category.clone(), subject);
                        let worst = worst.entry(key).or_default();
                        *worst = [worst[0].max(found.vector), worst[1].max(entry)];
                        if held(&case.category) == Held::Vector {
                            entry = 0.0;
                        }
                    }
                    if is_vector && found.vector > VECTOR || entry > ENTRY {
                        failures.push(format!("{} {scalar} {subject} {found:?} {entry}", case.id));
                    }
                }
            }
        }
    }
    for ((category, subject), [vector, entry]) in worst {
        println!("{category} {subject} {scalar}: {vector:.1} / {entry:.1}");
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

/// Returns whether the state is out of the scalar's range on purpose.
fn overflows(case: &Extreme, scalar: ScalarType) -> bool {
    case.category.starts_with("f32overflow") && scalar == ScalarType::F32
}
