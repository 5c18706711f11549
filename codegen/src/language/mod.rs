//! Programs as flat text of a language, printed and read back.
//!
//! - [`dialect`]: how a language writes a line, one table for printing and reading
//! - [`c99`]: functions in C, and [`mod@cuda`] what CUDA has besides
//! - [`called`]: sines in C that one call gives
//! - [`columns`]: functions of any number of states in both
//! - [`function`]: one program as one function
//! - [`entries`]: more ways to call it, which share its arithmetic
//! - [`result`]: the array or the struct that it ends with
//! - `scope`: what a line calls values, in a state or in a lane
//! - `trig`: sines and cosines that are called
//! - `sines`: sines and cosines as polynomials
//! - `speed`: what Coulomb friction reads of speeds
//! - [`parts`]: very long functions, cut into functions of their own
//! - [`read`]: the printed text, and whether it is the program

pub(crate) mod c99;
pub(crate) mod called;
pub(crate) mod columns;
pub(crate) mod cuda;
pub(crate) mod dialect;
pub(crate) mod entries;
pub(crate) mod function;
pub(crate) mod names;
pub(crate) mod parts;
pub(crate) mod read;
pub(crate) mod result;
pub(crate) mod scope;
mod sines;
mod speed;
mod trig;

use crate::function::{Argument, Function, Sizes};
use crate::program::{Library, Lowered, Program};
use crate::words::words;
pub use entries::Entries;

words! {
    /// The language of generated code.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
    pub enum Language: "language" {
        /// Rust: modules.
        #[default]
        Rust = "rust",
        /// C99, which C++ reads too: one header.
        C = "c",
        /// CUDA: one header of functions for host and device, and of kernels.
        Cuda = "cuda",
    }
}

/// A function as it is printed: its code over literals, and what it is called with and
/// returns.
#[derive(Clone, Copy, Debug)]
pub struct Printed<'a> {
    /// Which function.
    pub function: Function,
    /// The arguments there are, in order.
    pub arguments: &'a [Argument],
    /// What the lengths of arguments and results follow from.
    pub sizes: Sizes,
    /// What it does.
    pub code: &'a Lowered,
}

impl<'a> Printed<'a> {
    /// Returns a program that was lowered to this code.
    pub fn of(program: &'a Program, code: &'a Lowered) -> Printed<'a> {
        Printed {
            function: program.function,
            arguments: &program.arguments,
            sizes: program.sizes(),
            code,
        }
    }
}

/// Whose sines emitted code calls, and the path where it finds them: `sincos`,
/// `sin` and `cos` of libm's kind, `sincos` of all angles together; each with
/// an `f` for f32.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MathPath {
    /// How they are called.
    pub library: Library,
    /// Where they are.
    pub path: String,
}

impl MathPath {
    /// Functions of libm's names and arguments.
    pub fn libm(path: impl Into<String>) -> MathPath {
        MathPath {
            library: Library::Libm,
            path: path.into(),
        }
    }

    /// Returns a function of all angles together.
    pub fn together(path: impl Into<String>) -> MathPath {
        MathPath {
            library: Library::Together,
            path: path.into(),
        }
    }

    /// Returns the library by the name of its crate.
    pub fn of(library: Library) -> MathPath {
        match library {
            Library::Libm => MathPath::libm("libm"),
            Library::Together => MathPath::together("dalembert_sines"),
        }
    }
}

impl Default for MathPath {
    fn default() -> Self {
        MathPath::of(Library::default())
    }
}
