//! What is reported about a robot and the code generated for it: nothing that
//! a user of the macro compiles.
//!
//! - [`couplings`]: the coefficients that vanish or repeat
//! - [`measure`]: rounding, against 256-bit arithmetic
//! - [`extremes`]: rounding where robots are not, and next to a singular D
//! - [`explain`]: what each step brought, and why
//! - [`drawing`]: the arm in two views, as SVG
//! - [`states`]: given states compared with the code
//! - [`table3`]: the paper's counts beside the formulas'
//! - [`sweep`]: certified error against operations, tolerance by tolerance
#![forbid(unsafe_code)]
#![warn(missing_docs, clippy::missing_errors_doc)]

pub mod couplings;
pub mod drawing;
pub mod explain;
pub mod extremes;
pub mod measure;
pub mod states;
pub mod sweep;
pub mod table3;
