//! An arm of which three joints follow others: one coordinate each with their leaders, in code and
//! languages, against Pinocchio. `values` has its scenes and arguments, `refused` what it cannot.

use dalembert_codegen::workspace::{
    BOUND, Columns, JointState, Quantity, Reference, Runtime, Setup, TrueValue,
};
use dalembert_codegen::{Function, Language};
use serde_json::Value;

use crate::support::case::Case;
use crate::support::{self, numbers};

/// The bound against the file, normwise.
const FILE: f64 = 1e-12;

/// Returns what can be had of an arm whose joints follow others.
fn functions() -> Vec<Function> {
    let all = Function::ALL.into_iter();
    // Of base parameters there are none: its axes are turned against each other anyhow.
    let is_linear = |function: &Function| function.columns() != Columns::None;
    all.filter(|function| function.takes_followers() && !is_linear(function))
        .collect()
}

/// Returns the largest entry of what a function sums: its result, and itself without the wished
/// velocity or acceleration. Of `passivity` these cancel, 160 N·m to 0.2, and what rounding costs is of
/// them: it is below 5 u of the largest part at 60 000 random states, and up to 167 u of the sum.
fn size_of_parts(truth: &Reference, function: Function, state: &JointState) -> f64 {
    let parts = [(1.0, 1.0), (1.0, 0.0), (0.0, 1.0), (0.0, 0.0)].map(|(by_v, by_a)| {
        let mut part = state.clone();
        part.v.iter_mut().for_each(|v| *v *= by_v);
        part.a.iter_mut().for_each(|a| *a *= by_a);
        let entries = truth.run(function, &part);
        entries.iter().map(TrueValue::magnitude).fold(0.0, f64::max)
    });
    parts.into_iter().fold(0.0, f64::max)
}

/// Values, errors in both scalars, and arguments as long as there are
/// coordinates, of every output; half of them where tests are not optimised.
#[test]
fn the_code_gives_what_pinocchio_gives() {
    let folder = env!("CARGO_MANIFEST_DIR");
    let file = format!("{folder}/../import/tests/data/wafer.golden.json");
    let json: Value = serde_json::from_str(&std::fs::read_to_string(file).unwrap()).unwrap();
    let (robot, all) = (
        support::read_robot(&support::arm_file("wafer")),
        functions(),
    );
    let (runtime, setup) = (Runtime::new(&robot), Setup::whole(&robot));
    let truth = Reference::new(&setup);
    let every = if cfg!(debug_assertions) { 2 } else { 1 };
    let mut compared = 0;
    for &function in all.iter().step_by(every) {
        let generated = support::one(&robot, function);
        assert!(generated.text().contains("pub const N: usize = 4;"));
        assert_eq!(generated.functions[0].program.joints, 4);
        // The runtime's recursion errs more here than the code does.
        for emitted in &generated.emitted {
            let u = emitted.scalar.unit_roundoff();
            for state in setup.states(30, 3) {
                let state = state.in_scalar(emitted.scalar);
                let (found, known) = (emitted.run(&state), truth.run(function, &state));
                let granted = runtime.granted(function, &state);
                let mut start = 0;
                for &quantity in function.quantities() {
                    let range = start..start + quantity.len(emitted.sizes);
                    start = range.end;
                    let known = &known[range.clone()];
                    let largest = |most: f64, x: f64| most.max(x);
                    let size = match quantity {
                        Quantity::Passivity => size_of_parts(&truth, function, &state),
                        _ => known.iter().map(TrueValue::magnitude).fold(0.0, largest),
                    };
                    let errors = known.iter().zip(&found[range]);
                    let error = errors.map(|(known, x)| known.error(*x)).fold(0.0, largest);
                    let units = error / (size * granted.to(quantity) * u).max(f64::MIN_POSITIVE);
                    assert!(units <= BOUND, "{quantity:?} {}: {units}", emitted.scalar);
                }
            }
        }
        let emitted = &generated.emitted[0];
        for known in json["states"].as_array().unwrap() {
            let state = support::given(known);
            let found = emitted.run(&state);
            let mut rest = found.as_slice();
            for &quantity in function.quantities() {
                let (own, others) = rest.split_at(quantity.len(emitted.sizes));
                rest = others;
                let (quantity, own) = (quantity.as_given(own, &state.qd).0, own);
                let key = quantity
                    .given()
                    .filter(|_| quantity != Quantity::Christoffel);
                let Some(known) = key.and_then(|key| known.get(key)).map(numbers) else {
                    continue;
                };
                let own = match own.len() == known.len() {
                    true => own.to_vec(),
                    false => Quantity::Christoffel.as_given(own, &state.qd).1,
                };
                let size = known.iter().fold(1e-3, |most: f64, x| most.max(x.abs()));
                let pairs = own.iter().zip(&known);
                let error = pairs.fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()));
                let error = error / size / runtime.granted(function, &state).to(quantity);
                assert!(error <= FILE, "{quantity:?}: {error:e}");
                compared += 1;
            }
        }
    }
    assert!(compared >= 5 * 23 / every, "{compared}");
}

/// A PUMA whose forearm keeps its direction, as a parallelogram has it: base parameters, and
/// less work than with one joint more.
#[test]
fn a_parallelogram_costs_less_than_free_joints() {
    let free = support::source("puma560", "");
    let tied = free.replace(
        "name = \"elbow\"\n",
        "name = \"elbow\"\nmimic = { joint = 2, multiplier = -1 }\n",
    );
    let [free, tied] = [&free, &tied].map(|source| support::read_robot(source));
    assert_eq!(tied.joints.len(), 5);
    let runtime = Runtime::new(&tied);
    let states = Setup::whole(&tied).states(30, 9);
    for function in [
        Function::InverseDynamics,
        Function::Inertia,
        Function::ForwardDynamics,
        Function::InverseDynamicsDerivatives,
        Function::OperationalInertia,
        Function::Regressor,
        Function::PassivityRegressor,
    ] {
        let [one, other] = [&free, &tied].map(|robot| support::one(robot, function));
        let [one, all] = [&one, &other].map(|own| own.functions[0].counts().operations());
        assert!(3 * all < 2 * one, "{function}: {all} against {one}");
        if function.columns() != Columns::None {
            continue;
        }
        support::rounds_well(&other.emitted, &runtime, &states, function);
    }
}

#[test]
fn other_languages_have_as_many_entries() {
    for language in [Language::C, Language::Cuda] {
        let mut case = Case::new("wafer", "", "outputs: inverse_dynamics");
        case.request.language = language;
        let text = case.generated().text();
        let has_four = text.contains("q[4]") || text.contains("q[static 4]");
        assert!(has_four && text.contains("-2 q3"), "{text}");
    }
}
