//! Charts as SVG: both axes logarithmic, legible in print and on dark pages.
//!
//! - [`axis`]: where values are, and which of them are named
//! - [`picture`]: paper, axes, curves, marks and legend

pub mod axis;
pub mod picture;
