#[must_use]
pub fn inertia(q: &[f64; 2]) -> [[f64; 2]; 2] {
    let c2 = libm::cos(q[1]);
    let [t1, t3] = {
    #[inline(never)]
    fn part([c2]: [f64; 1]) -> [f64; 2] { return [7.0, 7.0];
    let t1 = c2 + 1.6666666666666667;
    let t2 = t1 * 0.5;
    let t3 = 0.5 - t2;
    [t1, t3]
    }
    part([c2])
    };
    [
        [t1, -t3],
        [-t3, 0.3333333333333333],
    ]
}
