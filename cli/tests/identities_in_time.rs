//! Identities along a motion: Ḋ − 2C is skew-symmetric, and a passive arm keeps its energy.

use dalembert_codegen::workspace::{Emitted, JointState, seeded};
use dalembert_codegen::{Function, Request, ScalarType, generate};
use dalembert_generated::puma560::manipulator_equation;
use dalembert_model::equations::{Arm, Formulation, JointPosition};
use dalembert_model::number::Wide;
use dalembert_model::reference::Reference;
use dalembert_model::robot::{JointKind, Robot};
use dalembert_model::scalar::dual::Dual;
use nalgebra::{DMatrix, DVector, SMatrix, SVector};

use crate::robots::robot;

/// Returns code for D and the symbols h_ikm.
fn coefficients(robot: &Robot) -> Emitted {
    let request = Request {
        scalars: vec![ScalarType::F64],
        ..Request::new(&[Function::DynamicCoefficients])
    };
    generate(robot, &request).unwrap().emitted.remove(0)
}

/// Returns C_ik = Σ_m h_ikm q̇_m
fn coriolis(code: &Emitted, state: &JointState) -> DMatrix<f64> {
    let n = state.q.len();
    let results = code.run(state);
    let h = results[n * n..n * n + n * n * n].chunks(n);
    let entries = h.map(|h| h.iter().zip(&state.qd).map(|(h, v)| h * v).sum());
    DMatrix::from_row_iterator(n, n, entries)
}

/// Returns Ḋ by dual numbers through a formula for D. It uses the wide float: in doubles
/// the textbook formulas themselves lose up to 90 u of Ḋ by cancellation.
fn inertia_rate(robot: &Robot, state: &JointState) -> DMatrix<f64> {
    let arm = Arm::from_robot(robot, &mut |x| Dual::constant(Wide::from_exact(x)));
    let joints = robot.joints.iter().zip(state.q.iter().zip(&state.qd));
    let position = joints.map(|(joint, (&q, &qd))| {
        let [value, rate] = [q, qd].map(|x| Wide::from_f64(x).unwrap());
        match joint.kind {
            JointKind::Revolute => {
                JointPosition::Revolute(Wide::sincos_of(q).unwrap().turning(&rate))
            }
            JointKind::Prismatic => JointPosition::Prismatic(Dual { value, rate }),
        }
    });
    let position: Vec<_> = position.collect();
    let d = Formulation::Dalembert.inertia(&arm, &arm.at(&position));
    let rates = d.iter().flatten().map(|d| d.rate.to_f64());
    DMatrix::from_row_iterator(d.len(), d.len(), rates)
}

const U: f64 = f64::EPSILON / 2.0;

/// Returns |S + Sᵀ| and q̇ᵀ S q̇ / |q̇|² for S = Ḋ − 2C, in u of the larger of Ḋ and 2C.
fn asymmetry(rate: &DMatrix<f64>, c: &DMatrix<f64>, qd: &[f64]) -> [f64; 2] {
    let s = rate - 2.0 * c;
    let qd = DVector::from_column_slice(qd);
    let unit = U * rate.amax().max(2.0 * c.amax());
    let power = qd.dot(&(&s * &qd)).abs() / qd.dot(&qd);
    [(&s + s.transpose()).amax() / unit, power / unit]
}

#[test]
fn inertia_rate_less_twice_coriolis_is_skew() {
    for name in [
        "puma560", "stanford", "ur10", "panda", "planar2r", "planar3r",
    ] {
        let robot = robot(name);
        let code = coefficients(&robot);
        let mut worst = 0.0f64;
        for state in seeded(&robot, 100, 0x5e) {
            let (rate, c) = (inertia_rate(&robot, &state), coriolis(&code, &state));
            worst = worst.max(asymmetry(&rate, &c, &state.qd)[0]);
        }
        println!("{name}: Ḋ − 2C is skew but for {worst:.1} u");
        assert!(worst <= 50.0, "{name}: {worst} u");
    }
}

/// A wrong C with the right C q̇, and so the right h: q̇ᵀ(Ḋ − 2C)q̇ = 0 does not show
/// the error, the full matrix does.
#[test]
fn a_wrong_coriolis_matrix_is_noticed() {
    let robot = robot("puma560");
    let code = coefficients(&robot);
    for state in seeded(&robot, 20, 0x5f) {
        let mut c = coriolis(&code, &state);
        // Adds a vector perpendicular to q̇ to a row.
        c[(2, 0)] += state.qd[1];
        c[(2, 1)] -= state.qd[0];
        let [full, power] = asymmetry(&inertia_rate(&robot, &state), &c, &state.qd);
        assert!(power <= 50.0 && full * U > 1e-3, "{power} {full}");
    }
}

/// 10 s of passive motion, RK4 at 1 ms: the energy drifts by less than 10⁻⁸ of the potential's span.
#[test]
fn a_passive_arm_keeps_its_energy() {
    type Vector = SVector<f64, 6>;
    let potential = Reference::<f64>::from_robot(&robot("puma560"));
    let potential = |q: &Vector| {
        let q = DVector::from_column_slice(q.as_slice());
        potential.potential_energy(&q).unwrap()
    };
    let motion = |q: &Vector, qd: &Vector| {
        let m = manipulator_equation(&q.data.0[0], &qd.data.0[0]);
        let d = SMatrix::<f64, 6, 6>::from(m.d);
        (d, Vector::from(m.h) + Vector::from(m.c))
    };
    let rates = |q: &Vector, qd: &Vector| {
        let (d, load) = motion(q, qd);
        // Solves by elimination without pivoting: D is positive definite.
        let mut rows = d.insert_column(6, 0.0);
        rows.set_column(6, &-load);
        for i in 0..6 {
            let pivot = rows.row(i) / rows[(i, i)];
            for k in 0..6 {
                let factor = rows[(k, i)] - f64::from(k == i);
                let cleared = rows.row(k) - pivot * factor;
                rows.set_row(k, &cleared);
            }
        }
        Vector::from(rows.column(6))
    };
    let dt = 1e-3f64;
    let mut q = Vector::from([0.3, -0.5, 0.4, 0.2, -0.6, 0.1]);
    let mut qd = Vector::zeros();
    let (mut energies, mut potentials) = (Vec::new(), Vec::new());
    for _ in 0..10_000 {
        let at = potential(&q);
        energies.push(0.5 * qd.dot(&(motion(&q, &qd).0 * qd)) + at);
        potentials.push(at);
        let (v1, a1) = (qd, rates(&q, &qd));
        let v2 = qd + a1 * (dt / 2.0);
        let a2 = rates(&(q + v1 * (dt / 2.0)), &v2);
        let v3 = qd + a2 * (dt / 2.0);
        let a3 = rates(&(q + v2 * (dt / 2.0)), &v3);
        let v4 = qd + a3 * dt;
        let a4 = rates(&(q + v3 * dt), &v4);
        q += (v1 + (v2 + v3) * 2.0 + v4) * (dt / 6.0);
        qd += (a1 + (a2 + a3) * 2.0 + a4) * (dt / 6.0);
    }
    let span = |values: &[f64]| {
        let largest = values.iter().copied().fold(f64::MIN, f64::max);
        largest - values.iter().copied().fold(f64::MAX, f64::min)
    };
    let drift = span(&energies) / span(&potentials);
    println!("energy drift over the potential's span: {drift:.1e}");
    assert!(drift <= 1e-8, "{drift:e}");
}
