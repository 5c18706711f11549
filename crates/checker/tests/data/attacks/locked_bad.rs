#[must_use]
pub fn gravity(q: &[f64; 2]) -> [f64; 1] {
    let c1 = libm::cos(q[0]);
    let s2 = libm::sin(q[1]);
    let t1 = c1 * 19.62;
    let t2 = s2 * 1000.0;
    let t3 = t1 + t2;
    [t3]
}
