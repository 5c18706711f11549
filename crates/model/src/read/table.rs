//! Tables of the file: keys that are there, missing or unknown, and the places of values.

use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use core::ops::Range;

use toml_span::Value;
use toml_span::value::{Key, Table as Entries};

use super::report::quote;
use super::value::{Context, bytes_of, first_line};
use crate::diagnostic::suggest;

pub(super) struct Table<'v> {
    entries: &'v Entries<'v>,
    pub(super) place: String,
    /// The span of the error about a missing key.
    pub(super) span: Range<usize>,
    /// Its name in messages: `the robot`, `joint 3`.
    name: String,
    known: Vec<&'static str>,
}

impl<'v> Table<'v> {
    pub(super) fn open(
        cx: &mut Context,
        value: &'v Value<'v>,
        place: impl Into<String>,
        name: impl Into<String>,
        help: &str,
    ) -> Option<Self> {
        let Some(entries) = value.as_table() else {
            return cx.wanted(value, "a table", help);
        };
        Some(Table {
            entries,
            place: place.into(),
            span: first_line(&cx.sink.source, bytes_of(value.span)),
            name: name.into(),
            known: Vec::new(),
        })
    }

    pub(super) fn entries(&self) -> Vec<(&'v Key<'v>, &'v Value<'v>)> {
        in_order(self.entries)
    }

    /// Returns the value of a key, which is a known one from now on.
    pub(super) fn get(&mut self, key: &'static str) -> Option<&'v Value<'v>> {
        if !self.known.contains(&key) {
            self.known.push(key);
        }
        self.entries.get(key)
    }

    /// Nothing more is reported at the place of a value that cannot be read.
    pub(super) fn optional<T>(
        &mut self,
        cx: &mut Context,
        key: &'static str,
        read: impl FnOnce(&mut Context, &'v Value<'v>) -> Option<T>,
    ) -> Option<T> {
        let read = read(cx, self.get(key)?);
        if read.is_none() {
            cx.unread.push(self.place_of(key));
        }
        read
    }

    pub(super) fn required<T>(
        &mut self,
        cx: &mut Context,
        key: &'static str,
        help: &str,
        read: impl FnOnce(&mut Context, &'v Value<'v>) -> Option<T>,
    ) -> Option<T> {
        if self.get(key).is_none() {
            let message = format!("{} has no `{key}`", self.name);
            cx.sink.error(self.span.clone(), message, help);
            cx.unread.push(self.place_of(key));
        }
        self.optional(cx, key, read)
    }

    /// Reports the keys that `read` does not ask for.
    pub(super) fn table<T>(
        &mut self,
        cx: &mut Context,
        key: &'static str,
        help: &str,
        read: impl FnOnce(&mut Context, &mut Table<'v>) -> Option<T>,
    ) -> Option<T> {
        let place = self.place_of(key);
        self.optional(cx, key, |cx, value| {
            let mut table = Table::open(cx, value, place, key, help)?;
            let read = read(cx, &mut table);
            table.finish(cx);
            read
        })
    }

    pub(super) fn place_of(&self, key: &str) -> String {
        match self.place.as_str() {
            "" => key.to_string(),
            place => format!("{place}/{key}"),
        }
    }

    pub(super) fn finish(self, cx: &mut Context) {
        for key in self.entries.keys() {
            if self.known.contains(&&*key.name) {
                continue;
            }
            // A key that is there already is not what a second one means.
            let is_free = |key: &&str| !self.entries.contains_key(*key);
            let free: Vec<&str> = self.known.iter().copied().filter(is_free).collect();
            let help = suggest::for_key(&key.name, &free)
                .unwrap_or_else(|| format!("{} has: {}", self.name, self.known.join(", ")));
            let message = format!("unknown key {}", quote(&key.name));
            cx.sink.error(bytes_of(key.span), message, &help);
        }
    }
}

fn in_order<'v>(entries: &'v Entries<'v>) -> Vec<(&'v Key<'v>, &'v Value<'v>)> {
    let mut entries: Vec<_> = entries.iter().collect();
    entries.sort_by_key(|(key, _)| key.span.start);
    entries
}

/// Returns the bytes of the value at a place in `value`, which has these `bytes`: those of the
/// table around it, or of the key that stands for it, where the file leaves it out.
pub(super) fn locate<'v>(
    mut value: &'v Value<'v>,
    mut bytes: Range<usize>,
    source: &str,
    place: &str,
) -> Range<usize> {
    for step in place.split('/') {
        let instead = match step {
            "coulomb_width" => "coulomb",
            "alpha" | "beta" | "a" | "d" | "theta" | "offset" => "placement",
            _ => "",
        };
        let number: Option<usize> = step.strip_prefix('#').and_then(|step| step.parse().ok());
        let index = number.and_then(|number| number.checked_sub(1));
        let child = match (value.as_table(), value.as_array(), index) {
            (Some(entries), _, Some(index)) => in_order(entries)
                .get(index)
                .map(|(key, value)| (key.span.start..bytes_of(value.span).end, *value)),
            (Some(entries), ..) => {
                let entry = entries.get(step).or_else(|| entries.get(instead));
                entry.map(|value| (bytes_of(value.span), value))
            }
            (_, Some(items), Some(index)) => {
                items.get(index).map(|item| (bytes_of(item.span), item))
            }
            _ => None,
        };
        let Some(next) = child else { break };
        (bytes, value) = next;
    }
    first_line(source, bytes)
}
