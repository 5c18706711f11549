//! Where the parts of a robot are in its file, and which of them were read.

use alloc::collections::{BTreeMap, BTreeSet};
use core::ops::Range;

use crate::robot::Place;

/// Where each part of the robot is in the file.
#[derive(Default)]
pub(super) struct Places {
    spans: BTreeMap<Place, Range<usize>>,
    /// Parts that could not be read: their values are made up, so nothing is
    /// to be said about those.
    unread: BTreeSet<Place>,
}

impl Places {
    /// Notes where a part is and whether it was read, and fills in for it.
    pub(super) fn keep<T>(
        &mut self,
        place: Place,
        span: Range<usize>,
        read: Option<T>,
        or: impl FnOnce() -> T,
    ) -> T {
        self.spans.insert(place, span);
        read.unwrap_or_else(|| {
            self.unread.insert(place);
            or()
        })
    }

    /// Returns whether a part is as the file says, and not made up.
    pub(super) fn was_read(&self, place: Place) -> bool {
        !self.unread.contains(&place)
    }

    /// Returns where a part is, if the file has it.
    pub(super) fn span(&self, place: Place) -> Option<Range<usize>> {
        self.spans.get(&place).cloned()
    }
}
