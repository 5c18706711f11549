//! Velocities and accelerations of encoders: gains, windows, and what they do to parameters.

use dalembert_fit::simulate::{LogSettings, record};
use dalembert_fit::{Accumulator, Differentiator, differentiate, excite, fit};

use crate::support::{arm, differentiated, noise, short_effort};

#[test]
fn quartics_are_differentiated_exactly() {
    let filter = Differentiator::new(0.01, 7).unwrap();
    let q = |t: f64| 0.3 - 0.2 * t + 0.7 * t.powi(2) - 0.4 * t.powi(3) + 0.1 * t.powi(4);
    let samples: Vec<f64> = (0..60).map(|k| q(f64::from(k) * 0.01)).collect();
    let [position, velocity, acceleration] = differentiate(&filter, &samples).unwrap();
    assert_eq!(position.len(), 60 - 2 * filter.half());
    let derivatives = position.iter().zip(&velocity).zip(&acceleration);
    for (k, ((position, velocity), acceleration)) in derivatives.enumerate() {
        let t = (k + filter.half()) as f64 * 0.01;
        let slope = -0.2 + 1.4 * t - 1.2 * t.powi(2) + 0.4 * t.powi(3);
        let bend = 1.4 - 2.4 * t + 1.2 * t.powi(2);
        assert!((position - q(t)).abs() < 1e-13);
        assert!((velocity - slope).abs() < 1e-11, "{velocity} {slope}");
        assert!((acceleration - bend).abs() < 1e-9, "{acceleration} {bend}");
    }
}

#[test]
fn windows_are_as_long_as_the_motion_lets_them() {
    for (period, frequency) in [(1e-3, 1.0), (1e-3, 5.0), (4e-3, 0.5)] {
        let filter = Differentiator::for_motion(period, frequency).unwrap();
        let off = |filter: &Differentiator| {
            let gains = filter.gains(period, frequency).into_iter();
            gains.map(|gain| (gain - 1.0).abs()).fold(0.0, f64::max)
        };
        assert!(off(&filter) <= Differentiator::ERROR);
        if filter.half() < Differentiator::LONGEST {
            let longer = Differentiator::new(period, filter.half() + 1).unwrap();
            assert!(off(&longer) > Differentiator::ERROR);
        }
    }
    let error = Differentiator::for_motion(0.1, 5.0).unwrap_err();
    let wanted = "10 states a second carry motion up to 0.42 Hz, and the motion has 5 Hz";
    assert!(error.to_string().contains(wanted), "{error}");
    assert!(Differentiator::new(-1.0, 7).is_err());
    assert!(Differentiator::new(0.01, 1).is_err());
    let filter = Differentiator::new(0.01, 7).unwrap();
    assert!(differentiate(&filter, &[0.0; 14]).is_err());
    assert!(differentiate(&filter, &[f64::NAN; 20]).is_err());
}

/// Returns the parameters' bias in standard errors: root mean square and largest.
fn encoder_bias(seeds: u64) -> [f64; 2] {
    let (model, right) = arm("puma560");
    let sigma: Vec<f64> = (0..6).map(noise).collect();
    let (trajectory, _) = excite(&model, &sigma, 8.0, &short_effort()).unwrap();
    let filter = Differentiator::for_motion(1e-3, trajectory.highest_frequency()).unwrap();
    let mut away = vec![0.0; right.len()];
    for seed in 0..seeds {
        let recording = LogSettings {
            period: 1e-3,
            states: 8000,
            noise: sigma.clone(),
            resolution: 2.0 * std::f64::consts::PI / 131_072.0,
            seed,
        };
        let log = record(&model, &right, &trajectory, &recording).unwrap();
        let mut data = Accumulator::new(&model);
        let states = differentiated(&filter, &log);
        for ([q, qd, qdd], tau) in states.iter().zip(&log.tau[filter.half()..]) {
            data.add(&model, [q, qd, qdd], tau).unwrap();
        }
        let fit = fit(&model, &data).unwrap();
        assert!(fit.unexcited.is_empty());
        for (joint, (after, noise)) in (1..).zip(fit.after.iter().zip(&sigma)) {
            assert!((after / noise - 1.0).abs() < 0.05, "joint {joint}: {after}");
        }
        let errors = fit.parameters.iter().zip(&right).zip(&fit.standard_errors);
        for (away, ((parameter, right), error)) in away.iter_mut().zip(errors) {
            *away += (parameter - right) / error / seeds as f64;
        }
    }
    let square: f64 = away.iter().map(|x| x * x).sum();
    let largest = away.iter().fold(0.0f64, |max, x| max.max(x.abs()));
    [(square / away.len() as f64).sqrt(), largest]
}

/// In two logs the noise of the torques alone gives 0.7 standard errors.
#[test]
fn quantised_encoders_leave_the_noise_of_the_torques() {
    let [bias, largest] = encoder_bias(2);
    println!("mean error of two logs: {bias:.2} standard errors, at most {largest:.2}");
    assert!(bias < 1.0, "{bias}");
}

#[test]
#[ignore = "minutes: the step `campaigns` of .ci/run"]
fn quantised_encoders_bias_less_than_torques_do() {
    let [bias, largest] = encoder_bias(100);
    println!("bias: {bias:.2} standard errors, at most {largest:.2}");
    assert!(bias < 0.3 && largest < 1.0, "{bias} {largest}");
}
