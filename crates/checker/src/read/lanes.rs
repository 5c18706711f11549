//! Loops over lanes, which functions in Rust and in C have, and their arrays.

use super::reader::{MOST_STEPS, Read, Reader};
use super::tokens::whole;
use crate::program::Operand;

const MOST_LANES: usize = 64;

/// A value of an array, once it is written, with whether it is negated: then results alone may read it.
pub(super) type ArrayValue = Option<(bool, Operand<f64>)>;

impl<'r> Reader<'r> {
    /// Takes the indices of an array: a row, and a lane by its number or `l`.
    pub(super) fn entry(&mut self, array: &str) -> Read<[usize; 2]> {
        let rows = self.arrays.get(array).map_or(0, Vec::len);
        let row = self.index(rows)?;
        let lanes = self.arrays[array][row].len();
        match self.lane.filter(|_| self.peek(1) == "l") {
            Some(lane) if lane < lanes => self.expect_all("[l]").map(|()| [row, lane]),
            _ => Ok([row, self.index(lanes)?]),
        }
    }

    /// Takes the rows of an array, behind its head: `[a, b], [c, d], ]`; so many rows and lanes.
    pub(super) fn rows(
        &mut self,
        name: &'r str,
        [open, close]: [&str; 2],
        sizes: Option<[&str; 2]>,
    ) -> Read<()> {
        let mut rows: Vec<Vec<_>> = Vec::new();
        while self.take(open) {
            rows.push(self.list(close, |reader| Ok(Some((false, reader.operand()?))))?);
            self.expect(",")?;
        }
        self.expect(close)?;
        if let Some([count, lanes]) = sizes {
            let has_lanes = rows.iter().all(|row| row.len().to_string() == lanes);
            let is_full = has_lanes && rows.len().to_string() == count;
            self.ensure(is_full, "as many numbers as in the array expected")?;
        }
        self.array(name, rows)
    }

    fn array(&mut self, name: &'r str, rows: Vec<Vec<ArrayValue>>) -> Read<()> {
        let number = name.strip_prefix(['k', 'u', 'w']);
        let is_name = number.and_then(whole).is_some() && self.lane.is_none();
        let is_new = is_name && self.arrays.insert(name, rows).is_none();
        self.ensure(is_new, "another name of an array expected")
    }

    /// Takes the array that a loop writes: `w1` of so many rows and lanes.
    pub(super) fn empty_array(&mut self, name: &'r str, [rows, lanes]: [&str; 2]) -> Read<()> {
        // A leading zero would make it octal in C.
        if let (Some(rows), Some(lanes)) = (whole(rows), whole(lanes))
            && lanes <= MOST_LANES
        {
            // Each entry is the value of a step or stands for one.
            self.entries = self.entries.saturating_add(rows.saturating_mul(lanes));
            if self.entries <= MOST_STEPS {
                return self.array(name, vec![vec![None; lanes]; rows]);
            }
        }
        self.refuse("lengths of an array expected")
    }

    /// Takes a loop behind its head. It is what each lane does, one after the other.
    pub(super) fn lanes(&mut self, lanes: &str, body: impl Fn(&mut Self) -> Read<()>) -> Read<()> {
        let count = whole(lanes).unwrap_or(0);
        let is_loop = self.lane.is_none() && (2..=MOST_LANES).contains(&count);
        self.ensure(is_loop, "a loop over lanes expected")?;
        let (start, names) = (self.at, self.order.len());
        let first = self.function.program.steps.len();
        for lane in 0..count {
            (self.at, self.lane) = (start, Some(lane));
            body(self)?;
            self.expect("}")?;
            self.forget_names(names, &[])?;
        }
        self.lane = None;
        let mut entries = self.arrays.values().flatten().flatten();
        let are_written = entries.all(Option::is_some);
        self.ensure(are_written, "an entry that no lane writes")?;
        let rows = (self.function.program.steps.len() - first) / count;
        self.function.loops.push([first, rows, count]);
        Ok(())
    }

    /// Takes what a lane stores in an array, if that is next: `w1[0][l] = t1;`.
    pub(super) fn takes_store(&mut self) -> Read<bool> {
        let array = self.peek(0);
        if self.lane.is_none() || !self.arrays.contains_key(array) {
            return Ok(false);
        }
        self.next();
        let [row, lane] = self.entry(array)?;
        self.expect("=")?;
        let value = self.signed()?;
        self.expect(";")?;
        let entry = self.arrays.get_mut(array).map(|rows| &mut rows[row][lane]);
        let is_written = entry.is_some_and(|entry| entry.replace(value).is_some());
        self.ensure(!is_written, "an entry is written twice")?;
        Ok(true)
    }
}
