//! Trajectories within limits that tell parameters apart.

use dalembert_fit::{Effort, excite};

use crate::support::{ARMS, guess, model, noise, truth};

fn effort(starts: usize, steps: usize) -> Effort {
    Effort {
        harmonics: 4,
        samples: 30,
        starts,
        steps,
        seed: 1,
    }
}

/// At rest at the ends, within limits at every time, better than the best of its starts, and
/// the same each time.
#[test]
fn the_condition_falls_within_the_limits() {
    for name in ARMS {
        let model = model(&guess(&truth(name)));
        let sigma: Vec<f64> = (0..model.joints()).map(noise).collect();
        let (_, before) = excite(&model, &sigma, 10.0, &effort(4, 0)).unwrap();
        let (found, after) = excite(&model, &sigma, 10.0, &effort(4, 10)).unwrap();
        println!("{name}: condition {before:.0} -> {after:.0}");
        assert!(after < before, "{name}: {before} -> {after}");
        for time in [0.0, 10.0] {
            let [_, qd, qdd] = found.at(time);
            assert!(qd.iter().chain(&qdd).all(|x| x.abs() < 1e-9));
        }
        for k in 0..500 {
            let [q, qd, qdd] = found.at(f64::from(k) * 0.02);
            for (i, limits) in model.limits().iter().enumerate() {
                let [low, high] = limits.position;
                assert!(q[i] >= low && q[i] <= high);
                assert!(qd[i].abs() <= limits.velocity && qdd[i].abs() <= limits.acceleration);
            }
        }
    }
    let model = model(&guess(&truth("ur10")));
    let twice = [(); 2].map(|()| excite(&model, &[1.0; 6], 10.0, &effort(2, 2)).unwrap());
    assert_eq!(twice[0], twice[1]);
}

#[test]
fn bad_requests_are_told() {
    let model = model(&guess(&truth("ur10")));
    let good = [1.0; 6];
    assert!(excite(&model, &good, 0.0, &effort(1, 0)).is_err());
    assert!(excite(&model, &good, f64::NAN, &effort(1, 0)).is_err());
    assert!(excite(&model, &good[1..], 10.0, &effort(1, 0)).is_err());
    assert!(excite(&model, &[0.0; 6], 10.0, &effort(1, 0)).is_err());
    assert!(excite(&model, &good, 10.0, &effort(0, 0)).is_err());
}
