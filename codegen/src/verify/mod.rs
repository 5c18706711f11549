//! Checks that trust neither the search nor the printer.
//!
//! Takes a program and its `Setup`; returns a `Proof` that it is the textbook's function, or a
//! `Disproof`, and the errors of its rounding: `Rounding` by an estimate, `Reference` in 256 bits.

pub(crate) mod accuracy;
pub(crate) mod condition;
pub(crate) mod exact;
pub(crate) mod growth;
pub(crate) mod measure;
pub(crate) mod parameters;
mod points;
pub(crate) mod rounding;
pub(crate) mod singular;
pub(crate) mod truth;
