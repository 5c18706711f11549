//! The rules of the search, as data. `README.md` beside this file says what may
//! be added and what explodes.
//!
//! - [`saturation`]: what the e-graph runs
//! - [`discovery`]: what fingerprints show
//! - [`folding`](crate::graph::rules::folding): what is folded as graphs grow
//!   and when edits are priced

pub mod discovery;
pub mod saturation;

pub use discovery::DISCOVERY;
pub use saturation::{Phase, SATURATION};

#[cfg(test)]
mod tests;
