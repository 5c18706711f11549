//! Programs with less work in them, and how far they are off.
//!
//! - `edit`: what was left out
//! - `difference`: the edited program, and the program of its error
//! - `omissions`: what was left out, one by one

mod difference;
mod edit;
mod omissions;

pub(crate) use difference::deviation;
pub use difference::difference;
pub(crate) use edit::has_edits;
pub use edit::{Edit, EditSite, Stage};
pub use omissions::{Omission, omissions};
