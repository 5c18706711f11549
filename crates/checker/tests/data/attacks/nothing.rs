#[must_use]
pub fn coriolis(_q: &[f64; 1], _qd: &[f64; 1]) -> [f64; 1] {
    [0.0]
}
