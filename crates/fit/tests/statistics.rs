//! Standard errors mean what they say.

use dalembert_fit::fit;

use crate::support::{ARMS, accumulated, arm, fitted, near, states};

/// Returns the part of the parameters within three standard errors, and their root mean square.
fn coverage(name: &str, seeds: u64, count: usize) -> [f64; 2] {
    let (model, right) = arm(name);
    let states = states(&model, count, 7);
    let [mut inside, mut total, mut squares] = [0.0; 3];
    for seed in 0..seeds {
        let data = accumulated(&model, &states, &right, Some(1000 + seed));
        let fit = fit(&model, &data).unwrap();
        assert!(fit.unexcited.is_empty());
        for (k, error) in fit.standard_errors.iter().enumerate() {
            let away = (fit.parameters[k] - right[k]) / error;
            inside += f64::from(u8::from(away.abs() <= 3.0));
            squares += away * away;
            total += 1.0;
        }
    }
    [inside / total, (squares / total).sqrt()]
}

fn covered(seeds: u64, count: usize, bar: f64) {
    for name in ARMS {
        let [inside, size] = coverage(name, seeds, count);
        println!("{name}: {inside:.4} within three standard errors, {size:.3} of them");
        assert!(inside >= 0.985, "{name}: {inside}");
        assert!((size - 1.0).abs() < bar, "{name}: {size}");
    }
}

#[test]
fn three_standard_errors_cover_the_parameters() {
    covered(6, 600, 0.15);
}

#[test]
#[ignore = "minutes: the step `campaigns` of .ci/run"]
fn three_standard_errors_cover_the_parameters_of_100_logs() {
    covered(100, 2000, 0.05);
}

#[test]
fn noise_is_each_joint_s_own() {
    let (model, right) = arm("puma560");
    let (_, fit) = fitted(&model, &right, 2000, [8, 9]);
    for (i, noise) in fit.noise.iter().enumerate() {
        let wanted = crate::support::noise(i);
        assert!((noise / wanted - 1.0).abs() < 0.06, "{noise} {wanted}");
        assert!(fit.after[i] < 1.06 * wanted && fit.before[i] > 1.5 * wanted);
    }
}

#[test]
fn exact_torques_give_the_exact_parameters() {
    for name in ARMS {
        let (model, right) = arm(name);
        let states = states(&model, 400, 10);
        let data = accumulated(&model, &states, &right, None);
        let fit = fit(&model, &data).unwrap();
        for (k, right) in right.iter().enumerate() {
            near(fit.parameters[k], *right, 1e-9, &model.name(k));
        }
    }
}
