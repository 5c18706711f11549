//! Velocities and accelerations of encoders: gains, windows, and what they do to parameters.

use dalembert_fit::simulate::{Recording, record};
use dalembert_fit::{Accumulator, Differentiator, Effort, Prior, differentiate, excite, fit};

use crate::support::{guess, model, noise, true_parameters, truth};

/// Exact for motion of degree 4, at the place of the window's middle.
#[test]
fn quartics_are_differentiated_exactly() {
    let filter = Differentiator::new(0.01, 7).unwrap();
    let q = |t: f64| 0.3 - 0.2 * t + 0.7 * t.powi(2) - 0.4 * t.powi(3) + 0.1 * t.powi(4);
    let samples: Vec<f64> = (0..60).map(|k| q(f64::from(k) * 0.01)).collect();
    let [position, velocity, acceleration] = differentiate(&filter, &samples).unwrap();
    assert_eq!(position.len(), 60 - 2 * filter.half());
    let all = position.iter().zip(&velocity).zip(&acceleration);
    for (k, ((position, velocity), acceleration)) in all.enumerate() {
        let t = (k + filter.half()) as f64 * 0.01;
        let slope = -0.2 + 1.4 * t - 1.2 * t.powi(2) + 0.4 * t.powi(3);
        let bend = 1.4 - 2.4 * t + 1.2 * t.powi(2);
        assert!((position - q(t)).abs() < 1e-13);
        assert!((velocity - slope).abs() < 1e-11, "{velocity} {slope}");
        assert!((acceleration - bend).abs() < 1e-9, "{acceleration} {bend}");
    }
}

/// The window is the longest that leaves the motion alone: the next one does not.
#[test]
fn windows_are_as_long_as_the_motion_lets_them() {
    for (period, frequency) in [(1e-3, 1.0), (1e-3, 5.0), (4e-3, 0.5)] {
        let filter = Differentiator::for_motion(period, frequency).unwrap();
        let off = |filter: &Differentiator| {
            let gains = filter.gains(period, frequency);
            gains
                .iter()
                .fold(0.0f64, |max, gain| max.max((gain - 1.0).abs()))
        };
        assert!(off(&filter) <= Differentiator::ERROR);
        if filter.half() < Differentiator::LONGEST {
            let longer = Differentiator::new(period, filter.half() + 1).unwrap();
            assert!(off(&longer) > Differentiator::ERROR);
            assert!(longer.noise()[2] < filter.noise()[2]);
        }
    }
    let said = Differentiator::for_motion(0.1, 5.0)
        .unwrap_err()
        .to_string();
    assert!(said.contains("twenty times"), "{said}");
    assert!(Differentiator::new(-1.0, 7).is_err());
    assert!(Differentiator::new(0.01, 1).is_err());
    let filter = Differentiator::new(0.01, 7).unwrap();
    assert!(differentiate(&filter, &[0.0; 14]).is_err());
    assert!(differentiate(&filter, &[f64::NAN; 20]).is_err());
}

/// Encoders of 2¹⁷ steps a turn, read a thousand times a second, on an exciting trajectory:
/// the total residual is the noise's, and the bias stays within standard errors.
#[test]
fn quantised_encoders_have_a_bar_of_their_own() {
    let truth = truth("puma560");
    let model = model(&guess(&truth));
    let right = true_parameters(&truth);
    let sigma: Vec<f64> = (0..6).map(noise).collect();
    let effort = Effort {
        starts: 8,
        steps: 0,
        ..Effort::default()
    };
    let (trajectory, _) = excite(&model, &sigma, 8.0, &effort).unwrap();
    let recording = Recording {
        period: 1e-3,
        states: 8000,
        noise: sigma.clone(),
        resolution: 2.0 * std::f64::consts::PI / 131_072.0,
        seed: 3,
    };
    let log = record(&model, &right, &trajectory, &recording).unwrap();
    let filter = Differentiator::for_motion(1e-3, trajectory.highest_frequency()).unwrap();
    let joints: Vec<[Vec<f64>; 3]> = (0..6)
        .map(|i| {
            let q: Vec<f64> = log.q.iter().map(|q| q[i]).collect();
            differentiate(&filter, &q).unwrap()
        })
        .collect();
    let mut data = Accumulator::new(&model);
    for k in 0..joints[0][0].len() {
        let state = [0, 1, 2].map(|of| joints.iter().map(|joint| joint[of][k]).collect::<Vec<_>>());
        let [q, qd, qdd] = &state;
        data.add(&model, [q, qd, qdd], &log.tau[k + filter.half()])
            .unwrap();
    }
    let found = fit(&model, &data, &Prior::None).unwrap();
    let [mut bias, mut worst, mut counted] = [0.0, 0.0f64, 0.0];
    for (k, error) in found.standard_errors.iter().enumerate() {
        if error.is_finite() {
            let away = (found.parameters[k] - right[k]) / error;
            bias += away * away;
            worst = worst.max(away.abs());
            counted += 1.0;
        }
    }
    let bias = (bias / counted).sqrt();
    println!(
        "window {}, error {bias:.2} σ, at most {worst:.2} σ",
        2 * filter.half() + 1
    );
    for (i, after) in found.after.iter().enumerate() {
        let part = after / sigma[i];
        assert!((part - 1.0).abs() < 0.05, "joint {}: {part}", i + 1);
    }
    assert!(bias < 1.5, "{bias}");
}
