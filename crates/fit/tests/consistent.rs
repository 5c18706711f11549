//! Bodies exist, and are those of the free parameters wherever these have bodies.

use dalembert_fit::{Column, Model, consistent, fit, identified};
use dalembert_model::read::parse;
use dalembert_model::robot::write;

use crate::support::{ARMS, accumulated, arm, fitted, near, number, states, truth};

#[test]
fn free_parameters_that_have_bodies_are_kept() {
    for name in ARMS {
        let (model, right) = arm(name);
        // With little noise the free parameters are next to those of bodies.
        let exact = accumulated(&model, &states(&model, 500, 31), &right, None);
        let (_, mut free) = fitted(&model, &right, 500, [31, 3]);
        free.parameters = fit(&model, &exact).unwrap().parameters;
        let bodies = consistent(&model, &free).unwrap();
        let (moved, distance, steps) = (bodies.moved, bodies.distance, bodies.steps);
        assert!(moved < 1e-2, "{name}: {moved} standard errors");
        assert!(distance < 2e-2, "{name}: {distance}");
        println!("{name}: {steps} steps, moved {moved:.1e}");
    }
}

/// The log asks for negative rotors and friction, many standard errors away.
#[test]
fn drives_stop_at_zero() {
    for name in ARMS {
        let (model, mut right) = arm(name);
        let mut lost = Vec::new();
        for (k, value) in right.iter_mut().enumerate() {
            let name = model.name(k);
            let is_rotor = name.starts_with("armature") && !name.contains(' ');
            if is_rotor || name.starts_with("coulomb") {
                *value = if is_rotor { -0.06 } else { -2.0 };
                lost.push(name);
            } else if matches!(model.columns()[k], Column::Offset(_)) {
                *value = 0.7;
            }
        }
        let mut names = lost.iter();
        assert!(names.any(|name| name.starts_with("armature")), "{lost:?}");
        let (data, free) = fitted(&model, &right, 600, [38, 37]);
        let bodies = consistent(&model, &free).unwrap();
        let (distance, steps, stopped) = (bodies.distance, bodies.steps, &bodies.stopped);
        println!("{name}: {distance:.1} standard errors, {steps} steps");
        for name in &lost {
            assert!(stopped.contains(name), "{name}: {stopped:?}");
        }
        for (place, armature) in bodies.armature.iter().enumerate() {
            let is_lost = lost.contains(&format!("armature{}", place + 1));
            assert!(*armature == 0.0 || (!is_lost && *armature > 0.0));
        }
        assert!(bodies.coulomb.iter().all(|coulomb| *coulomb == 0.0));
        let text = write(&identified(&model, &bodies).unwrap());
        let again = Model::new(&parse(&text).unwrap().robot).unwrap();
        let said = data.residual(&model, &bodies.file_parameters(&model));
        let left = data.residual(&model, again.parameters()).unwrap();
        for (said, left) in said.unwrap().iter().zip(left) {
            assert!((said - left).abs() < 1e-6 * left, "{name}: {said} {left}");
            // The file has no offsets.
            assert!(left > 0.6, "{name}: {left}");
        }
    }
}

#[test]
fn bodies_are_found_far_from_all_that_exist() {
    are_found_far_from_all_that_exist(&ARMS[..1]);
}

#[test]
#[ignore = "minutes: the step `campaigns` of .ci/run"]
fn bodies_of_larger_arms_are_found_far_from_all_that_exist() {
    are_found_far_from_all_that_exist(&ARMS[1..]);
}

fn are_found_far_from_all_that_exist(arms: &[&str]) {
    for name in arms {
        let (model, right) = arm(name);
        let less: Vec<f64> = right.iter().map(|x| -x).collect();
        let (_, free) = fitted(&model, &less, 600, [40, 39]);
        let bodies = consistent(&model, &free).unwrap();
        let (distance, steps) = (bodies.distance, bodies.steps);
        println!("{name}: {distance:.0} standard errors, {steps} steps");
        assert!(distance > 100.0, "{name}: {distance}");
        for joint in identified(&model, &bodies).unwrap().joints {
            assert_eq!(joint.inertia.defect(&joint.mass), None, "{name}");
        }
    }
}

/// Behind its gears a torque does not feel the rotors: they have no columns, and none in the file.
#[test]
fn rotors_are_left_away() {
    let robot = truth("panda");
    let [with, without] = [Model::new(&robot), Model::without_rotors(&robot)].map(Result::unwrap);
    let has =
        |model: &Model| (0..model.columns().len()).any(|k| model.name(k).contains("armature"));
    assert!(has(&with) && !has(&without));
    assert_ne!(with.fingerprint(), without.fingerprint());
    let (_, free) = fitted(&without, without.parameters(), 400, [44, 45]);
    let bodies = consistent(&without, &free).unwrap();
    for joint in identified(&without, &bodies).unwrap().joints {
        assert_eq!(joint.armature, number(0.0));
    }
}

#[test]
fn bodies_of_noisy_data_exist() {
    for name in ARMS {
        let (model, right) = arm(name);
        let (data, free) = fitted(&model, &right, 300, [32, 33]);
        let bodies = consistent(&model, &free).unwrap();
        assert!(bodies.links.iter().all(|link| link[0] > 0.0));
        for of in [&bodies.armature, &bodies.viscous, &bodies.coulomb] {
            assert!(of.iter().all(|x| *x >= 0.0));
        }
        // The set is convex, and no way towards other bodies that exist gets nearer.
        let distance = |parameters: &[f64]| -> f64 {
            let at = |parameters: &[f64]| -> f64 {
                let residuals = data.residual(&model, parameters).unwrap();
                let parts = residuals.iter().zip(&free.noise);
                parts.map(|(r, noise)| 300.0 * (r / noise).powi(2)).sum()
            };
            at(parameters) - at(&free.parameters)
        };
        let nearest = distance(&bodies.parameters);
        near(nearest, bodies.distance.powi(2), 1e-6, name);
        for other in [&right[..], model.parameters()] {
            assert!(nearest < distance(other));
            let both = bodies.parameters.iter().zip(other);
            let moved = both.map(|(parameter, x)| parameter + 1e-4 * (x - parameter));
            let farther = distance(&Vec::from_iter(moved)) - nearest;
            assert!(farther > -1e-6, "{name}: {farther}");
        }
        // A mean over 300 states is known to a part of one state's noise.
        let unseen = accumulated(&model, &states(&model, 300, 35), &right, None);
        let predicted = unseen.residual(&model, &bodies.parameters).unwrap();
        for (i, residual) in predicted.iter().enumerate() {
            let away = residual / crate::support::noise(i);
            assert!(away < 0.6, "{name}: {away} of the noise");
        }
        for joint in &identified(&model, &bodies).unwrap().joints {
            assert_eq!(joint.inertia.defect(&joint.mass), None, "{name}");
            assert!(joint.mass > number(0.0));
        }
    }
}
