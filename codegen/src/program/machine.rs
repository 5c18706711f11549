//! The floats that emitted code runs in.

use dalembert_model::scalar::Divide;

/// A float that emitted code runs in.
pub trait Machine: Divide + Copy {
    /// The literal's value: exact, since it was parsed in this type.
    fn literal(value: f64) -> Self;
    /// Exact.
    fn to_f64(self) -> f64;
    /// The sine that emitted code calls when it needs no cosine.
    fn sin(self) -> Self;
    /// The cosine that emitted code calls when it needs no sine.
    fn cos(self) -> Self;
    /// Both at once.
    fn sincos(self) -> (Self, Self);
}

macro_rules! machine {
    ($t:ty, $sin:path, $cos:path, $sincos:path) => {
        impl Machine for $t {
            fn literal(value: f64) -> Self {
                value as $t
            }
            fn to_f64(self) -> f64 {
                self.into()
            }
            fn sin(self) -> Self {
                $sin(self)
            }
            fn cos(self) -> Self {
                $cos(self)
            }
            fn sincos(self) -> (Self, Self) {
                $sincos(self)
            }
        }
    };
}
machine!(f64, libm::sin, libm::cos, libm::sincos);
machine!(f32, libm::sinf, libm::cosf, libm::sincosf);
