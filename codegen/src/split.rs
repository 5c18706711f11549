//! The error of emitted code by cause.

/// A bound by cause, relative to T.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ErrorByCause {
    /// Terms left out.
    pub model: f64,
    /// Sines and cosines.
    pub sincos: f64,
    /// Operations and constants.
    pub rounding: f64,
}

impl ErrorByCause {
    /// Returns E
    pub fn total(self) -> f64 {
        (self.model + self.sincos + self.rounding) * (1.0 + 1e-15)
    }
}
