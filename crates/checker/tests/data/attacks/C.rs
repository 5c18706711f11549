#[must_use]
pub fn inverse_dynamics(q: &[f64; 2], qd: &[f64; 2], qdd: &[f64; 2]) -> [f64; 2] {
    let (s1, c1) = libm::sincos(q[0]);
    let (s2, c2) = libm::sincos(q[1]);
    let t1 = s1 * 9.81;
    let t2 = qd[0] * qd[0];
    let t3 = t1 - t2;
    let t4 = s2 * 0.5;
    let t5 = t3 * t4;
    let t6 = c1 * 9.81;
    let t7 = qdd[0] + t6;
    let t8 = c2 * 0.5;
    let t9 = t7 * t8;
    let t10 = t5 - t9;
    let t11 = qdd[0] + qdd[1];
    let t12 = t11 * 0.3333333333333333;
    let t13 = t10 - t12;
    let t14 = qd[0] + qd[1];
    let t15 = t4 * t14;
    let t16 = t14 * t15;
    let t17 = t13 + t16;
    let t18 = c1 * 14.715;
    let t19 = qdd[0] * 1.3333333333333333;
    let t20 = t18 + t19;
    let t21 = t20 - t17;
    let t22 = t8 * t11;
    let t23 = t21 + t22;
    let t24 = qd[0] - 5.377956782393207e17;
    let t25 = qd[0] - 1.865010374179596e18;
    let t26 = t24 * t25;
    let t27 = qd[0] - 4.003295345114981e17;
    let t28 = t26 * t27;
    let t29 = t28 * -9.961937207394669e-53;
    let t30 = t23 + t29;
    [t30, -t13]
}
