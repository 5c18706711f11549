//! The matrix of extremes: every category, f64 and f32, generic runtime and
//! emitted code, each by its criterion. Without optimisation, the first case of
//! each category, and no search of long arms: minutes are for release mode.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use crate::extremes_support;
use crate::extremes_support::Extreme;
use crate::extremes_support::rounding::rounded;
use dalembert_codegen::workspace::{Quantity, Reference, SceneRobot, Sizes, TrueValue};
use dalembert_codegen::{Function, Request, ScalarType, Start, generate};
use dalembert_model::equations::Formulation;
use dalembert_model::robot::Robot;
use dalembert_report::stress::category::{Criterion, NORMWISE};
use dalembert_report::stress::deviation::{Deviation, Measure};
use dalembert_report::stress::scale;
use dalembert_report::stress::subject::{Code, Subject};

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

/// The worst errors by category, code and quantity.
type Table = BTreeMap<(String, Subject, Quantity), Deviation>;
/// The programs of a robot: they do not depend on the state.
struct Robots(Vec<(Robot, ScalarType, Reference, [Code; 2])>);

impl Robots {
    fn get(&mut self, robot: &Robot, scalar: ScalarType, first: bool) -> (&Reference, &[Code; 2]) {
        let at = self
            .0
            .iter()
            .position(|(r, s, ..)| r == robot && *s == scalar);
        let at = at.unwrap_or_else(|| {
            let mut emitted = Vec::new();
            for &function in functions(robot, scalar) {
                let request = Request {
                    scalars: vec![scalar],
                    start: start(robot, scalar, function, first),
                    ..Request::of(&[function])
                };
                let generated = generate(robot, &request).unwrap_or_else(|e| panic!("{e}"));
                emitted.extend(generated.emitted);
            }
            let emitted = Code::Emitted(emitted);
            let codes = [Code::runtime(robot, scalar), emitted];
            self.0.push((
                robot.clone(),
                scalar,
                Reference::new(&SceneRobot::whole(robot)),
                codes,
            ));
            self.0.len() - 1
        });
        let (_, _, truth, codes) = &self.0[at];
        (truth, codes)
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
    let mut robots = Robots(Vec::new());
    let mut worst = Table::new();
    let mut failures = Vec::new();
    let cases = extremes_support::read();
    assert_eq!(cases.len(), 114);
    let is_tried = |case: &&Extreme| !cfg!(debug_assertions) || is_first(case);
    for case in cases[range].iter().filter(is_tried) {
        let (robot, state) = match scalar {
            ScalarType::F64 => (case.robot.clone(), case.state.clone()),
            ScalarType::F32 => {
                let robot = rounded(&case.robot, scalar).expect("parameters within f32");
                (robot, case.state.in_scalar(scalar))
            }
        };
        let bounds = scale::magnitudes(&robot, &state);
        let states = scale::draw(&bounds, scale::STATES, scale::SEED);
        let measure = Measure::new(&robot, scalar, scale::torques(&robot, &states));
        let (truth, codes) = robots.get(&robot, scalar, is_first(case));
        for &function in functions(&robot, scalar) {
            let expected = truth.run(function, &state);
            for (subject, code) in Subject::ALL.into_iter().zip(codes) {
                let found = code.run(function, &state).unwrap();
                let mut start = 0;
                for &quantity in function.quantities() {
                    let range = start..start + quantity.len(Sizes::whole(state.q.len()));
                    start = range.end;
                    let (found, truth) = (&found[range.clone()], &expected[range]);
                    if overflows(case, scalar) {
                        assert!(never_silent(found, truth), "{}", case.id);
                        continue;
                    }
                    let deviation = measure.of(found, truth);
                    if fails(case, quantity, &deviation) {
                        failures.push(format!(
                            "{} {scalar} {subject} {quantity:?}: {deviation:?}",
                            case.id
                        ));
                    }
                    let key = (case.category.clone(), subject, quantity);
                    let worst = worst.entry(key).or_default();
                    worst.normwise = worst.normwise.max(deviation.normwise);
                    worst.per_joint = worst.per_joint.max(deviation.per_joint);
                }
            }
        }
    }
    print(scalar, &worst);
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

/// Returns whether it is the first case of its category.
fn is_first(case: &Extreme) -> bool {
    case.id.ends_with("_00")
}

fn fails(case: &Extreme, quantity: Quantity, deviation: &Deviation) -> bool {
    let criterion = criterion(&case.category);
    // D is large somewhere in every state; h and c may vanish.
    let normwise = quantity == Quantity::Inertia;
    let beyond = |error: f64| error.is_nan() || error > NORMWISE;
    normwise && beyond(deviation.normwise)
        || quantity == Quantity::Torque && !criterion.met(deviation)
}

/// Returns whether the state is out of the scalar's range on purpose.
fn overflows(case: &Extreme, scalar: ScalarType) -> bool {
    case.category.starts_with("f32overflow") && scalar == ScalarType::F32
}

/// Returns whether no result looks like a number where the truth is beyond the range.
fn never_silent(found: &[f64], truth: &[TrueValue]) -> bool {
    let largest = f64::from(f32::MAX);
    let beyond = |truth: &TrueValue| truth.magnitude() > largest;
    !truth.iter().any(beyond) || found.iter().any(|x| !x.is_finite())
}

/// Prints one line a category: τ normwise / per joint, then D normwise.
fn print(scalar: ScalarType, worst: &Table) {
    let categories: BTreeSet<&String> = worst.keys().map(|key| &key.0).collect();
    let mut text = format!("| category | runtime {scalar} | emitted {scalar} |\n|---|---|---|\n");
    for category in categories {
        text += &format!("| {category} |");
        for subject in Subject::ALL {
            let get = |quantity| worst.get(&(category.clone(), subject, quantity));
            text += &match (get(Quantity::Torque), get(Quantity::Inertia)) {
                (None, _) => " out of range |".into(),
                (Some(tau), d) => format!(
                    " {:.1} / {:.1}, {} |",
                    tau.normwise,
                    tau.per_joint,
                    d.map_or("–".into(), |d| format!("{:.1}", d.normwise))
                ),
            };
        }
        text += "\n";
    }
    println!("{text}");
}
