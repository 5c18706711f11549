//! The library of the sines and cosines that code calls.

use super::kernel::Need;
use super::machine::Machine;

/// The library of the sines and cosines that emitted code calls.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Library {
    /// libm, an angle a call.
    #[default]
    Libm,
    /// `dalembert-sines`, all angles of a function in one call.
    Together,
}

impl Library {
    /// Both.
    pub const ALL: [Library; 2] = [Library::Libm, Library::Together];

    /// Returns the name of its crate.
    pub fn path(self) -> &'static str {
        match self {
            Library::Libm => "libm",
            Library::Together => "dalembert_sines",
        }
    }

    /// Returns sine and cosine as it computes them, to the last bit.
    pub fn pair<T: Machine>(self, angle: T, need: Need) -> (T, T) {
        match (self, need.sin, need.cos) {
            (Library::Together, ..) => angle.together(),
            (Library::Libm, true, false) => (angle.sin(), angle),
            (Library::Libm, false, true) => (angle, angle.cos()),
            (Library::Libm, ..) => angle.sincos(),
        }
    }
}
