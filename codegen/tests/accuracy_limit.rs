//! The limit on rounding errors: what it refuses, what is taken instead, and
//! that a robot's last digits do not decide.

use crate::support::{arm_file, dose, read_robot};
use dalembert_codegen::workspace::{Rounding, Runtime, Setup, seeded};
use dalembert_codegen::{Function, GeneratedFunction, Prefer, Request, ScalarType, generate};

/// Returns τ by a quick search.
fn torques(source: &str, prefer: Prefer) -> GeneratedFunction {
    found(source, Function::InverseDynamics, prefer)
}

/// Returns a function by a quick search.
fn found(source: &str, function: Function, prefer: Prefer) -> GeneratedFunction {
    let request = Request {
        scalars: vec![ScalarType::F64],
        prefer,
        ..Request::of(&[function])
    };
    let mut generated = generate(&read_robot(source), &request).unwrap();
    generated.functions.pop().unwrap()
}

/// Returns the file with every mass multiplied.
fn heavier(source: &str, factor: f64) -> String {
    let line = |line: &str| match line.strip_prefix("mass = ") {
        Some(mass) => format!("mass = {:.6}\n", mass.parse::<f64>().unwrap() * factor),
        None => format!("{line}\n"),
    };
    source.lines().map(line).collect()
}

/// An arm whose cheapest program is just about as inaccurate as is allowed.
#[test]
fn neighbours_cost_about_the_same() {
    let file = arm_file("gen3");
    let own = torques(&file, Prefer::Accuracy).counts().operations();
    let neighbours = [
        file.replace("9.81", "9.80665"),
        heavier(&file, 1.01),
        file.replace("9.81", "9.83"),
        heavier(&file, 0.99),
        file.replace("d = -0.0016", "d = -0.0013"),
        file.replace("d = -0.0016", "d = -0.002"),
    ];
    for neighbour in dose(&neighbours, 2) {
        assert_ne!(*neighbour, file);
        let other = torques(neighbour, Prefer::Accuracy).counts().operations();
        assert!(own.abs_diff(other) * 50 <= own, "{own} and {other}");
    }
}

/// The axis offsets of the real arm are smaller still: the limit refuses more,
/// and what it costs is said.
#[test]
fn what_the_limit_costs_is_little_and_said() {
    let file = arm_file("gen3").replace("d = -0.0016", "d = -0.0003501");
    let taken = torques(&file, Prefer::Accuracy);
    let cheapest = torques(&file, Prefer::Operations);
    let refused = taken.refused.unwrap();
    assert_eq!(cheapest.refused, None);
    assert_eq!(cheapest.counts().operations(), refused.counts.operations());
    assert!(refused.error > 4.0 * refused.taken, "{refused:?}");
    let (few, more) = (cheapest.counts().operations(), taken.counts().operations());
    assert!(few < more && (more - few) * 50 <= few, "{few} and {more}");
}

/// The cheapest D of this arm breaks the limit in one entry, and what keeps it in all of them
/// costs an operation more and has a larger largest error: the cheapest is taken, and nothing
/// is said of it.
#[test]
fn what_is_cheaper_and_more_exact_is_taken() {
    let file = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../gallery/robots/j2s7s300.toml"
    );
    let file = std::fs::read_to_string(file).unwrap();
    let [taken, cheapest] = [Prefer::Accuracy, Prefer::Operations]
        .map(|prefer| found(&file, Function::Inertia, prefer));
    assert_eq!(taken.counts(), cheapest.counts());
    assert_eq!(taken.refused, None);
}

/// The estimate is of the size of the worst error that f32 code shows.
#[test]
fn the_estimate_is_what_is_observed() {
    for name in ["gen3", "scara", "gantry", "rprpr", "general6r"] {
        let robot = read_robot(&arm_file(name));
        let request = Request {
            scalars: vec![ScalarType::F32],
            ..Request::of(&[Function::InverseDynamics])
        };
        let generated = generate(&robot, &request).unwrap();
        let program = &generated.functions[0].program;
        let estimate = Rounding::estimate(&Setup::whole(&robot), program).worst();
        let runtime = Runtime::in_scene(Setup::whole(&robot));
        let largest = |values: &[f64]| values.iter().fold(0.0, |max: f64, x| max.max(x.abs()));
        let mut observed = 0.0f64;
        for state in seeded(&robot, 300, 7) {
            let state = state.in_scalar(ScalarType::F32);
            let truth = runtime.run(Function::InverseDynamics, &state);
            let found = generated.emitted[0].run(&state);
            let errors: Vec<f64> = found.iter().zip(&truth).map(|(x, y)| x - y).collect();
            let error = largest(&errors) / largest(&truth);
            observed = observed.max(error / ScalarType::F32.unit_roundoff());
        }
        let ratio = estimate / observed;
        assert!(
            (0.3..3.0).contains(&ratio),
            "{name}: estimated {estimate}, observed {observed}"
        );
    }
}
