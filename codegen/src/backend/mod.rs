//! Programs as flat Rust, printed and read back.
//!
//! - [`function`]: one program as one function
//! - `statement`: one operation as one line
//! - `sines`: sines and cosines as polynomials
//! - [`parts`]: very long functions, cut into functions of their own
//! - [`read`]: the printed text, and whether it is the program

pub mod function;
pub mod parts;
pub mod read;
mod sines;
mod statement;

/// Where emitted code finds `sincos`, `sin` and `cos` (and with an `f` for
/// f32), by path.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MathPath(pub String);

impl Default for MathPath {
    fn default() -> Self {
        MathPath("libm".into())
    }
}
