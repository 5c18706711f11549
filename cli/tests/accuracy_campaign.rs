//! Every output of robots that nobody chose stays below 100 u, f64 and f32, of the
//! truth in 76 digits; what inverts D below 100 u times D's condition.
//!
//! An error is that of a quantity's entries against its largest entry, or a sixteenth
//! of the largest met where that is more. The whole campaign is for releases: `cargo
//! test --release -p dalembert-cli --test all -- accuracy_campaign --include-ignored
//! --nocapture` prints the worst of each quantity.

use std::collections::BTreeMap;

use crate::robots::draw::robots;
use dalembert_codegen::workspace::{
    BOUND, Emitted, Granted, Quantity, Reference, Runtime, SEED, SceneRobot, TrueValue, seeded,
};
use dalembert_codegen::{Function, GenerateError, Request, ScalarType, generate};

/// States a robot.
const STATES: usize = 30;

/// A state counts relative to at least this part of the largest that is met.
const LEAST_PART: f64 = 1.0 / 16.0;

/// The worst error of a quantity in units of u, and how many robots had it.
type Worst = BTreeMap<(Quantity, ScalarType), (f64, usize)>;

/// Runs so many outputs a robot, in turn, that each is met by robots of every length.
fn campaign(count: usize, each: usize, longest: usize) -> Worst {
    let mut worst = Worst::new();
    // A load is of functions that take it.
    let all = Function::ALL.into_iter();
    let outputs: Vec<Function> = all.filter(|f| *f != Function::Load).collect();
    let mut next = 0;
    for (seed, robot, _) in robots(count, 0xacc0) {
        let n = robot.joints.len();
        if n > longest {
            continue;
        }
        let truth = Reference::new(&SceneRobot::whole(&robot));
        let runtime = Runtime::new(&robot);
        for _ in 0..each {
            let function = outputs[next % outputs.len()];
            next += 1;
            let request = Request::of(&[function]);
            let what = format!("seed {seed}, {n} joints, {function}");
            let generated = match generate(&robot, &request) {
                Ok(generated) => generated,
                // An arm whose D is singular in every state, or whose base parameters
                // cannot be written down: refused by name, which other tests are about.
                Err(GenerateError::Singular { .. } | GenerateError::Base(..)) => continue,
                Err(error) => panic!("{what}: {error}"),
            };
            for emitted in &generated.emitted {
                let scalar = emitted.scalar;
                let states = seeded(&robot, STATES, SEED ^ seed);
                let states = states.into_iter().map(|state| state.in_scalar(scalar));
                let cases = states.map(|state| Case {
                    found: emitted.run(&state),
                    truth: truth.run(function, &state),
                    vanishing: emitted.vanishing().collect(),
                    granted: runtime.granted(function, &state),
                });
                for (quantity, error) in errors(emitted, &cases.collect::<Vec<_>>()) {
                    assert!(
                        error <= BOUND,
                        "{what}, {quantity:?} in {scalar}: {error} u"
                    );
                    let (most, robots) = worst.entry((quantity, scalar)).or_default();
                    *most = most.max(error);
                    *robots += 1;
                }
            }
        }
    }
    worst
}

/// What was computed at a state, what is true, and the condition that excuses it.
struct Case {
    found: Vec<f64>,
    truth: Vec<TrueValue>,
    /// `true` of what was proved to vanish: it does so, and not within 76 digits only.
    vanishing: Vec<bool>,
    granted: Granted,
}

/// Returns the worst error of each quantity, in units of u.
fn errors(emitted: &Emitted, cases: &[Case]) -> Vec<(Quantity, f64)> {
    let mut start = 0;
    let quantities = emitted.function.quantities().iter();
    let each = quantities.map(|&quantity| {
        let range = start..start + quantity.len(emitted.sizes);
        start = range.end;
        let size = |case: &Case| {
            let entries = range.clone().filter(|&index| !case.vanishing[index]);
            let sizes = entries.map(|index| case.truth[index].magnitude());
            sizes.fold(0.0, f64::max)
        };
        let least = LEAST_PART * cases.iter().map(size).fold(0.0, f64::max);
        let error = |case: &Case| {
            let off = |index: usize| match case.vanishing[index] {
                true => case.found[index].abs(),
                false => case.truth[index].error(case.found[index]),
            };
            match range.clone().map(off).fold(0.0, f64::max) {
                0.0 => 0.0,
                off => off / (size(case).max(least) * case.granted.to(quantity)),
            }
        };
        let worst = cases.iter().map(error).fold(0.0, f64::max);
        (quantity, worst / emitted.scalar.unit_roundoff())
    });
    each.collect()
}

#[test]
#[cfg_attr(debug_assertions, ignore = "a minute: in release mode")]
fn short_arms_are_accurate() {
    let worst = campaign(24, 6, 3);
    assert!(worst.len() > 40, "{}", worst.len());
}

#[test]
#[ignore = "a quarter of an hour in release mode"]
fn two_hundred_robots_are_accurate() {
    let worst = campaign(200, 4, 7);
    for ((quantity, scalar), (error, robots)) in &worst {
        println!("{quantity:?} {scalar}: {error:.1} u, {robots} robots");
    }
    assert!(worst.len() > 50, "{}", worst.len());
}
