//! The lossy search: the cheapest program that a tolerance admits.
//!
//! - [`prune`]: the cheapest edits that a bound admits; `regrouping`: the exact
//!   program that they leave least of; `reduce`: smaller models to start from;
//!   `starts`: which programs are edited, and how often
//! - [`sines`]: polynomials for sines, as exact as a tolerance needs
//! - [`choose`]: the cheapest variant; [`admitted`]: with its certificates; [`error`]: why
//!   there is none
//!
//! Nothing here decides what is true: what comes out is claimed in a certificate,
//! whose check knows nothing of the search.

pub(crate) mod admitted;
pub(crate) mod choose;
pub(crate) mod error;
pub(crate) mod motions;
pub(crate) mod prune;
mod reduce;
mod regrouping;
pub(crate) mod sines;
mod starts;
