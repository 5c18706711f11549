//! Bodies exist, and are those of the free parameters wherever these have bodies.

use dalembert_fit::random::Random;
use dalembert_fit::{consistent, fit};

use crate::support::{ARMS, accumulated, arm, number, states};

#[test]
fn free_parameters_that_have_bodies_are_kept() {
    for name in ARMS {
        let (model, right) = arm(name);
        // With little noise the free parameters are next to those of bodies.
        let data = accumulated(&model, &states(&model, 500, 31), &right, None);
        let mut free = fit(&model, &data).unwrap();
        let exact = free.parameters.clone();
        let mut random = Random::new(3);
        let noisy = accumulated(&model, &states(&model, 500, 31), &right, Some(&mut random));
        free = fit(&model, &noisy).unwrap();
        free.parameters = exact;
        let bodies = consistent(&model, &free).unwrap();
        assert!(
            bodies.moved < 1e-2,
            "{name}: {} standard errors",
            bodies.moved
        );
        assert!(bodies.distance < 2e-2, "{name}: {}", bodies.distance);
        println!("{name}: {} steps, moved {:.1e}", bodies.steps, bodies.moved);
    }
}

/// Noisy data give bodies that do not exist; the nearest that do predict as well.
#[test]
fn bodies_of_noisy_data_exist() {
    for name in ARMS {
        let (model, right) = arm(name);
        let mut random = Random::new(33);
        let data = accumulated(&model, &states(&model, 300, 32), &right, Some(&mut random));
        let free = fit(&model, &data).unwrap();
        let bodies = consistent(&model, &free).unwrap();
        for link in &bodies.links {
            assert!(link[0] > 0.0);
        }
        for of in [&bodies.armature, &bodies.viscous, &bodies.coulomb] {
            assert!(of.iter().all(|x| *x > 0.0));
        }
        // They are the nearest: no way towards others that exist, as the true ones and the
        // file's, gets nearer. The set is convex.
        let distance = |parameters: &[f64]| -> f64 {
            let at = |parameters: &[f64]| -> f64 {
                let residuals = data.residual(&model, parameters).unwrap();
                let parts = residuals.iter().zip(&free.noise);
                parts.map(|(r, noise)| 300.0 * (r / noise).powi(2)).sum()
            };
            at(parameters) - at(&free.parameters)
        };
        let nearest = distance(&bodies.parameters);
        let wanted = bodies.distance.powi(2);
        assert!(
            (nearest - wanted).abs() < 1e-6 * (1.0 + wanted),
            "{nearest} {wanted}"
        );
        for other in [&right[..], model.parameters()] {
            assert!(nearest < distance(other));
            let both = bodies.parameters.iter().zip(other);
            let near: Vec<f64> = both
                .map(|(own, other)| own + 1e-4 * (other - own))
                .collect();
            assert!(
                distance(&near) > nearest - 1e-6,
                "{name}: {}",
                distance(&near) - nearest
            );
        }
        // What was averaged over 300 states is known to a part of one state's noise.
        let mut away = 0.0f64;
        let unseen = accumulated(&model, &states(&model, 300, 35), &right, None);
        let predicted = unseen.residual(&model, &bodies.parameters).unwrap();
        for (i, residual) in predicted.iter().enumerate() {
            away = away.max(residual / crate::support::noise(i));
        }
        assert!(away < 0.6, "{name}: {away} of the noise");
        let robot = dalembert_fit::identified(&model, &bodies).unwrap();
        for joint in &robot.joints {
            assert_eq!(joint.inertia.defect(&joint.mass), None, "{name}");
            assert!(joint.mass > number(0.0));
        }
    }
}
