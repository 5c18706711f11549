//! Programs with less work in them, and how far they are off.
//!
//! - `edit`: what was left out
//! - `difference`: the edited program, and the program of its error
//! - [`text`]: edits as plans and certificates write them

mod difference;
mod edit;
pub(crate) mod text;

pub(crate) use difference::deviation;
pub use difference::difference;
pub(crate) use edit::has_edits;
pub use edit::{Edit, EditSite, Stage};
