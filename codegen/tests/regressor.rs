//! τ = Y π and D a + C v + c + b∘v = Y π: of every arm, in both scalars, in scenes, with
//! as few columns as there can be; and what a wrong combination is refused with.

use dalembert_codegen::workspace::{
    BOUND, BaseParameters, Disproof, Parameter, Quantity, Runtime, SceneRobot, ToleranceError,
    Unbounded, prove_base, seeded,
};
use dalembert_codegen::{Function, GenerateError, Generated, Language, Request};
use dalembert_model::equations::Arm;
use dalembert_model::number::{Angle, Exact, Rational, Rounded};
use dalembert_model::robot::{Position, Robot};
use dalembert_model::scalar::Scalar;
use dalembert_model::scene::Scene;

use crate::support;

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

fn generate(linear: Linear, robot: &Robot, scene: Option<&Scene>) -> Generated {
    let request = Request {
        scene: scene.cloned(),
        ..Request::of(&[linear.regressor])
    };
    dalembert_codegen::generate(robot, &request).unwrap_or_else(|error| panic!("{error}"))
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
            let robot = support::robot(name);
            let expected = printed(linear, &generate(linear, &robot, None).text());
            assert_eq!(expected.len(), 2);
            for language in [Language::C, Language::Cuda] {
                let request = Request {
                    language,
                    ..Request::of(&[linear.regressor])
                };
                let text = dalembert_codegen::generate(&robot, &request)
                    .unwrap()
                    .text();
                assert_eq!(printed_in_c(&text), expected, "{name}");
                let said = format!("and `{name}_{}` is", linear.constant.to_lowercase());
                assert!(text.contains(&said) && !text.contains(linear.constant));
            }
        }
    }
}

