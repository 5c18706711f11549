//! The table of extremes on whole robots, and functions that divide near a singular D.

use dalembert_cli::extremes::cases::Change;
use dalembert_cli::extremes::{Row, Verdict, divided, inside, nearest_to_singular, torques};
use dalembert_cli::measure::{Bench, Code, VECTOR};
use dalembert_codegen::workspace::{Literal, Node, RuntimeParameter, Setup, testing::seeded};
use dalembert_codegen::{Function, Request, generate};
use dalembert_model::number::{Rational, Rounded};
use dalembert_model::read;
use dalembert_model::robot::Robot;

use crate::robots as support;

const STATES: usize = 10;

fn all_good(rows: &[Row]) {
    let mut verdicts = rows.iter().map(|row| row.verdict);
    let are_good = verdicts.all(|verdict| verdict == Verdict::Good);
    assert!(are_good, "{rows:#?}");
}

#[test]
fn planted_faults_are_found() {
    let robot = support::robot("puma560");
    let error = |other: &Robot| {
        let request = Request::new(&[Function::InverseDynamics]);
        let generated = generate(other, &request).unwrap();
        let bench = Bench::new(Setup::whole(&robot));
        let states = seeded(&robot, STATES, 1);
        let measurements = bench.measure(&Code::emitted(&generated.emitted[0]), &states, &states);
        assert_eq!(measurements.len(), 1);
        measurements[0].vector
    };
    let right = error(&robot);
    assert!(right < 20.0, "{right}");
    let mut heavy = robot.clone();
    let part = Rational::new(1.into(), 100_000_000_000_000u64.into());
    heavy.joints[2].mass *= Rational::from_integer(1.into()) + part;
    let mass = error(&heavy);
    assert!(mass > 2.0 * right.max(20.0), "{mass}");
}

/// The cases take each limb to its extreme: in the order of the file the last links are those of
/// one limb.
#[test]
fn limbs_are_taken_to_their_extremes() {
    let robot = support::robot("two_legs");
    let masses = |change: Change| -> Vec<f64> {
        let changed = change.apply(&robot).unwrap();
        let bodies = changed.bodies();
        let masses = bodies.map(|body| f64::nearest_rational(&body.mass));
        masses.collect()
    };
    let whole = masses(Change::None);
    let mut light = whole.clone();
    (light[2], light[4]) = (1e-3, 1e-3);
    assert_eq!(masses(Change::LightTips), light);
    (light[2], light[4]) = (0.0, 0.0);
    assert_eq!(masses(Change::Massless(1)), light);
    assert_eq!(masses(Change::MasslessBase), [&[0.0], &whole[1..]].concat());
    let ratio = masses(Change::Masses(-6));
    assert!((ratio[2] / whole[2] - 1e-6).abs() < 1e-18);
    assert_eq!([ratio[1], ratio[3]], [whole[1], whole[3]]);
    let long = Change::Lengths(6).apply(&robot).unwrap();
    let placed = |robot: &Robot| robot.joints[1].place.clone().unwrap().placement.xyz[1].clone();
    let million = Rational::from_integer(1_000_000.into());
    assert_eq!(placed(&long), placed(&robot) * million);
    let fixed = Change::MasslessBase.apply(&support::robot("puma560"));
    assert!(fixed.is_none());
    let request = Request::new(&[Function::InverseDynamics]);
    let rows = torques(&robot, &request, STATES).unwrap();
    for case in [
        "tips of 1 g",
        "massless base",
        "lengths, long hand",
        "static near balance",
    ] {
        assert!(rows.iter().any(|row| row.case == case), "{case}");
    }
    all_good(&rows);
}

/// A joint that feels no weight has next to no load there, as the difference of others' weights.
#[test]
fn entries_next_to_zero_count_relative_to_the_weight() {
    let source = include_str!("../../../codegen/tests/data/rprpr.toml");
    let robot = read::parse(source).unwrap().robot;
    let request = Request::new(&[Function::InverseDynamics]);
    let rows = torques(&robot, &request, STATES).unwrap();
    let tiny = rows.into_iter().filter(|row| row.case == "tiny");
    all_good(&tiny.collect::<Vec<Row>>());
}

