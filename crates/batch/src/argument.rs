//! Arguments of a batch: numbers in columns, or in rows.

use core::array::from_fn;
use core::ops::{Deref, Range};

use crate::vector::BLOCK;
use crate::{Slice, Unequal};

/// An argument of a batch.
#[derive(Clone, Copy)]
pub enum Argument<'a, T> {
    /// A slice for each entry, with a number a state.
    Columns(&'a [&'a [T]]),
    /// A row with all entries for each state, or one row for all states.
    Rows(&'a dyn Rows<T>),
}

/// Rows of numbers of one length, such as `&[Load]` of generated code.
pub trait Rows<T>: Sync {
    /// Returns the number of rows.
    fn count(&self) -> usize;
    /// Returns a row; nothing beyond the last.
    fn row(&self, row: usize) -> &[T];
}

impl<T: Sync, D, const L: usize> Rows<T> for &[D]
where
    D: Deref<Target = [T; L]> + Sync,
{
    fn count(&self) -> usize {
        self.len()
    }
    fn row(&self, row: usize) -> &[T] {
        self.get(row).map_or(&[], |row| &row[..])
    }
}

/// The place of an entry's numbers: a slice, or a place in the row of each state.
#[derive(Clone, Copy)]
enum Source<'a, T> {
    Column(&'a [T]),
    Row(usize),
}

/// All entries of all arguments, E of them, of which R come in rows.
#[derive(Clone, Copy)]
pub(crate) struct Entries<'a, T, const E: usize, const R: usize> {
    sources: [Source<'a, T>; E],
    arguments: &'a [Argument<'a, T>],
    /// The state whose rows are those of the first number of a column.
    first: usize,
}

/// The entries that come in rows, as columns of a block's states.
pub(crate) type RowBlocks<T, const R: usize> = [[T; BLOCK]; R];

impl<'a, T: Copy, const E: usize, const R: usize> Entries<'a, T, E, R> {
    pub(crate) fn of(arguments: &'a [Argument<'a, T>], states: usize) -> Result<Self, Unequal> {
        let (mut sources, mut count, mut rows) = ([Source::Column(&[][..]); E], 0, 0);
        let mut push = |source| {
            if let Some(place) = sources.get_mut(count) {
                *place = source;
            }
            count += 1;
        };
        for (index, argument) in (1..).zip(arguments) {
            match argument {
                Argument::Columns(columns) => {
                    for (entry, column) in (1..).zip(*columns) {
                        Unequal::check(Slice::Entry(index, entry), column.len(), states)?;
                        push(Source::Column(column));
                    }
                }
                Argument::Rows(argument_rows) => {
                    if argument_rows.count() != 1 {
                        Unequal::check(Slice::Rows(index), argument_rows.count(), states)?;
                    }
                    for _ in argument_rows.row(0) {
                        push(Source::Row(rows));
                        rows += 1;
                    }
                }
            }
        }
        if states > 0 {
            Unequal::check(Slice::Arguments, count, E)?;
            Unequal::check(Slice::InRows, rows, R)?;
        }
        Ok(Entries {
            sources,
            arguments,
            first: 0,
        })
    }

    pub(crate) fn at(&self, states: Range<usize>) -> Self {
        let of_columns = |source: Source<'a, T>| match source {
            Source::Column(column) => {
                Source::Column(column.get(states.clone()).unwrap_or_default())
            }
            Source::Row(place) => Source::Row(place),
        };
        Entries {
            sources: self.sources.map(of_columns),
            arguments: self.arguments,
            first: self.first + states.start,
        }
    }

    /// Writes the rows of a block of states; those that hold for all states only for the first.
    #[inline(never)]
    pub(crate) fn fill(
        &self,
        blocks: &mut RowBlocks<T, R>,
        is_first: bool,
        state_at: impl Fn(usize) -> usize,
    ) {
        let mut begin = 0;
        for argument in self.arguments {
            let Argument::Rows(rows) = argument else {
                continue;
            };
            let is_shared = rows.count() == 1;
            let lanes = if is_shared && !is_first { 0 } else { BLOCK };
            for lane in 0..lanes {
                let state = match is_shared {
                    true => 0,
                    false => self.first + state_at(lane),
                };
                for (block, number) in blocks.iter_mut().skip(begin).zip(rows.row(state)) {
                    block[lane] = *number;
                }
            }
            begin += rows.row(0).len();
        }
    }

    /// Returns the entries at the block of states that begins at one. It ends early where there is
    /// none: of a loop that did not, compilers would make vectors of addresses, which are slower.
    #[inline(always)]
    pub(crate) fn block<'b>(
        &self,
        begin: usize,
        rows: &'b RowBlocks<T, R>,
    ) -> Option<[&'b [T; BLOCK]; E]>
    where
        'a: 'b,
    {
        let source = |entry: usize| match *self.sources.get(entry)? {
            Source::Column(column) => column.get(begin..)?.first_chunk(),
            Source::Row(place) => rows.get(place),
        };
        let mut block = [source(0)?; E];
        let mut entry = 1;
        while entry < E {
            block[entry] = source(entry)?;
            entry += 1;
        }
        Some(block)
    }

    /// Returns blocks that end with the last of a few states, before which the first stands: of a
    /// state that somebody asked for, no library's slow path is taken that would not be taken anyway.
    pub(crate) fn few(&self, states: usize) -> [[T; BLOCK]; E]
    where
        T: Default,
    {
        let state_at = |lane: usize| (lane + states).saturating_sub(BLOCK);
        let mut rows = [[T::default(); BLOCK]; R];
        self.fill(&mut rows, true, state_at);
        self.sources.map(|source| match source {
            Source::Column(column) => from_fn(|lane| column[state_at(lane)]),
            Source::Row(place) => rows[place],
        })
    }

    pub(crate) fn of_blocks(blocks: &'a [[T; BLOCK]; E]) -> Self {
        Entries {
            sources: blocks.each_ref().map(|block| Source::Column(&block[..])),
            arguments: &[],
            first: 0,
        }
    }
}
