//! Rigorous bounds over a box of states: mathematics, and nothing of what is
//! searched or claimed.
//!
//! - [`input_box`]: the states for which a bound holds; [`scale`]: what errors
//!   are relative to; [`sample`]: states of a box
//! - [`magnitude`]: the largest magnitude of a program over a box: written out as a trigonometric
//!   polynomial (`expand`) at a grid (`grid`), or by branch and bound over polynomials in the rates
//! - [`definite`]: whether D stays positive definite
//! - [`sensitivity`]: what rounding costs, over sub-boxes and written out; what may overflow.
//!   `distinct`: equal outputs once
//! - `corners`: products of velocities at their worst together
//! - `work`: work counted, for who cannot wait

pub(crate) mod corners;
pub(crate) mod definite;
mod distinct;
mod expand;
mod grid;
pub(crate) mod input_box;
pub(crate) mod magnitude;
pub(crate) mod sample;
pub(crate) mod scale;
pub(crate) mod sensitivity;
pub(crate) mod work;
