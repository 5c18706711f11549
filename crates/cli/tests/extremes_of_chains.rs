//! The 114 extreme states, f64 and f32, for emitted code, each by its criterion; the model's tests
//! have the generic runtime there.

use std::collections::BTreeMap;

use dalembert_cli::extremes::BoundKind;
use dalembert_cli::measure::{Bench, Code, ENTRY, VECTOR};
use dalembert_codegen::workspace::{JointState, Quantity, Random, RunnableCode, Setup};
use dalembert_codegen::{Function, Request, ScalarType, Start, generate};
use dalembert_model::equations::Formulation;
use dalembert_model::number::{Angle, Rational};
use dalembert_model::robot::{Inertia, Joint, JointKind, Robot};
use serde_json::Value;

use crate::robots as support;

fn held(category: &str) -> BoundKind {
    let starts = |prefixes: &str| prefixes.split(' ').any(|p| category.starts_with(p));
    if starts("static_near_balance tiny_ folded_2link pointmass_tip") {
        BoundKind::Entries
    } else if starts("massratio length snake") {
        BoundKind::Vector
    } else {
        BoundKind::Both
    }
}

/// Arms up to the longest have D, h and c, too, in f32 those of four joints at most; longer ones have
/// torques by the recursion of links alone.
fn emitted(robot: &Robot, scalar: ScalarType, longest: usize) -> Vec<RunnableCode> {
    let n = robot.joints.len();
    let mut functions = vec![Function::InverseDynamics];
    let is_short = n <= longest && (scalar == ScalarType::F64 || n <= 4);
    functions.extend(is_short.then_some(Function::ManipulatorEquation));
    let request = Request {
        scalars: vec![scalar],
        start: match n <= longest {
            true => Start::Auto,
            false => Start::Only(Formulation::NewtonEulerLink),
        },
        ..Request::new(&functions)
    };
    let generated = generate(robot, &request);
    generated.unwrap_or_else(|error| panic!("{error}")).emitted
}

support::daily_and_campaign! {
    categories_meet_their_criteria_in_f64: (SHORT), (LONG);
    categories_meet_their_criteria_in_f32: (SHORT), (LONG);
}

const SHORT: usize = 2;
const LONG: usize = 7;

fn categories_meet_their_criteria_in_f64(longest: usize) {
    categories_meet_their_criteria(ScalarType::F64, longest);
}

fn categories_meet_their_criteria_in_f32(longest: usize) {
    categories_meet_their_criteria(ScalarType::F32, longest);
}

