//! Flat Rust from straight-line programs.
//!
//! - [`literal`]: scalar types and their literals, each rounded once
//! - [`function`]: one program as one function
//! - `sines`: sines and cosines as polynomials
//! - [`parts`]: very long functions, cut into functions of their own
//! - [`module`]: the module of a robot with its header, and of its `scene`
//! - `variant`: what a tolerance left of a function; `scale`: what its errors
//!   are relative to; [`figures`]: numbers rounded to the side that stays true

pub mod figures;
pub mod function;
pub mod literal;
pub mod module;
pub mod parts;
mod scale;
mod scene;
mod sines;
mod variant;

pub use literal::ScalarType;

/// Where emitted code finds `sincos`, `sin` and `cos` (and with an `f` for
/// f32), by path.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MathPath(pub String);

impl Default for MathPath {
    fn default() -> Self {
        MathPath("libm".into())
    }
}
