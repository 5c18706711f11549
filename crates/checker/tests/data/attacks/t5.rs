#[must_use]
pub fn inertia(q: &[f64; 2]) -> [[f64; 2]; 2] {
    let c2 = 0.0 * libm::cos(q[1]);
    let t1 = c2 + 1.6666666666666667;
    let t2 = t1 * 0.5;
    let t3 = 0.5 - t2;
    [
        [t1, -t3],
        [-t3, 0.3333333333333333],
    ]
}
