//! Y π is the torque of the model's own equations, for π of the robot file.

use dalembert_fit::{Column, Model};
use dalembert_model::reference::Reference;
use dalembert_model::robot::JointKind;
use nalgebra::DVector;

use crate::support::{ARMS, TREES, file, model, near, states, torques, truth};

#[test]
fn parameters_of_the_file_give_its_torques() {
    let others = ["stanford", "planar3r"].into_iter().chain(TREES);
    for name in ARMS.into_iter().chain(others) {
        let truth = truth(name);
        let model = model(&truth);
        let reference = Reference::<f64>::from_robot(&truth);
        for state in states(&model, 20, 5) {
            let vector = |values: &[f64]| DVector::from_column_slice(values);
            let [q, qd, qdd] = [&state.q, &state.qd, &state.qdd].map(|x| vector(x));
            let wanted = reference.inverse_dynamics(&q, &qd, &qdd).unwrap();
            let tau = torques(&state.y, model.parameters());
            for (wanted, torque) in wanted.iter().zip(tau) {
                near(torque, *wanted, 1e-10, name);
            }
        }
    }
}

#[test]
fn rows_have_the_columns_that_are_not_zero() {
    let model = model(&truth("puma560"));
    let lengths = [1, 3, 5].map(|joint| model.row(joint).len());
    assert!(lengths.is_sorted_by(|a, b| a > b), "{lengths:?}");
    for state in states(&model, 5, 6) {
        let width = model.columns().len();
        for (joint, row) in state.y.chunks(width).enumerate() {
            for (column, y) in row.iter().enumerate() {
                if !model.row(joint).contains(&column) {
                    assert!(y.abs() < 1e-12, "{joint} {}: {y}", model.name(column));
                }
            }
        }
    }
}

/// The weight of a slide that hangs is a constant torque: its sensor's offset is not told.
#[test]
fn offsets_that_weights_give_as_well_have_no_column() {
    let text = include_str!("../../model/tests/data/scara.toml");
    let robot = dalembert_model::read::parse(text).unwrap().robot;
    let mut joints = robot.joints.iter();
    let slide = joints.position(|joint| joint.kind == JointKind::Prismatic);
    let model = model(&robot);
    assert!(!model.columns().contains(&Column::Offset(slide.unwrap())));
    assert!(model.columns().contains(&Column::Offset(0)));
}

#[test]
fn wrong_input_is_told() {
    let model = model(&file("puma560"));
    let six = [0.0; 6];
    let short = model.regressor(&six, &six[1..], &six).unwrap_err();
    assert_eq!(short.to_string(), "`qd` has 5 values instead of 6");
    let result = model.regressor(&six, &six, &[0.0, f64::NAN, 0.0, 0.0, 0.0, 0.0]);
    let why = result.unwrap_err().to_string();
    assert!(why.starts_with("`qdd[1]` is NaN"), "{why}");
    let mut still = file("puma560");
    still.joints[2].limits.velocity = Some(crate::support::number(0.0));
    let why = Model::new(&still).unwrap_err();
    assert!(why.to_string().contains("more than zero"), "{why}");
}
