//! τ = Y π and D a + C v + c + b∘v = Y π: of every arm, in both scalars, in scenes, with
//! as few columns as there can be; and what a wrong combination is refused with.

use dalembert_codegen::workspace::{
    BOUND, BaseParameters, Disproof, Parameter, Quantity, Runtime, Setup, prove_base, seeded,
};
use dalembert_codegen::{Function, Generated, Language};
use dalembert_model::equations::Arm;
use dalembert_model::number::{Exact, Rational, Rounded};
use dalembert_model::scalar::Scalar;

use crate::support;
use crate::support::case::Case;

const ROBOTS: [&str; 6] = [
    "planar2r", "planar3r", "puma560", "stanford", "ur10", "panda",
];

/// A function that is linear in the parameters.
#[derive(Clone, Copy)]
struct Linear {
    regressor: Function,
    quantity: Quantity,
    /// The constant with π.
    constant: &'static str,
    /// Y π
    sum: Function,
}

const TORQUES: Linear = Linear {
    regressor: Function::Regressor,
    quantity: Quantity::BaseRegressor,
    constant: "BASE_PARAMETERS",
    sum: Function::InverseDynamics,
};

const PASSIVITY: Linear = Linear {
    regressor: Function::PassivityRegressor,
    quantity: Quantity::PassivityRegressor,
    constant: "PASSIVITY_PARAMETERS",
    sum: Function::Passivity,
};

/// Returns a regressor's case.
fn case(linear: Linear, robot: &str, more: &str) -> Case {
    // A planar arm with rotors and friction, and with friction of its second joint.
    let with = |drives: [&str; 2]| {
        let mut parts = support::source("planar2r", more).replace("[[joint]]\n", "[[joint]]\n@");
        for drive in drives {
            parts = parts.replacen('@', drive, 1);
        }
        parts
    };
    let scene = if more.contains("[scene.some]") {
        "; scene: some"
    } else {
        ""
    };
    let source = match robot {
        "driven" => with([
            "armature = 0.2\nviscous = \"2/7\"\n",
            "armature = 0.3\nviscous = \"3/7\"\n",
        ]),
        "rubbed" => with(["", "viscous = \"1/7\"\n"]),
        robot => Case::source(robot, more),
    };
    Case::of(&source, &format!("outputs: {}{scene}", linear.regressor))
}

/// Returns the constants with π of the text, a module each.
fn printed(linear: Linear, text: &str) -> Vec<Vec<f64>> {
    let declared = format!("pub const {}: [", linear.constant);
    let constants = text.split(&declared).skip(1);
    let constants = constants.map(|rest| {
        let (_, rest) = rest.split_once("= [\n").unwrap();
        let (values, _) = rest.split_once("];").unwrap();
        let values = values.split(',').map(str::trim);
        let values = values.filter(|value| !value.is_empty());
        values.map(|value| value.parse().unwrap()).collect()
    });
    constants.collect()
}

/// Returns the values of π that functions of a header write, a scalar each.
fn printed_in_c(text: &str) -> Vec<Vec<f64>> {
    let functions = text.lines().enumerate();
    let functions =
        functions.filter(|(_, line)| line.starts_with("static ") && line.contains(" pi["));
    let values = functions.map(|(head, _)| {
        let body = text.lines().skip(head + 2).take_while(|line| *line != "}");
        let values = body.enumerate().map(|(index, line)| {
            let value = line
                .trim()
                .strip_prefix(&format!("pi[{index}] = "))
                .unwrap();
            let value = value.strip_suffix(';').unwrap();
            value.trim_end_matches('F').parse().unwrap()
        });
        values.collect()
    });
    values.collect()
}

/// A header has the values that a module has, in both scalars, by a name that its text says.
#[test]
fn headers_have_the_same_parameters() {
    for linear in [TORQUES, PASSIVITY] {
        for name in ["planar2r", "stanford"] {
            let mut case = case(linear, name, "");
            let expected = printed(linear, &case.generated().text());
            assert_eq!(expected.len(), 2);
            for language in [Language::C, Language::Cuda] {
                case.request.language = language;
                let text = case.generated().text();
                assert_eq!(printed_in_c(&text), expected, "{name}");
                let said = format!("and `{name}_{}` is", linear.constant.to_lowercase());
                assert!(text.contains(&said) && !text.contains(linear.constant));
            }
        }
    }
}