#[test]
fn no_number_fails_inside_the_limits() {
    let robot = support::robot("planar2r");
    let generated = generate(&robot, &Request::new(&[Function::Gravity])).unwrap();
    let mut broken = generated.emitted[0].clone();
    let output = broken.text.dag.outputs[0];
    broken.text.dag.nodes[output.index()] = Node::Constant(Literal(f64::NAN));
    let bench = Bench::new(Setup::whole(&robot));
    let rows = inside(&bench, [&broken].into_iter(), &seeded(&robot, STATES, 1));
    assert_eq!(rows[0].verdict, Verdict::Failed);
}

/// Two equal rods: scaled to a unit diagonal, D has the condition number (1 + r)/(1 − r) with
/// r = D_12/√(D_11 D_22), which is largest where the arm is stretched out.
#[test]
fn the_search_finds_where_two_rods_are_nearest_to_singular() {
    let robot = support::robot("planar2r");
    let bench = Bench::new(Setup::whole(&robot));
    let (condition, q) = nearest_to_singular(&bench);
    let r = (5.0 / 6.0) / (8.0f64 / 9.0).sqrt();
    let expected = (1.0 + r) / (1.0 - r);
    assert!((condition / expected - 1.0).abs() < 1e-9, "{condition}");
    assert!(q[1].abs() < 1e-4, "{q:?}");
    let request = Request::new(&Function::of(&robot));
    all_good(&divided(&robot, &request, STATES).unwrap());
}

support::daily_and_campaign! {
    every_argument_has_a_value_at_the_extremes: (&[
        (&[PAYLOAD, GRAVITY], &[Function::ForwardDynamics, Function::InverseDynamics]),
    ]), (&[
        (&[GRAVITY], &[Function::Gravity]),
        (&[PAYLOAD], &[Function::InverseDynamics]),
    ]);
}

const PAYLOAD: RuntimeParameter = RuntimeParameter::Payload;
const GRAVITY: RuntimeParameter = RuntimeParameter::Gravity;

/// Tries lists of arguments, each with functions that take some of them.
fn every_argument_has_a_value_at_the_extremes(cases: &[(&[RuntimeParameter], &[Function])]) {
    use Function::{ForwardDynamics, InverseDynamics};
    let robot = support::robot("planar2r");
    for (parameters, functions) in cases {
        let request = Request {
            parameters: parameters.to_vec(),
            ..Request::new(functions)
        };
        for (function, rows) in [
            (InverseDynamics, torques(&robot, &request, 3).unwrap()),
            (ForwardDynamics, divided(&robot, &request, 3).unwrap()),
        ] {
            let what = format!("{parameters:?} {functions:?} {function}");
            assert_eq!(!rows.is_empty(), functions.contains(&function), "{what}");
            for row in &rows {
                assert!(row.verdict != Verdict::Failed, "{what}: {row:?}");
                assert_eq!(row.worst.as_ref().unwrap().function, function, "{what}");
            }
        }
    }
}

fn points(masses: [&str; 2]) -> Robot {
    let joint = |mass: &str| {
        format!(
            "[[joint]]\nkind = \"revolute\"\na = 1\nmass = {mass}\ncom = [0, 0, 0]\n\
             inertia = [0, 0, 0, 0, 0, 0]\nlimits = {{ position = [\"-pi\", \"pi\"] }}\n"
        )
    };
    let head = "name = \"points\"\nconvention = \"standard\"\ngravity = [0, -9.81, 0]\n";
    let source = head.to_owned() + &masses.map(joint).concat();
    support::read_robot(&source)
}

/// Stretched out, both joints move the second mass alike, and the first mass, a ten-thousandth
/// of it, adds little. As many digits are lost as the condition number says, and no more.
#[test]
fn what_is_lost_next_to_singular_is_the_condition() {
    let robot = points(["1e-4", "1"]);
    let request = Request::new(&Function::of(&robot));
    let rows = divided(&robot, &request, STATES).unwrap();
    all_good(&rows);
    let worst = rows.iter().flat_map(|row| &row.worst);
    let losses = worst.map(|worst| worst.vector * worst.condition);
    let lost = losses.fold(0.0, f64::max);
    assert!(lost > VECTOR, "{lost} u: nothing was near singular");
}
