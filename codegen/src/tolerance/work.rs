//! The work of a search, counted so that it can be limited.
//!
//! A unit is 64 products and sums: some hundredths of a microsecond. Units
//! are counted where the time goes and never timed, so that a limit ends a search at the same place
//! on every machine. A thread counts its own.

use std::cell::Cell;

thread_local! {
    static DONE: Cell<u64> = const { Cell::new(0) };
}

/// Products and sums of a unit.
pub(super) const UNIT: usize = 64;

pub(super) fn count(units: usize) {
    DONE.set(DONE.get().wrapping_add(units as u64));
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct Meter {
    from: u64,
    limit: u64,
}

impl Meter {
    pub(crate) fn new(limit: Option<u64>) -> Meter {
        Meter {
            from: DONE.get(),
            limit: limit.unwrap_or(u64::MAX),
        }
    }

    pub(crate) fn done(self) -> u64 {
        DONE.get().wrapping_sub(self.from)
    }

    pub(super) fn is_over(self) -> bool {
        self.done() > self.limit
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn work_is_counted_from_the_beginning_of_a_meter() {
        count(5);
        let meter = Meter::new(Some(7));
        count(7);
        assert!(meter.done() == 7 && !meter.is_over());
        count(1);
        assert!(meter.is_over() && !Meter::new(Some(0)).is_over());
        assert!(!Meter::new(None).is_over());
    }
}
