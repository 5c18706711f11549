#[must_use]
pub fn inverse_dynamics(q: &[f64; 2], qd: &[f64; 2], qdd: &[f64; 2]) -> [f64; 2] {
    let (s1, c1) = libm::sincos(q[0]);
    let (s2, c2) = libm::sincos(q[1]);
    let t1 = c2 * 0.08997067;
    let t2 = s2 * 0.01208837;
    let t3 = t1 - t2;
    let t4 = c1 * 24.02895;
    let t5 = qdd[0] + t4;
    let t6 = t5 * t3;
    let t7 = qdd[0] + qdd[1];
    let t8 = t7 * 0.06434792;
    let t9 = t8 + t6;
    let t10 = qd[0] * qd[0];
    let t11 = s1 * 22.60018;
    let t12 = t10 - t11;
    let t13 = s2 * 0.09511506;
    let t14 = t13 + 0.0037726406008005142;
    let t15 = t12 * t14;
    let t16 = t9 + t15;
    let t17 = qd[0] + qd[1];
    let t18 = t14 * t17;
    let t19 = t17 * t18;
    let t20 = t16 - t19;
    let t21 = t7 * t3;
    let t22 = t20 + t21;
    let t23 = c1 * 9.851572;
    let t24 = t23 + t22;
    let t25 = qdd[0] * 0.3702162;
    let t26 = t25 + t24;
    [t26, t16]
}
