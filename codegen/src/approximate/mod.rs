//! Programs with less work in them, and how far they are off.
//!
//! - [`edits`]: what was left out, and the program of its error
//! - [`text`]: edits as plans and certificates write them

pub mod edits;
pub mod text;
