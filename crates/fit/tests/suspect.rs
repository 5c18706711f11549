//! Mistakes of logs are named, and no log without one is suspected.

use dalembert_fit::random::{Random, normal};
use dalembert_fit::{Change, suspect};

use crate::support::{guess, model, noise, torques, true_parameters, truth};

const ROWS: usize = 4000;
const TURN: f64 = 180.0 / core::f64::consts::PI;

/// q, q̇, q̈ and τ, column by column, 2 ms apart.
fn log(name: &str) -> ([Vec<f64>; 4], usize) {
    let truth = truth(name);
    let (model, right) = (model(&truth), true_parameters(&truth));
    let n = model.joints();
    let mut log = [(); 4].map(|()| vec![0.0; n * ROWS]);
    let mut random = Random::new(7);
    for row in 0..ROWS {
        let [mut q, mut qd, mut qdd] = [(); 3].map(|()| vec![0.0; n]);
        for i in 0..n {
            for (size, speed) in [(0.8, 1.3), (0.3, 3.7)] {
                let speed = speed + 0.37 * i as f64;
                let (sin, cos) = (speed * row as f64 * 2e-3 + i as f64).sin_cos();
                q[i] += size * sin;
                qd[i] += size * speed * cos;
                qdd[i] -= size * speed * speed * sin;
            }
        }
        let y = model.regressor(&q, &qd, &qdd).unwrap();
        let tau = torques(&y, &right);
        for i in 0..n {
            for (column, quantity) in log.iter_mut().zip([&q, &qd, &qdd]) {
                column[i * ROWS + row] = quantity[i];
            }
            log[3][i * ROWS + row] = tau[i] + 0.1 * noise(i) * normal(&mut random);
        }
    }
    (log, n)
}

fn named(name: &str) {
    let (right, n) = log(name);
    let model = model(&guess(&truth(name)));
    let suspicion_of =
        |log: &[Vec<f64>; 4]| suspect(&model, log.each_ref().map(|x| &x[..])).unwrap();
    assert_eq!(suspicion_of(&right), None, "{name}");
    let swap = |log: &mut Vec<f64>, i: usize, j: usize| {
        (0..ROWS).for_each(|row| log.swap(i * ROWS + row, j * ROWS + row));
    };
    let mut degrees = right.clone();
    degrees[..3].iter_mut().flatten().for_each(|x| *x *= TURN);
    let mut torques = right.clone();
    swap(&mut torques[3], 0, n - 1);
    let mut joints = right.clone();
    joints.iter_mut().for_each(|column| swap(column, 0, 1));
    let mut late = right.clone();
    late[3].rotate_right(16);
    for (log, wanted) in [
        (&degrees, Change::Angles(core::f64::consts::PI / 180.0)),
        (&torques, Change::Torques(0, n - 1)),
        (&joints, Change::Joints(0, 1)),
        (&late, Change::Late(16)),
    ] {
        let suspicion = suspicion_of(log).expect("a suspicion");
        assert_eq!(suspicion.change, wanted, "{name}");
        let most = f64::min(0.25 * suspicion.before, 0.1);
        assert!(suspicion.after < most, "{name}: {suspicion:?}");
    }
}

#[test]
fn mistakes_are_named() {
    named("planar2r");
}

#[test]
#[ignore = "minutes: the step `campaigns` of .ci/run"]
fn mistakes_of_six_joints_are_named() {
    named("puma560");
}
