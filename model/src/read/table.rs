//! The keys of one table: which are there, which are missing, which are not
//! known.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;
use core::ops::Range;

use toml_span::Value;
use toml_span::value::Table;

use super::report::{Sink, quote};
use super::suggest;

/// A table, with the words that messages use for it.
pub(super) struct Keys<'v, 'de> {
    /// Its entries.
    pub(super) table: &'v Table<'de>,
    /// Where to report what is missing.
    pub(super) span: Range<usize>,
    /// Its name in messages: `the robot`, `joint 3`.
    pub(super) what: String,
}

impl<'v, 'de> Keys<'v, 'de> {
    /// Returns the value of an optional key.
    pub(super) fn get(&self, key: &str) -> Option<&'v Value<'de>> {
        self.table.get(key)
    }

    /// Returns the value of a key that must be there.
    pub(super) fn require(&self, key: &str, help: &str, sink: &mut Sink) -> Option<&'v Value<'de>> {
        let value = self.get(key);
        if value.is_none() {
            let message = format!("{} has no `{key}`", self.what);
            sink.error(self.span.clone(), message, help);
        }
        value
    }

    /// Reports every key that is not among the known ones.
    pub(super) fn reject_unknown(&self, known: &[&str], sink: &mut Sink) {
        for key in self.table.keys() {
            if known.contains(&&*key.name) {
                continue;
            }
            // A key that is there already is not what a second one means.
            let free: Vec<&str> = known
                .iter()
                .copied()
                .filter(|known| self.get(known).is_none())
                .collect();
            let help = suggest::for_key(&key.name, &free);
            let help = help.unwrap_or_else(|| format!("{} has: {}", self.what, known.join(", ")));
            let message = format!("unknown key {}", quote(&key.name));
            sink.error(key.span.start..key.span.end, message, &help);
        }
    }
}
