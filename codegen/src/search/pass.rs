//! The counts after each step of a search.

use std::fmt;

use crate::program::Counts;

/// The counts after one step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pass {
    /// The step.
    pub name: &'static str,
    /// The counts after it.
    pub counts: Counts,
}

impl Pass {
    /// Every step's name, in order.
    pub const NAMES: [&'static str; 4] = ["traced", "folded", "fingerprints", "search"];
}

impl fmt::Display for Pass {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.name, self.counts)
    }
}
