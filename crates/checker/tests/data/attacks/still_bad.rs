#[must_use]
pub fn gravity(_q: &[f64; 2]) -> [f64; 2] {
    [0.0, 0.0]
}
