//! Rigorous bounds over a box of states: mathematics, and nothing of what is
//! searched or claimed.
//!
//! - [`input_box`]: the states for which a bound holds; [`scale`]: what errors
//!   are relative to; [`sample`]: states of a box; [`turns`]: joints without limits
//! - [`magnitude`]: the largest magnitude of a program over a box: written out as
//!   a trigonometric polynomial (`expand`) at a grid (`grid`), or by branch
//!   and bound over polynomials in the rates ([`form`])
//! - [`definite`]: whether D stays positive definite
//! - [`sensitivity`]: what rounding costs; [`ranges`]: how large values become;
//!   over the sub-boxes of `subdivide`, and written out. `distinct`: equal
//!   outputs once
//! - `work`: work counted, for who cannot wait

pub mod definite;
mod distinct;
mod expand;
pub mod form;
mod grid;
pub mod input_box;
pub mod magnitude;
pub mod ranges;
pub mod sample;
pub mod scale;
pub mod sensitivity;
mod subdivide;
pub mod turns;
pub(crate) mod work;
