//! Trajectories within limits that tell parameters apart.

use dalembert_fit::{Effort, excite};

use crate::support::{ARMS, guess, model, noise, truth};

fn effort(starts: usize, descents: usize, steps: usize) -> Effort {
    Effort {
        harmonics: 4,
        samples: 30,
        starts,
        descents,
        steps,
        seed: 1,
    }
}

fn excited(arms: &[&str]) {
    for name in arms {
        let model = model(&guess(&truth(name)));
        let sigma: Vec<f64> = (0..model.joints()).map(noise).collect();
        let (_, drawn) = excite(&model, &sigma, 10.0, &effort(300, 1, 0)).unwrap();
        let (trajectory, condition) = excite(&model, &sigma, 10.0, &effort(50, 1, 40)).unwrap();
        println!("{name}: condition {condition:.1}, the best of 300 random ones {drawn:.1}");
        assert!(condition < 0.8 * drawn, "{name}: {condition} {drawn}");
        for time in [0.0, 10.0] {
            let [_, qd, qdd] = trajectory.at(time);
            assert!(qd.iter().chain(&qdd).all(|x| x.abs() < 1e-9));
        }
        for k in 0..500 {
            let [q, qd, qdd] = trajectory.at(f64::from(k) * 0.02);
            for (i, limits) in model.limits().iter().enumerate() {
                let [low, high] = limits.position;
                assert!(q[i] >= low && q[i] <= high);
                assert!(qd[i].abs() <= limits.velocity && qdd[i].abs() <= limits.acceleration);
            }
        }
    }
}

#[test]
fn no_random_trajectory_comes_near() {
    excited(&ARMS[..1]);
}

#[test]
#[ignore = "minutes: the step `campaigns` of .ci/run"]
fn no_random_trajectory_of_others_comes_near() {
    excited(&ARMS[1..]);
}

#[test]
fn trajectories_are_the_same_each_time() {
    let model = model(&guess(&truth("ur10")));
    let twice = [(); 2].map(|()| excite(&model, &[1.0; 6], 10.0, &effort(2, 1, 2)).unwrap());
    assert_eq!(twice[0], twice[1]);
}

#[test]
fn bad_requests_are_told() {
    let model = model(&guess(&truth("ur10")));
    let good = [1.0; 6];
    assert!(excite(&model, &good, 0.0, &effort(1, 1, 0)).is_err());
    assert!(excite(&model, &good, f64::NAN, &effort(1, 1, 0)).is_err());
    assert!(excite(&model, &good[1..], 10.0, &effort(1, 1, 0)).is_err());
    assert!(excite(&model, &[0.0; 6], 10.0, &effort(1, 1, 0)).is_err());
    assert!(excite(&model, &good, 10.0, &effort(0, 1, 0)).is_err());
    assert!(excite(&model, &good, 10.0, &effort(1, 0, 0)).is_err());
}
