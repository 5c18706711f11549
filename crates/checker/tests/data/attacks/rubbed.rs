#[must_use]
pub fn coriolis(_q: &[f64; 1], qd: &[f64; 1]) -> [f64; 1] {
    let r1 = 1.0 / libm::sqrt(qd[0] * qd[0] + 0.01);
    let t1 = r1 * 9.0;
    [t1]
}
