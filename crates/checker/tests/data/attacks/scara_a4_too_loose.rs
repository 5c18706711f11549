#[must_use]
pub fn inverse_dynamics(q: &[f32; 4], qd: &[f32; 4], qdd: &[f32; 4]) -> [f32; 4] {
    let (s2, c2) = libm::sincosf(q[1]);
    let (s4, c4) = libm::sincosf(q[3]);
    let t1 = qdd[0] + qdd[1];
    let t2 = t1 * 0.8636179;
    let t3 = qd[0] * qd[0];
    let t4 = s2 * t3;
    let t5 = t2 + t4;
    let t6 = qdd[0] * c2;
    let t7 = t5 + t6;
    let t8 = t7 * 2.831843;
    let t9 = c2 * t3;
    let t10 = qdd[0] * s2;
    let t11 = t10 - t9;
    let t12 = t11 * 0.5352765;
    let t13 = t1 - t12;
    let t14 = t13 + t8;
    let t15 = qd[0] + qd[1];
    let t16 = t15 * t15;
    let t17 = t16 * 0.6842679;
    let t18 = t17 - t8;
    let t19 = c2 * t18;
    let t20 = t14 - t19;
    let t21 = t11 - t17;
    let t22 = t21 * 2.380745;
    let t23 = t22 - t2;
    let t24 = t16 - t23;
    let t25 = s2 * t24;
    let t26 = qdd[0] - t25;
    let t27 = t26 + t20;
    let t28 = qdd[2] * 16.15;
    let t29 = 158.4315 - t28;
    let t30 = s4 * 0.06325606;
    let t31 = c4 * 0.09024021;
    let t32 = t30 + t31;
    let t33 = t7 * t32;
    let t34 = t1 - qdd[3];
    let t35 = t34 * 0.04969512;
    let t36 = t35 + t33;
    let t37 = s4 * 0.1030549;
    let t38 = c4 * 0.0746616;
    let t39 = t37 - t38;
    let t40 = t21 * t39;
    let t41 = t40 + t36;
    [t27, t14, -t29, -t41]
}
