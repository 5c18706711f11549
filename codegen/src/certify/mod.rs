//! Certificates: how far emitted code can be from the full model, proved.
//!
//! - [`trig`]: sines and cosines rounded outward
//! - [`input_box`]: the states for which a bound holds; [`scale`]: what errors
//!   are relative to
//! - [`bound`]: the largest magnitude of a program over a box: written out as
//!   a trigonometric polynomial (`expand`) at a grid (`grid`), or by branch
//!   and bound over polynomials in the rates ([`form`])
//! - [`definite`]: whether D stays positive definite
//! - [`sensitivity`]: what rounding costs; [`ranges`]: how large values become;
//!   over the sub-boxes of `subdivide`, and written out. `distinct`: equal
//!   outputs once
//! - [`sines`]: polynomials for sines, as exact as a tolerance needs
//! - [`prune`]: the cheapest edits that a certificate admits; `regrouping`: the exact
//!   program that they leave least of
//! - [`choose`]: the cheapest variant that a tolerance admits
//! - `work`: work counted, for who cannot wait
//! - [`certificate`]: the claim, its check and its text
//! - [`sample`], [`falsify`]: attempts to refute it
//! - [`gappa`]: scripts for a second opinion on rounding

pub mod bound;
pub mod certificate;
pub mod choose;
pub mod definite;
mod distinct;
mod expand;
pub mod falsify;
pub mod form;
pub mod gappa;
mod grid;
pub mod input_box;
pub mod prune;
pub mod ranges;
mod regrouping;
pub mod sample;
pub mod scale;
pub mod sensitivity;
pub mod sines;
mod subdivide;
pub mod trig;
pub(crate) mod work;
