//! What data do not tell is named, with a motion that tells it.

use dalembert_fit::unexcited::Motion;
use dalembert_fit::{Accumulator, Prior, fit};

use crate::support::{ARMS, State, guess, model, states, torques, true_parameters, truth};

/// States of a part of the motion.
fn only(
    model: &dalembert_fit::Model,
    moves: impl Fn(usize) -> bool,
    accelerates: bool,
) -> Vec<State> {
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

fn add(data: &mut Accumulator, model: &dalembert_fit::Model, some: &[State], right: &[f64]) {
    let mut random = dalembert_fit::random::Random::new(5);
    for state in some {
        let mut tau = torques(&state.y, right);
        for tau in &mut tau {
            *tau += 0.1 * dalembert_fit::random::normal(&mut random);
        }
        data.add_rows(model, &state.y, &tau).unwrap();
    }
}

/// An arm that stands still tells weights alone; the friction of each joint is named with the
/// joint that has to move.
#[test]
fn poses_tell_weights_alone() {
    for name in ARMS {
        let truth = truth(name);
        let model = model(&guess(&truth));
        let right = true_parameters(&truth);
        let mut data = Accumulator::new(&model);
        add(&mut data, &model, &only(&model, |_| false, false), &right);
        let still = fit(&model, &data, &Prior::None).unwrap();
        assert!(still.condition > 1e12);
        let friction: Vec<usize> = (0..model.columns().len())
            .filter(|k| model.name(*k).starts_with("coulomb"))
            .collect();
        for k in &friction {
            assert_eq!(
                still.standard_errors[*k],
                f64::INFINITY,
                "{}",
                model.name(*k)
            );
            assert!((still.parameters[*k] - model.parameters()[*k]).abs() < 1e-9);
        }
        assert!(
            still
                .unexcited
                .iter()
                .any(|one| matches!(one.motion, Motion::Move(_)))
        );
        assert!(
            still
                .unexcited
                .iter()
                .any(|one| matches!(one.motion, Motion::Accelerate(_)))
        );
        assert!(still.unexcited.iter().all(|one| one.motion != Motion::None));
        // The residual of what is told is the noise, all the same.
        for after in &still.after {
            assert!(*after < 0.12, "{after}");
        }
        add(&mut data, &model, &only(&model, |_| true, true), &right);
        let moved = fit(&model, &data, &Prior::None).unwrap();
        assert!(moved.unexcited.is_empty(), "{}", moved.unexcited[0]);
    }
}

/// A joint that never moved: what is said names it, and moving it helps.
#[test]
fn a_joint_that_never_moved_is_named() {
    let truth = truth("puma560");
    let model = model(&guess(&truth));
    let right = true_parameters(&truth);
    let mut data = Accumulator::new(&model);
    add(&mut data, &model, &only(&model, |i| i != 4, true), &right);
    let found = fit(&model, &data, &Prior::None).unwrap();
    assert!(!found.unexcited.is_empty());
    for one in &found.unexcited {
        let said = one.to_string();
        assert!(said.contains("joint 5"), "{said}");
    }
    let names: Vec<&str> = found.unexcited.iter().map(|one| &*one.name).collect();
    assert!(
        names.iter().any(|name| name.contains("viscous5")),
        "{names:?}"
    );
}

/// A ridge tells what data do not.
#[test]
fn a_prior_excites_everything() {
    let truth = truth("ur10");
    let model = model(&guess(&truth));
    let mut data = Accumulator::new(&model);
    add(
        &mut data,
        &model,
        &only(&model, |_| false, false),
        &true_parameters(&truth),
    );
    let prior = Prior::File(vec![0.5; model.columns().len()]);
    let found = fit(&model, &data, &prior).unwrap();
    for error in &found.standard_errors {
        assert!(*error <= 0.5 * (1.0 + 1e-9), "{error}");
    }
}

/// A prior of which nothing is known of friction tells all else, and not friction.
#[test]
fn a_prior_tells_what_it_is_finite_for() {
    let truth = truth("ur10");
    let model = model(&guess(&truth));
    let mut data = Accumulator::new(&model);
    let still = only(&model, |_| false, false);
    add(&mut data, &model, &still, &true_parameters(&truth));
    let friction = |k: usize| {
        let name = model.name(k);
        name.starts_with("coulomb") || name.starts_with("viscous")
    };
    let columns = 0..model.columns().len();
    let each = columns.clone().map(|k| match friction(k) {
        true => f64::INFINITY,
        false => 0.5,
    });
    let found = fit(&model, &data, &Prior::File(each.collect())).unwrap();
    for k in columns.clone() {
        assert_eq!(found.standard_errors[k].is_finite(), !friction(k), "{k}");
    }
    assert_eq!(found.unexcited.len(), 12);
    // One that is finite for nothing is none.
    let nothing = Prior::File(columns.map(|_| f64::INFINITY).collect());
    let [with, without] = [nothing, Prior::None].map(|prior| fit(&model, &data, &prior).unwrap());
    assert_eq!(with.parameters, without.parameters);
    assert_eq!(with.standard_errors, without.standard_errors);
    assert_eq!(with.unexcited, without.unexcited);
}
