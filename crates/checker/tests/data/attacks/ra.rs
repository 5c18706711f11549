#[must_use]
pub fn coriolis(_q: &[f64; 2], _qd: &[f64; 2]) -> [f64; 2] {
    [0.0, 0.0]
}
