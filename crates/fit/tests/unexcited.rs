//! Parameters that data do not tell are named, with a motion that tells them.

use dalembert_fit::random::{Random, normal};
use dalembert_fit::unexcited::Motion;
use dalembert_fit::{Accumulator, Model, fit};

use crate::support::{ARMS, State, arm, states, torques};

fn only(model: &Model, moves: impl Fn(usize) -> bool, accelerates: bool) -> Vec<State> {
    let mut some = states(model, 500, 21);
    for state in &mut some {
        for i in 0..state.q.len() {
            if !moves(i) {
                state.qd[i] = 0.0;
            }
            if !moves(i) || !accelerates {
                state.qdd[i] = 0.0;
            }
        }
        state.y = model.regressor(&state.q, &state.qd, &state.qdd).unwrap();
    }
    some
}

fn add(data: &mut Accumulator, model: &Model, some: &[State], right: &[f64]) {
    let mut random = Random::new(5);
    for state in some {
        let mut tau = torques(&state.y, right);
        tau.iter_mut().for_each(|x| *x += 0.1 * normal(&mut random));
        data.add_rows(model, &state.y, &tau).unwrap();
    }
}

#[test]
fn poses_tell_weights_alone() {
    for name in ARMS {
        let (model, right) = arm(name);
        let mut data = Accumulator::new(&model);
        add(&mut data, &model, &only(&model, |_| false, false), &right);
        let still = fit(&model, &data).unwrap();
        assert!(still.condition > 1e12);
        let columns = 0..model.columns().len();
        for k in columns.filter(|k| model.name(*k).starts_with("coulomb")) {
            let error = still.standard_errors[k];
            assert_eq!(error, f64::INFINITY, "{}", model.name(k));
            assert!((still.parameters[k] - model.parameters()[k]).abs() < 1e-9);
        }
        let motions: Vec<Motion> = still.unexcited.iter().map(|one| one.motion).collect();
        assert!(motions.iter().any(|one| matches!(one, Motion::Move(_))));
        let accelerates = |one: &Motion| matches!(one, Motion::Accelerate(_));
        assert!(motions.iter().any(accelerates));
        assert!(!motions.contains(&Motion::None));
        // The residual of what is told is the noise, all the same.
        for after in &still.after {
            assert!(*after < 0.12, "{after}");
        }
        add(&mut data, &model, &only(&model, |_| true, true), &right);
        let moved = fit(&model, &data).unwrap();
        assert!(moved.unexcited.is_empty(), "{}", moved.unexcited[0]);
    }
}

#[test]
fn a_joint_that_never_moved_is_named() {
    let (model, right) = arm("puma560");
    let mut data = Accumulator::new(&model);
    add(&mut data, &model, &only(&model, |i| i != 4, true), &right);
    let fit = fit(&model, &data).unwrap();
    assert!(!fit.unexcited.is_empty());
    for one in &fit.unexcited {
        let said = one.to_string();
        assert!(said.contains("joint 5"), "{said}");
    }
    let mut names = fit.unexcited.iter().map(|one| &one.name);
    assert!(names.any(|name| name.contains("viscous5")));
}
