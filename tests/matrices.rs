//! Arrays as nalgebra's matrices: rows stay rows, and everything comes back.

use dalembert::matrices::{array, matrix, rows, vector};
use nalgebra::{SMatrix, SVector};

dalembert::dynamics! {
    mod planar2r = "generated/robots/planar2r.toml";
    outputs: inverse_dynamics, state = manipulator_equation + jacobian;
}

#[test]
fn rows_stay_rows() {
    let known = [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]];
    let matrix: SMatrix<f64, 2, 3> = matrix(known);
    let expected = SMatrix::<f64, 2, 3>::new(1.0, 2.0, 3.0, 4.0, 5.0, 6.0);
    assert_eq!(matrix, expected);
    assert_eq!(rows(&matrix), known);
    // The matrix that nalgebra's conversion makes of the same array.
    let turned: SMatrix<f64, 3, 2> = SMatrix::from(known);
    assert_eq!(turned.transpose(), matrix);
    let three = vector([7.0f32, 8.0, 9.0]);
    assert_eq!((array(&three), three[2]), (&[7.0, 8.0, 9.0], 9.0));
}

/// τ = D q̈ + h + c, and power is the same on either side of the Jacobian, which is
/// wide, so that one that were turned would not compile.
#[test]
fn results_are_what_formulas_take() {
    let q = SVector::<f64, 2>::new(0.3, -0.5);
    let qd = SVector::<f64, 2>::new(0.7, 0.2);
    let qdd = SVector::<f64, 2>::new(-0.4, 1.1);
    let state = planar2r::state(array(&q), array(&qd));
    let tau = planar2r::inverse_dynamics(array(&q), array(&qd), array(&qdd));
    let torque = matrix(state.d) * qdd + vector(state.h) + vector(state.c);
    let off = vector(tau) - torque;
    assert!(off.iter().all(|x| x.abs() < 1e-13), "{off}");
    let jacobian: SMatrix<f64, 6, 2> = matrix(state.jacobian);
    let wrench = SVector::<f64, 6>::from_fn(|i, _| 1.0 + i as f64);
    let hand = (jacobian * qd).dot(&wrench);
    assert!((hand - (jacobian.transpose() * wrench).dot(&qd)).abs() < 1e-13);
    // The hand of two links of a metre: dx/dq1 = -y.
    let y = q[0].sin() + (q[0] + q[1]).sin();
    assert!((jacobian[(0, 0)] + y).abs() < 1e-14);
}
