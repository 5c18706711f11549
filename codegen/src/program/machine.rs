//! The floats that emitted code runs in, and the libraries whose sines and cosines it calls.

use dalembert_model::scalar::Divide;

use super::ScalarType;
use super::kernel::SinCosUse;
use crate::function::Argument;
use crate::states::{JointState, State};

impl JointState {
    /// Returns the state's entries as a machine's numbers, each rounded.
    pub fn numbers<T: Machine>(&self) -> State<T> {
        Argument::ALL.map(|argument| {
            let entries = self.entries(argument).iter();
            entries.map(|&x| T::literal(x)).collect()
        })
    }
}

pub trait Machine: Divide + Copy {
    const SCALAR: ScalarType;
    /// Returns the literal's value: exact, since it was parsed in this type.
    fn literal(value: f64) -> Self;
    /// Returns its value, which a double holds exactly.
    fn to_f64(self) -> f64;
    /// Returns the sine that emitted code calls when it needs no cosine.
    fn sin(self) -> Self;
    /// Returns the cosine that emitted code calls when it needs no sine.
    fn cos(self) -> Self;
    /// Returns the square root, correctly rounded.
    fn root(self) -> Self;
    fn sincos(self) -> (Self, Self);
    /// Returns both for code that calls for all angles together; each angle's bits are its own.
    fn together(self) -> (Self, Self);
}

macro_rules! machine {
    ($t:ident, $scalar:ident, $root:ident, $sin:ident, $cos:ident, $sincos:ident) => {
        impl Machine for $t {
            const SCALAR: ScalarType = ScalarType::$scalar;
            fn literal(value: f64) -> Self {
                value as $t
            }
            fn to_f64(self) -> f64 {
                self.into()
            }
            fn root(self) -> Self {
                libm::$root(self)
            }
            fn sin(self) -> Self {
                libm::$sin(self)
            }
            fn cos(self) -> Self {
                libm::$cos(self)
            }
            fn sincos(self) -> (Self, Self) {
                libm::$sincos(self)
            }
            fn together(self) -> (Self, Self) {
                let ([sin], [cos]) = dalembert_sines::$sincos(&[self]);
                (sin, cos)
            }
        }
    };
}
machine!(f64, F64, sqrt, sin, cos, sincos);
machine!(f32, F32, sqrtf, sinf, cosf, sincosf);

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Library {
    /// libm, an angle a call.
    #[default]
    Libm,
    /// `dalembert-sines`, all angles of a function in one call.
    Together,
}

impl Library {
    pub const ALL: [Library; 2] = [Library::Libm, Library::Together];

    pub fn path(self) -> &'static str {
        match self {
            Library::Libm => "libm",
            Library::Together => "dalembert_sines",
        }
    }

    /// Returns sine and cosine as it computes them, to the last bit.
    pub fn pair<T: Machine>(self, angle: T, need: SinCosUse) -> (T, T) {
        match (self, need.sin, need.cos) {
            (Library::Together, ..) => angle.together(),
            (Library::Libm, true, false) => (angle.sin(), angle),
            (Library::Libm, false, true) => (angle, angle.cos()),
            (Library::Libm, ..) => angle.sincos(),
        }
    }
}
