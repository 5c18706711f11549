//! Y π is the torque of the model's own equations, for π of the robot file.

use dalembert_fit::{Column, Error, Model};
use dalembert_model::reference::Reference;
use nalgebra::DVector;

use crate::support::{ARMS, file, model, states, torques, truth};

#[test]
fn parameters_of_the_file_give_its_torques() {
    for name in ARMS.into_iter().chain(["stanford", "planar3r"]) {
        let truth = truth(name);
        let model = model(&truth);
        let reference = Reference::<f64>::from_robot(&truth);
        for state in states(&model, 20, 5) {
            let vector = |values: &[f64]| DVector::from_column_slice(values);
            let [q, qd, qdd] = [&state.q, &state.qd, &state.qdd].map(|x| vector(x));
            let wanted = reference.inverse_dynamics(&q, &qd, &qdd).unwrap();
            let found = torques(&state.y, model.parameters());
            for (wanted, found) in wanted.iter().zip(&found) {
                let error = (wanted - found).abs();
                assert!(
                    error < 1e-10 * (1.0 + wanted.abs()),
                    "{name}: {wanted} {found}"
                );
            }
        }
    }
}

#[test]
fn rows_have_the_columns_that_are_not_zero() {
    let model = model(&truth("puma560"));
    let lengths: Vec<usize> = (0..6).map(|joint| model.row(joint).len()).collect();
    assert!(
        lengths[1] > lengths[3] && lengths[3] > lengths[5],
        "{lengths:?}"
    );
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
    let path = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../model/tests/data/scara.toml"
    );
    let text = std::fs::read_to_string(path).unwrap();
    let robot = dalembert_model::read::parse(&text).unwrap().robot;
    let slide = (robot.joints.iter())
        .position(|joint| joint.kind == dalembert_model::robot::JointKind::Prismatic)
        .unwrap();
    let model = model(&robot);
    assert!(!model.columns().contains(&Column::Offset(slide)));
    assert!(model.columns().contains(&Column::Offset(0)));
}

#[test]
fn wrong_input_is_told() {
    let model = model(&file("puma560"));
    let six = [0.0; 6];
    let short = model.regressor(&six, &six[1..], &six).unwrap_err();
    assert_eq!(short.to_string(), "`qd` has 5 values instead of 6");
    let not_finite = model.regressor(&six, &six, &[0.0, f64::NAN, 0.0, 0.0, 0.0, 0.0]);
    assert!(matches!(
        not_finite,
        Err(Error::Value {
            argument: "qdd",
            index: 1,
            ..
        })
    ));
    let mut still = file("puma560");
    still.joints[2].limits.velocity = Some(crate::support::number(0.0));
    let why = Model::new(&still).unwrap_err();
    assert!(why.to_string().contains("more than zero"), "{why}");
}
