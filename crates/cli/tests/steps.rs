//! The table of steps: every row is a program of the function, no row costs more than the one
//! before, and the last row is the generated program.

use dalembert_cli::explain::{Explanation, explain};
use dalembert_cli::steps::StepCode;
use dalembert_codegen::workspace::{Setup, prove};
use dalembert_codegen::{Function, Request, ScalarType, generate};
use dalembert_model::number::Rational;
use dalembert_model::scene::Scale;

use crate::robots as support;

fn of(name: &str, function: Function) -> Explanation {
    let mut explanations = explain(&support::robot(name), &Request::new(&[function])).unwrap();
    explanations.remove(0)
}

fn operations(explanation: &Explanation, step: &str) -> usize {
    let mut rows = explanation.rows.iter();
    let row = rows.find(|row| row.step == step).unwrap();
    row.counts.operations()
}

#[test]
fn every_row_is_proved() {
    for name in ["planar2r", "stanford"] {
        let robot = support::robot(name);
        for function in [Function::InverseDynamics, Function::Inertia] {
            for row in of(name, function).rows {
                if let StepCode::Program(program) = row.code {
                    let step = row.step;
                    assert_eq!(row.counts, program.counts());
                    prove(&Setup::whole(&robot), &program)
                        .unwrap_or_else(|e| panic!("{name} {step}: {e}"));
                }
            }
        }
    }
}

/// In a scene, too, every row but the last, which gives up accuracy, equals the
/// whole robot's at the scene's values; rounding alone costs it no digits.
#[test]
fn a_scene_is_explained() {
    let scene = "\n[scene.hold]\noutputs = [\"gravity\"]\njoints = [2, 1]\nlock = { 3 = \"pi/6\" }\n\
         tolerance = { value = 0.3, relative_to = \"range\" }\n";
    let reading = support::reading_with("planar3r", scene);
    let request = Request::default().choose(None, None, Some(&reading.scenes[0]));
    let explained = explain(&reading.robot, &request).unwrap().remove(0);
    let setup = Setup::in_scene(&reading.robot, Some(&reading.scenes[0])).unwrap();
    let (last, exact) = explained.rows.split_last().unwrap();
    assert_eq!(last.step, "tolerance");
    for row in exact {
        if let StepCode::Program(program) = &row.code {
            let step = row.step;
            prove(&setup, program).unwrap_or_else(|e| panic!("{step}: {e}"));
        }
    }
    let searched = operations(&explained, "search");
    assert!(last.counts.operations() < searched && searched < 14);
    let errors = explained.rounding(50);
    let (last, exact) = errors.split_last().unwrap();
    let mut vectors = exact.iter().map(|[vector, _]| *vector);
    let small = vectors.all(|vector| vector > 0.0 && vector < 100.0);
    assert!(small && last[0] > 1e6, "{errors:?}");
}

/// The last rows are the generated programs, in their scalar and with their sines: all
/// functions share one scalar, though gravity alone could use the other.
#[test]
fn the_last_row_is_what_is_generated() {
    // At such accelerations the error of f32 is a thousandth of the limits.
    let scene = "\n[scene.move]\nbox = { velocity = [1, 1, 1], acceleration = [1e6, 1e6, 1e6] }\n\
                 tolerance = { value = 1e-5, relative_to = \"range\" }\n";
    let mut reading = support::reading_with("planar3r", scene);
    for joint in &mut reading.robot.joints {
        joint.limits.torque = Some(Rational::from_integer(100.into()));
    }
    let tolerance = reading.scenes[0].tolerance.as_mut().unwrap();
    tolerance.relative_to = Scale::Actuator;
    let torques = [Function::Gravity, Function::InverseDynamics];
    for (count, scalar) in [(1, ScalarType::F32), (2, ScalarType::F64)] {
        let scene = Some(&reading.scenes[0]);
        let functions = &torques[..count];
        let request = Request::default().choose(Some(functions.to_vec()), None, scene);
        let explained = explain(&reading.robot, &request).unwrap();
        let generated = generate(&reading.robot, &request).unwrap();
        assert_eq!(explained.len(), functions.len());
        for explanation in explained {
            let mut functions = generated.functions.iter();
            let same = functions.find(|f| f.function == explanation.function);
            let function = same.unwrap();
            let last = explanation.rows.last().unwrap();
            let StepCode::Emitted(text, of) = &last.code else {
                panic!("{:?}", last.step)
            };
            assert_eq!(*of, scalar, "{}", function.function);
            assert_eq!(last.counts, function.counts_in(scalar));
            let mut texts = generated.emitted.iter();
            let emitted = texts.find(|e| e.function == function.function);
            assert_eq!((**text).clone(), emitted.unwrap().text);
        }
    }
}

#[test]
fn steps_do_not_make_it_dearer() {
    let puma = of("puma560", Function::InverseDynamics);
    // Newton–Euler is traced anew.
    let mut falling = puma.rows.clone();
    falling.retain(|row| row.step != "newton_euler_folded");
    let falling: Vec<usize> = falling.iter().map(|row| row.counts.operations()).collect();
    assert_eq!(falling.len(), 10);
    assert!(falling.is_sorted_by(|a, b| a >= b), "{falling:?}");
    assert!(operations(&puma, "search") < operations(&puma, "base_parameters"));
}

#[test]
fn rounding_of_every_row() {
    // Some symbols h_ikm and two loads c_i vanish: they have no relative error.
    for function in [Function::InverseDynamics, Function::DynamicCoefficients] {
        let stanford = of("stanford", function);
        let errors = stanford.rounding(20);
        assert_eq!(errors.len(), stanford.rows.len());
        for (row, [vector, error]) in stanford.rows.iter().zip(errors) {
            let step = row.step;
            assert!(vector > 0.0 && vector < 1e3, "{step}");
            // Small symbols are differences of large numbers where poses are
            // differentiated.
            let bound = if row.step == "search" { 1e3 } else { 1e8 };
            assert!(error > 0.0 && error < bound, "{function} {step}: {error}");
        }
    }
}