/// Daily, the first case of each category is tried, in either scalar those of every second; then
/// all others, and those of arms that daily are not searched.
fn categories_meet_their_criteria(scalar: ScalarType, longest: usize) {
    let mut robots: Vec<(Robot, Bench, Vec<RunnableCode>)> = Vec::new();
    let mut worst: BTreeMap<String, [f64; 2]> = BTreeMap::new();
    let mut failures = Vec::new();
    let cases = read(scalar);
    assert_eq!(cases.len(), 114);
    let ids = cases.iter().map(|case| &case.id);
    let firsts: Vec<&String> = ids.filter(|id| id.ends_with("_00")).collect();
    let is_tried = |case: &&Extreme| {
        let joints = case.robot.joints.len();
        let place = firsts.iter().position(|first| **first == case.id);
        let turn = usize::from(scalar == ScalarType::F32);
        let is_daily = place.is_some_and(|place| place % 2 == turn);
        match longest {
            SHORT => is_daily,
            _ => !is_daily || (SHORT + 1..=LONG).contains(&joints),
        }
    };
    for case in cases.iter().filter(is_tried) {
        let (robot, state) = (&case.robot, &case.state);
        let place = robots.iter().position(|(known, ..)| known == robot);
        let known = place.unwrap_or_else(|| {
            let bench = Bench::new(Setup::whole(robot));
            robots.push((robot.clone(), bench, emitted(robot, scalar, longest)));
            robots.len() - 1
        });
        let (_, bench, emitted) = &robots[known];
        let scales = drawn_like(robot, state);
        for program in emitted {
            let code = Code::emitted(program);
            // The error of a vector is relative to its size at this state.
            let alone = [state.clone()];
            for measurement in bench.measure(&code, &alone, &alone) {
                // Out of the scalar's range on purpose.
                if case.category.starts_with("f32overflow") && scalar == ScalarType::F32 {
                    let truth = bench.truth(program.function, state);
                    let largest = f64::from(f32::MAX);
                    let beyond = truth.iter().any(|x| x.magnitude() > largest);
                    // No result may be finite where the truth is out of range.
                    assert!(!beyond || measurement.overflows, "{}", case.id);
                    continue;
                }
                let held = held(&case.category);
                let is_vector = match measurement.quantity {
                    Quantity::Torque => held != BoundKind::Entries,
                    // D is large somewhere in every state; h and c may vanish.
                    quantity => quantity == Quantity::Inertia,
                };
                let mut entry = 0.0;
                if measurement.quantity == Quantity::Torque {
                    entry = bench.measure(&code, &alone, &scales)[0].entry;
                    let worst = worst.entry(case.category.clone()).or_default();
                    *worst = [worst[0].max(measurement.vector), worst[1].max(entry)];
                }
                let is_off = entry > ENTRY && held != BoundKind::Vector;
                if is_off || is_vector && measurement.vector > VECTOR {
                    failures.push(format!("{} {scalar} {measurement:?} {entry}", case.id));
                }
            }
        }
    }
    for (category, [vector, entry]) in worst {
        println!("{category} {scalar}: {vector:.1} / {entry:.1}");
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

struct Extreme {
    id: String,
    category: String,
    robot: Robot,
    state: JointState,
}

/// Reads the file; parameters and states are rounded to the scalar.
fn read(scalar: ScalarType) -> Vec<Extreme> {
    let json = support::json("../model/tests/data/extremes.json");
    let extreme = |json: &Value| {
        let text = |key: &str| json[key].as_str().unwrap().to_owned();
        Extreme {
            id: text("id"),
            category: text("category"),
            robot: robot(&json["robot"], scalar),
            state: support::given(json).in_scalar(scalar),
        }
    };
    let cases = json["cases"].as_array().unwrap();
    cases.iter().map(extreme).collect()
}

/// Returns the robot with its numbers exactly as they are: no angle is snapped.
fn robot(json: &Value, scalar: ScalarType) -> Robot {
    let column = |key: &str| numbers(&json[key], scalar);
    let [alpha, a, d, offset, mass] = ["alpha", "a", "d", "off", "m"].map(column);
    let kinds = json["types"].as_str().unwrap().chars();
    let joint = |(i, kind): (usize, char)| {
        let tensor = numbers(&json["I"][i], scalar);
        let com = numbers(&json["r"][i], scalar);
        Joint {
            kind: match kind {
                'R' => JointKind::Revolute,
                _ => JointKind::Prismatic,
            },
            alpha: match json["sa"][i].as_f64().zip(json["ca"][i].as_f64()) {
                Some(pair) => right_angle(pair),
                None => radians(alpha[i]),
            },
            a: exact(a[i]),
            d: exact(d[i]),
            theta: radians(offset[i]),
            mass: exact(mass[i]),
            com: [0, 1, 2].map(|axis| exact(com[axis])),
            inertia: Inertia::of(std::array::from_fn(|k| exact(tensor[k]))),
            ..Joint::default()
        }
    };
    let gravity = column("g");
    Robot {
        name: "extreme".into(),
        gravity: [0, 1, 2].map(|axis| exact(gravity[axis])),
        joints: kinds.enumerate().map(joint).collect(),
        ..Robot::default()
    }
}

fn right_angle(pair: (f64, f64)) -> Angle {
    let pairs = [(0.0, 1.0), (1.0, 0.0), (0.0, -1.0), (-1.0, 0.0)];
    let turns = pairs.iter().position(|known| *known == pair);
    Angle::right_angles(turns.expect("a right angle") as i64)
}

fn radians(value: f64) -> Angle {
    Angle::Radians(exact(value)).canonical()
}

fn exact(value: f64) -> Rational {
    Rational::from_float(value).unwrap()
}

fn numbers(json: &Value, scalar: ScalarType) -> Vec<f64> {
    let numbers = support::numbers(json).into_iter();
    numbers.map(|x| scalar.nearest(x)).collect()
}

/// Draws 1000 states within the magnitudes of a state: the largest |q|, |q̇| and |q̈| of all joints
/// of the same kind.
fn drawn_like(robot: &Robot, state: &JointState) -> Vec<JointState> {
    let mut random = Random::new(0x7a11);
    let mut within = |values: &[f64]| -> Vec<f64> {
        let kinds = robot.joints.iter().map(|joint| joint.kind);
        let pairs: Vec<(JointKind, f64)> = kinds.zip(values.iter().copied()).collect();
        let most = |kind| {
            let same = pairs.iter().filter(|(joint_kind, _)| *joint_kind == kind);
            same.fold(0.0f64, |most, (_, x)| most.max(x.abs()))
        };
        let draw = |(kind, _): &(JointKind, f64)| most(*kind) * (2.0 * random.unit() - 1.0);
        pairs.iter().map(draw).collect()
    };
    let mut drawn = || JointState::new(|argument| within(state.entries(argument)));
    (0..1000).map(|_| drawn()).collect()
}
