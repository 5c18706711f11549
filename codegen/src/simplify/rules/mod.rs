//! The rules of the search, as data. `README.md` beside this file says what may
//! be added and what explodes.
//!
//! - [`saturation`]: what the e-graph runs
//! - [`discovery`]: what fingerprints show
//! - [`folding`](crate::graph::rules::folding): what is folded as graphs grow
//!   and when edits are priced

#[cfg_attr(
    not(test),
    expect(
        dead_code,
        reason = "its code is `discover`, and the tests hold it against the table"
    )
)]
pub(crate) mod discovery;
pub(crate) mod saturation;

pub(crate) use saturation::{Phase, SATURATION};

#[cfg(test)]
mod tests;
