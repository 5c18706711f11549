//! Entries of many states in a slice, wherever they lie.

use crate::error::Error;

/// The places of the entries of an argument or a result in a slice, state by state: entry `k` of
/// state `i` is at `i * state + offsets[k]`. `state` is 0 for an argument that all states share.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// The distance of a state from the one before.
    pub state: usize,
    /// The place of each entry of the first state.
    pub offsets: Vec<usize>,
}

impl Place {
    /// Arrays of states one after the other.
    pub fn rows(entries: usize) -> Place {
        Place {
            state: entries,
            offsets: (0..entries).collect(),
        }
    }

    /// Columns of so many states one after the other.
    pub fn columns(entries: usize, states: usize) -> Place {
        Place {
            state: 1,
            offsets: (0..entries).map(|entry| entry * states).collect(),
        }
    }

    pub(crate) fn entries(&self, state: usize) -> impl Iterator<Item = usize> {
        let first = state * self.state;
        self.offsets.iter().map(move |offset| first + offset)
    }

    pub(crate) fn check(
        &self,
        place: usize,
        entries: usize,
        states: usize,
        length: usize,
    ) -> Result<(), Error> {
        Error::length(place, entries, self.offsets.len())?;
        let (Some(last), Some(&farthest)) = (states.checked_sub(1), self.offsets.iter().max())
        else {
            return Ok(());
        };
        let end = last.checked_mul(self.state);
        let end = end.and_then(|end| end.checked_add(farthest));
        // Offsets of bytes are signed in the code.
        let is_inside = end.is_some_and(|end| end < length) && self.state < isize::MAX as usize / 8;
        Error::Outside { place }.unless(is_inside)
    }

    /// Checks that no two numbers have one place: rows, columns, or a part of such.
    pub(crate) fn check_apart(&self, place: usize, states: usize) -> Result<(), Error> {
        let mut sorted = self.offsets.clone();
        sorted.sort_unstable();
        let gaps = sorted.windows(2).map(|pair| pair[1] - pair[0]);
        let least = gaps.min().unwrap_or(usize::MAX);
        let (Some(first), Some(last)) = (sorted.first(), sorted.last()) else {
            return Ok(());
        };
        let is_row = self.state > last - first;
        let length = states.saturating_sub(1).checked_mul(self.state);
        let is_column = self.state > 0 && length.is_some_and(|length| length < least);
        let is_apart = states == 0 || (least > 0 && (states == 1 || is_row || is_column));
        Error::Overlap { place }.unless(is_apart)
    }
}