/// Returns the rank of Y over all links' parameters, in f64 from the runtime: elimination
/// with the largest pivot there is, columns brought to one length first.
fn rank(runtime: &Runtime, scene_robot: &SceneRobot) -> usize {
    let rows = scene_robot.rows().len();
    let columns = 10 * scene_robot.joints().len();
    let states = seeded(scene_robot.robot(), columns / rows + 10, 0x72616e6b);
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

/// Returns the emitted Y times the printed π against the runtime's torques, relative to
/// what the sums are made of; and as many columns as the rank.
fn check(linear: Linear, robot: &Robot, scene: Option<&Scene>, drives: usize) -> Generated {
    let scene_robot = SceneRobot::of(robot, scene).unwrap();
    let runtime = Runtime::in_scene(scene_robot.clone());
    let base = rank(&runtime, &scene_robot) + drives;
    with_columns(linear, robot, scene, base)
}

/// Returns the same with so many columns.
fn with_columns(linear: Linear, robot: &Robot, scene: Option<&Scene>, base: usize) -> Generated {
    let generated = generate(linear, robot, scene);
    let scene_robot = SceneRobot::of(robot, scene).unwrap();
    let runtime = Runtime::in_scene(scene_robot.clone());
    let parameters = printed(linear, &generated.text());
    assert_eq!(generated.emitted.len(), 2);
    for (emitted, pi) in generated.emitted.iter().zip(&parameters) {
        assert_eq!(pi.len(), base, "{}", robot.name);
        assert_eq!(emitted.sizes.base, base);
        for state in seeded(scene_robot.robot(), 50, 0x7275) {
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
        let generated = check(TORQUES, &support::robot(name), None, 0);
        assert_eq!(generated.emitted[0].sizes.base, base);
        let found = generated.functions[0].counts().operations();
        assert!(found <= most, "{name}: {found}");
    }
}

/// Slides before, between and after what turns; odd angles.
#[test]
fn torques_of_other_arms() {
    for name in ["scara", "gantry", "rprpr"] {
        let robot = support::read_robot(&support::arm_file(name));
        check(TORQUES, &robot, None, 0);
        check(PASSIVITY, &robot, None, 0);
    }
}

/// What one velocity more costs; no more columns.
#[test]
fn passivity_of_the_checked_in_robots() {
    let most = [23, 51, 653];
    for (name, most) in ["planar2r", "planar3r", "puma560"].into_iter().zip(most) {
        let generated = check(PASSIVITY, &support::robot(name), None, 0);
        let found = generated.functions[0].counts().operations();
        assert!(found <= most, "{name}: {found}");
    }
}

/// Rotors and friction have columns of their own, but for the first rotor, which
/// is felt as the first link's inertia is.
#[test]
fn drives_have_columns() {
    let mut robot = support::robot("planar2r");
    for (joint, value) in robot.joints.iter_mut().zip([2, 3]) {
        joint.armature = Rational::new(value.into(), 10.into());
        joint.viscous = Rational::new(value.into(), 7.into());
    }
    for linear in [TORQUES, PASSIVITY] {
        let generated = check(linear, &robot, None, 3);
        for said in ["Izz1 + m2 + armature1 |", "| armature2 |", "| viscous1 |"] {
            assert!(
                generated.text().contains(said),
                "{said}: {}",
                generated.text()
            );
        }
    }
}

fn scene(change: impl FnOnce(&mut Scene)) -> Scene {
    let mut scene = Scene {
        name: "some".into(),
        ..Scene::default()
    };
    change(&mut scene);
    scene
}

/// What a scene holds still or does not ask for needs fewer parameters.
#[test]
fn torques_in_scenes() {
    let angle = |n: i64, d: i64| Position::Angle(Angle::PiTimes(Rational::new(n.into(), d.into())));
    let plane = scene(|scene| {
        scene.lock = vec![(0, angle(0, 1)), (3, angle(0, 1)), (5, angle(1, 6))];
    });
    let pick = scene(|scene| {
        scene.joints = Some(vec![2, 0]);
        scene.velocity_zero = true;
    });
    let held = scene(|scene| {
        scene.lock = vec![(4, angle(1, 4))];
        scene.joints = Some(vec![4, 1]);
    });
    let still = scene(|scene| (scene.velocity_zero, scene.acceleration_zero) = (true, true));
    let robot = support::robot("puma560");
    for scene in [plane, pick, held, still] {
        check(TORQUES, &robot, Some(&scene), 0);
    }
}

/// Rates that are zero are those of the arm, not those wished for: at rest friction and
/// inertias have columns, which torques at rest have not.
#[test]
fn passivity_in_scenes() {
    let mut robot = support::robot("planar2r");
    robot.joints[1].viscous = Rational::new(1.into(), 7.into());
    let still = scene(|scene| (scene.velocity_zero, scene.acceleration_zero) = (true, true));
    with_columns(TORQUES, &robot, Some(&still), 4);
    with_columns(PASSIVITY, &robot, Some(&still), 7);
    let pick = scene(|scene| scene.joints = Some(vec![1]));
    check(PASSIVITY, &robot, Some(&pick), 1);
}

/// π from the combinations is the torques' π exactly, and a combination that is
/// off in one coefficient, or that lacks a column, is refused by the parameter.
#[test]
fn wrong_combinations_are_refused() {
    let robot = support::robot("puma560");
    let scene_robot = SceneRobot::whole(&robot);
    let base = scene_robot.base(TORQUES.quantity).unwrap();
    assert_eq!(prove_base(&scene_robot, TORQUES.regressor, base), Ok(()));
    let arm = Arm::from_robot(&robot, &mut Exact::clone);
    let printed = &printed(TORQUES, &generate(TORQUES, &robot, None).text())[0];
    let values: Vec<f64> = base.values(&arm).iter().map(f64::nearest).collect();
    assert_eq!(*printed, values);

    let refused = |wrong: &BaseParameters, parameter: Parameter| {
        let parameter = parameter.to_string();
        let expected = Err(Disproof::Dependence { parameter });
        for linear in [TORQUES, PASSIVITY] {
            assert_eq!(prove_base(&scene_robot, linear.regressor, wrong), expected);
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

/// No tolerance: what a column's error does depends on the parameter.
#[test]
fn tolerances_are_refused() {
    let source = "\n[scene.some]\ntolerance = { value = 1e-2, relative_to = \"range\" }\n";
    let reading = support::reading_with("puma560", source);
    let regressors = [
        Function::Regressor,
        Function::FullRegressor,
        Function::PassivityRegressor,
    ];
    for function in regressors {
        let request = Request {
            scene: reading.scenes.first().cloned(),
            ..Request::of(&[function])
        };
        let error = dalembert_codegen::generate(&reading.robot, &request).unwrap_err();
        let why = ToleranceError::Function(Unbounded::Parameters);
        assert_eq!(error, GenerateError::Tolerance(function, why));
    }
}
