#[must_use]
pub fn gravity(q: &[f64; 1]) -> [f64; 1] {
    [-q[0]]
}
