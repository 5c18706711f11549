#[must_use]
pub fn inverse_dynamics(q: &[f64; 2], qd: &[f64; 2], qdd: &[f64; 2]) -> [f64; 2] {
    let (s1, c1) = {
        let x1 = q[0] * q[0];
        let x2 = x1 * 0.0054523216349589365;
        let x3 = x2 - 0.15330166732528136;
        let x4 = x1 * x3;
        let x5 = x4 + 0.9840208008120098;
        let x6 = x1 * 0.024872349639519818;
        let x7 = x6 - 0.44221922089084154;
        let x8 = x1 * x7;
        let x9 = x8 + 0.9694748258918657;
        let x10 = q[0] * x5;
        (x10, x9)
    };
    let (s2, c2) = {
        let x1 = q[1] * q[1];
        let x2 = x1 * 0.0054523216349589365;
        let x3 = x2 - 0.15330166732528136;
        let x4 = x1 * x3;
        let x5 = x4 + 0.9840208008120098;
        let x6 = x1 * 0.024872349639519818;
        let x7 = x6 - 0.44221922089084154;
        let x8 = x1 * x7;
        let x9 = x8 + 0.9694748258918657;
        let x10 = q[1] * x5;
        (x10, x9)
    };
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
    let t24 = t23 + 230.5843009213694;
    [t24, -t13]
}
