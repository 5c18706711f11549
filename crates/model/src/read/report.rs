//! Collects the diagnostics of a robot file, each at its line.

use alloc::boxed::Box;
use alloc::collections::BTreeSet;
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use core::ops::Range;

use super::{Diagnostics, Reading, RobotWarning};
use crate::diagnostic::{Diagnostic, Excerpt, Place};

/// More errors than this are counted, not listed.
const MAX_LISTED: usize = 200;

pub(super) struct Sink {
    pub(super) source: String,
    line_starts: Vec<usize>,
    diagnostics: Vec<Diagnostic>,
    pub(super) allowed: BTreeSet<RobotWarning>,
}

impl Sink {
    pub(super) fn new(source: &str) -> Self {
        let later_lines = source.match_indices('\n').map(|(newline, _)| newline + 1);
        Sink {
            source: source.to_string(),
            line_starts: core::iter::once(0).chain(later_lines).collect(),
            diagnostics: Vec::new(),
            allowed: BTreeSet::new(),
        }
    }

    pub(super) fn error(&mut self, span: Range<usize>, message: String, help: &str) {
        self.place(Diagnostic::error(message).with_help(help), span);
    }

    /// Adds a diagnostic about these bytes; the help for a warning says how it is silenced.
    pub(super) fn place(&mut self, mut diagnostic: Diagnostic, span: Range<usize>) {
        if let Some(name) = diagnostic.warning {
            let help = diagnostic.help.unwrap_or_default();
            diagnostic.help = Some(format!("{help}; allow = [\"{name}\"] silences this"));
        }
        let line = self.line(span.start);
        let start = self.line_starts.get(line - 1).copied().unwrap_or_default();
        let place = Place::Text(Box::new(Excerpt::new(&self.source, span, line, start)));
        self.diagnostics.push(diagnostic.at(place));
    }

    /// Counts from one.
    pub(super) fn line(&self, byte: usize) -> usize {
        self.line_starts.partition_point(|start| *start <= byte)
    }

    /// Errors come alone: beside them, the rest is only in the way.
    pub(super) fn finish(self, read: Option<Reading>) -> Result<Reading, Diagnostics> {
        let mut diagnostics = self.diagnostics;
        diagnostics.sort_by_key(|entry| entry.excerpt().map(|excerpt| excerpt.span.start));
        let is_shown = |name: RobotWarning| !self.allowed.contains(&name);
        diagnostics.retain(|entry| entry.warning.is_none_or(is_shown));
        let (mut errors, notes): (Vec<_>, Vec<_>) =
            diagnostics.into_iter().partition(Diagnostic::is_error);
        let more = errors.len().saturating_sub(MAX_LISTED);
        if more > 0 {
            errors.truncate(MAX_LISTED);
            if let Some(last) = errors.last_mut() {
                last.message += &format!(" (and {more} more errors after this one)");
            }
        }
        match read {
            Some(reading) if errors.is_empty() => Ok(Reading { notes, ..reading }),
            _ => Err(Diagnostics(errors)),
        }
    }
}

pub(super) fn not_utf8(bytes: &[u8], at: usize) -> Diagnostics {
    let mut sink = Sink::new(&String::from_utf8_lossy(bytes));
    let message = format!("the file is not UTF-8 text from byte {at} on");
    sink.error(at..at + 1, message, "save it as UTF-8");
    Diagnostics(sink.diagnostics)
}

pub(super) fn quote(text: &str) -> String {
    let shown_letter = |c: char| if c.is_control() { '\u{fffd}' } else { c };
    let mut letters = text.chars().map(shown_letter);
    let mut shown: String = letters.by_ref().take(40).collect();
    if letters.next().is_some() {
        shown.push('…');
    }
    format!("`{shown}`")
}
