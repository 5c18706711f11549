//! What is reported about a robot and the code generated for it: nothing that
//! a user of the macro compiles.
//!
//! - [`couplings`]: the coefficients that vanish or repeat
//! - [`stress`]: stability at the extremes, against a float of 256 bits
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
pub mod states;
pub mod stress;
pub mod sweep;
pub mod table3;