/// Returns the rank of Y over all links' parameters, in f64 from the runtime: elimination
/// with the largest pivot there is, columns brought to one length first.
fn rank(runtime: &Runtime, setup: &Setup) -> usize {
    let rows = setup.rows().len();
    let columns = 10 * setup.joints().len();
    let states = seeded(setup.robot(), columns / rows + 10, 0x72616e6b);
    let values = states
        .iter()
        .flat_map(|state| runtime.run(Function::FullRegressor, state));
    let values: Vec<f64> = values.collect();
    let mut matrix: Vec<Vec<f64>> = (0..columns)
        .map(|column| {
            values
                .iter()
                .skip(column)
                .step_by(columns)
                .copied()
                .collect()
        })
        .collect();
    let length = |column: &Vec<f64>| column.iter().map(|x| x * x).sum::<f64>().sqrt();
    for column in &mut matrix {
        let length = length(column);
        // What is dust stays dust.
        column.iter_mut().for_each(|x| *x /= length.max(1e-3));
    }
    let mut rank = 0;
    loop {
        let Some(largest) = matrix.iter().map(length).reduce(f64::max) else {
            return rank;
        };
        if largest < 1e-9 {
            return rank;
        }
        let at = matrix
            .iter()
            .position(|column| length(column) == largest)
            .unwrap();
        let pivot = matrix.swap_remove(at);
        rank += 1;
        for column in &mut matrix {
            let along = column.iter().zip(&pivot).map(|(x, y)| x * y).sum::<f64>();
            let factor = along / (largest * largest);
            column
                .iter_mut()
                .zip(&pivot)
                .for_each(|(x, y)| *x -= factor * y);
        }
    }
}

/// Compares the emitted Y times the printed π with the runtime's torques, relative to
/// what the sums are made of; with as many columns as the rank and so many of drives.
#[track_caller]
fn check(linear: Linear, robot: &str, more: &str, drives: usize) -> Generated {
    let case = case(linear, robot, more);
    let setup = case.request.setup(case.robot()).unwrap();
    let base = rank(&Runtime::in_scene(setup.clone()), &setup) + drives;
    with_columns(linear, &case, base)
}

/// Compares the same with so many columns.
#[track_caller]
fn with_columns(linear: Linear, case: &Case, base: usize) -> Generated {
    let (robot, generated) = (case.robot(), case.generated());
    let (runtime, states) = case.runtime(50, 0x7275);
    let parameters = printed(linear, &generated.text());
    assert_eq!(generated.emitted.len(), 2);
    for (emitted, pi) in generated.emitted.iter().zip(&parameters) {
        assert_eq!(pi.len(), base, "{}", robot.name);
        assert_eq!(emitted.sizes.base, base);
        for state in &states {
            let state = state.in_scalar(emitted.scalar);
            let tau = runtime.run(linear.sum, &state);
            let y = emitted.run(&state);
            let u = emitted.scalar.unit_roundoff();
            assert_eq!(y.len(), tau.len() * base);
            let mut errors = Vec::new();
            let mut size = 0.0f64;
            for (row, tau) in y.chunks(base.max(1)).zip(&tau) {
                let terms = || row.iter().zip(pi).map(|(y, pi)| y * pi);
                errors.push((terms().sum::<f64>() - tau).abs());
                size = size.max(terms().map(f64::abs).sum());
            }
            for error in errors {
                let most = BOUND * u * size;
                assert!(
                    error <= most,
                    "{} {}: {error} {most}",
                    robot.name,
                    emitted.scalar
                );
            }
        }
    }
    generated
}

