//! The work that is done for a file: counted, so that it ends at the same place on every machine.

use std::cell::Cell;

use crate::fault::Fault;

/// The work for a file, in about nanoseconds of one processor.
const MOST: u64 = 8_000_000_000;

/// The work that is left.
#[derive(Debug)]
pub struct Work(Cell<u64>);

impl Default for Work {
    fn default() -> Work {
        Work(Cell::new(MOST))
    }
}

impl Work {
    /// Takes work of so many parts, each of about so many nanoseconds.
    ///
    /// # Errors
    /// No more is left.
    pub fn spend(&self, parts: usize, nanoseconds: u64) -> Result<(), Fault> {
        let work = (parts as u64).saturating_mul(nanoseconds);
        let left = self.0.get().checked_sub(work);
        self.0.set(left.unwrap_or(0));
        left.map(|_| ()).ok_or(Fault::Work)
    }

    /// Returns the work that is left.
    pub fn left(&self) -> u64 {
        self.0.get()
    }
}