/// Known numbers of base parameters: 36 of the PUMA (Gautier, Khalil 1990), 43
/// of the Panda (Gaz et al. 2019), and 3 a link in the plane.
#[test]
fn torques_of_the_checked_in_robots() {
    // Upper bounds on operations of a quick search; their sum only ever goes down.
    let most = [22, 50, 599, 526, 496, 977];
    let bases = [6, 9, 36, 33, 36, 43];
    for ((name, base), most) in ROBOTS.into_iter().zip(bases).zip(most) {
        let generated = check(TORQUES, name, "", 0);
        assert_eq!(generated.emitted[0].sizes.base, base);
        let found = generated.functions[0].counts().operations();
        assert!(found <= most, "{name}: {found}");
    }
}

/// Slides before, between and after what turns; odd angles.
#[test]
fn torques_of_other_arms() {
    for name in ["scara", "gantry", "rprpr"] {
        check(TORQUES, name, "", 0);
        check(PASSIVITY, name, "", 0);
    }
}

/// What one velocity more costs; no more columns.
#[test]
fn passivity_of_the_checked_in_robots() {
    let most = [23, 51, 653];
    for (name, most) in ["planar2r", "planar3r", "puma560"].into_iter().zip(most) {
        let generated = check(PASSIVITY, name, "", 0);
        let found = generated.functions[0].counts().operations();
        assert!(found <= most, "{name}: {found}");
    }
}

/// Rotors and friction have columns of their own, but for the first rotor, which
/// is felt as the first link's inertia is.
#[test]
fn drives_have_columns() {
    for linear in [TORQUES, PASSIVITY] {
        let text = check(linear, "driven", "", 3).text();
        for said in ["Izz1 + m2 + armature1 |", "| armature2 |", "| viscous1 |"] {
            assert!(text.contains(said), "{said}: {text}");
        }
    }
}

/// What a scene holds still or does not ask for needs fewer parameters.
#[test]
fn torques_in_scenes() {
    for scene in [
        "lock = { 1 = 0, 4 = 0, 6 = \"pi/6\" }",
        "joints = [3, 1]\nvelocity = \"zero\"",
        "lock = { 5 = \"pi/4\" }\njoints = [5, 2]",
        "velocity = \"zero\"\nacceleration = \"zero\"",
    ] {
        check(TORQUES, "puma560", &format!("\n[scene.some]\n{scene}\n"), 0);
    }
}

/// Rates that are zero are those of the arm, not those wished for: at rest friction and
/// inertias have columns, which torques at rest have not.
#[test]
fn passivity_in_scenes() {
    let still = "\n[scene.some]\nvelocity = \"zero\"\nacceleration = \"zero\"\n";
    with_columns(TORQUES, &case(TORQUES, "rubbed", still), 4);
    with_columns(PASSIVITY, &case(PASSIVITY, "rubbed", still), 7);
    check(PASSIVITY, "rubbed", "\n[scene.some]\njoints = [2]\n", 1);
}

/// π from the combinations is the torques' π exactly, and a combination that is
/// off in one coefficient, or that lacks a column, is refused by the parameter.
#[test]
fn wrong_combinations_are_refused() {
    let robot = support::robot("puma560");
    let setup = Setup::whole(&robot);
    let base = setup.base(TORQUES.quantity).unwrap();
    assert_eq!(prove_base(setup.task(TORQUES.regressor), base), Ok(()));
    let arm = Arm::from_robot(&robot, &mut Exact::clone);
    let printed = &printed(TORQUES, &case(TORQUES, "puma560", "").generated().text())[0];
    let values: Vec<f64> = base.values(&arm).iter().map(f64::nearest).collect();
    assert_eq!(*printed, values);

    let refused = |wrong: &BaseParameters, parameter: Parameter| {
        let parameter = parameter.to_string();
        let expected = Err(Disproof::Dependence { parameter });
        for linear in [TORQUES, PASSIVITY] {
            assert_eq!(prove_base(setup.task(linear.regressor), wrong), expected);
        }
    };
    for column in [0, 8, 20, 35] {
        let mut wrong = base.clone();
        let (parameter, factor) = wrong.combinations[column].last_mut().unwrap();
        let tiny = Rational::new(1.into(), 1_000_000_000.into());
        *factor = factor.add(&Exact::from(tiny));
        let parameter = *parameter;
        refused(&wrong, parameter);
    }
    let mut short = base.clone();
    let (parameter, _) = short.combinations[35].pop().unwrap();
    refused(&short, parameter);
}
