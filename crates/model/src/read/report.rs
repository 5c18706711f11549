//! Collecting what was found, and printing it under the line it is about.

use alloc::collections::BTreeSet;
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use core::fmt;
use core::ops::Range;

use super::{Reading, RobotWarning, Severity};

/// More errors than this are counted, not listed.
const MAX_LISTED: usize = 200;
const MAX_WIDTH: usize = 120;

/// Something about a robot file, and where.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// Error, warning or note.
    pub severity: Severity,
    /// The name of a robot file's warning; `None` of anything else.
    pub warning: Option<RobotWarning>,
    /// A sentence that says the mistake, and what was expected.
    pub message: String,
    /// Bytes of the source that it is about.
    pub span: Range<usize>,
    /// Line of the span's start, from one.
    pub line: usize,
    /// Column of the span's start in characters, from one.
    pub column: usize,
    /// The likely fix.
    pub help: Option<String>,
}

impl Diagnostic {
    /// Returns the message with its place, the line itself and the help:
    ///
    /// ```text
    /// error: unknown key `mas`
    ///  --> arm.toml:9:1
    ///   |
    /// 9 | mas = 17.4
    ///   | ^^^
    ///   = help: did you mean `mass`?
    /// ```
    pub fn render(&self, file_name: &str, source: &str) -> String {
        let mut text = format!(
            "{}: {}\n --> {file_name}:{}:{}\n",
            self.severity, self.message, self.line, self.column
        );
        let number = self.line.to_string();
        let margin = " ".repeat(number.len());
        if let Some((line, skip, carets)) = self.excerpt(source) {
            let skip = " ".repeat(skip);
            let carets = "^".repeat(carets);
            text += &format!("{margin} |\n{number} | {line}\n{margin} | {skip}{carets}\n");
        }
        if let Some(help) = &self.help {
            text += &format!("{margin} = help: {help}\n");
        }
        text
    }

    fn excerpt(&self, source: &str) -> Option<(String, usize, usize)> {
        let line = source.lines().nth(self.line.checked_sub(1)?)?;
        let column = self.column.saturating_sub(1);
        let covered = source
            .get(self.span.clone())
            .map_or(1, |s| s.lines().next().unwrap_or("").chars().count());
        // A long line is cut so that the span's start stays in view.
        let first = if column < MAX_WIDTH { 0 } else { column - 20 };
        let shown: String = line
            .chars()
            .skip(first)
            .take(MAX_WIDTH)
            .map(|c| match c {
                '\t' => ' ',
                c if c.is_control() => '\u{fffd}',
                c => c,
            })
            .collect();
        let skip = column - first;
        let room = shown.chars().count().saturating_sub(skip).max(1);
        Some((shown, skip, covered.clamp(1, room)))
    }
}

impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}: {}: ", self.line, self.column, self.severity)?;
        f.write_str(&self.message)?;
        match &self.help {
            Some(help) => write!(f, " ({help})"),
            None => Ok(()),
        }
    }
}

/// Every error of a file, in its order; never empty.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostics(pub Vec<Diagnostic>);

impl Diagnostics {
    /// Returns all of them [rendered](Diagnostic::render), an empty line between two.
    pub fn render(&self, file_name: &str, source: &str) -> String {
        let parts: Vec<_> = self.0.iter().map(|d| d.render(file_name, source)).collect();
        parts.join("\n")
    }
}

impl fmt::Display for Diagnostics {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let lines: Vec<String> = self.0.iter().map(ToString::to_string).collect();
        f.write_str(&lines.join("\n"))
    }
}

impl core::error::Error for Diagnostics {}

pub(super) struct Sink {
    pub(super) source: String,
    line_starts: Vec<usize>,
    diagnostics: Vec<Diagnostic>,
    allowed: BTreeSet<RobotWarning>,
}

impl Sink {
    pub(super) fn new(source: &str) -> Self {
        let newlines = source.bytes().enumerate().filter(|(_, b)| *b == b'\n');
        let line_starts = core::iter::once(0)
            .chain(newlines.map(|(i, _)| i + 1))
            .collect();
        Sink {
            source: source.to_string(),
            line_starts,
            diagnostics: Vec::new(),
            allowed: BTreeSet::new(),
        }
    }

    pub(super) fn allow(&mut self, warning: RobotWarning) {
        self.allowed.insert(warning);
    }

    pub(super) fn error(&mut self, span: Range<usize>, message: String, help: &str) {
        self.push(Severity::Error, None, span, message, help);
    }

    pub(super) fn note(&mut self, span: Range<usize>, message: String, help: &str) {
        self.push(Severity::Note, None, span, message, help);
    }

    pub(super) fn found(
        &mut self,
        warning: Option<RobotWarning>,
        span: Range<usize>,
        message: String,
        help: &str,
    ) {
        let Some(name) = warning else {
            return self.error(span, message, help);
        };
        let help = format!("{help}; allow = [\"{name}\"] silences this");
        self.push(Severity::Warning, warning, span, message, &help);
    }

    fn push(
        &mut self,
        severity: Severity,
        warning: Option<RobotWarning>,
        span: Range<usize>,
        message: String,
        help: &str,
    ) {
        let (line, column) = self.position(span.start);
        self.diagnostics.push(Diagnostic {
            severity,
            warning,
            message,
            span,
            line,
            column,
            help: (!help.is_empty()).then(|| help.to_string()),
        });
    }

    /// Both count from one.
    pub(super) fn position(&self, byte: usize) -> (usize, usize) {
        let line = self.line_starts.partition_point(|start| *start <= byte);
        let start = self.line_starts.get(line.wrapping_sub(1)).copied();
        let before = start.and_then(|start| self.source.get(start..byte));
        // A byte order mark is no column.
        let column = before.map_or(0, |s| s.trim_start_matches('\u{feff}').chars().count());
        (line.max(1), column + 1)
    }

    /// Errors come alone: beside them, the rest is only in the way.
    pub(super) fn finish(mut self, read: Option<Reading>) -> Result<Reading, Diagnostics> {
        self.diagnostics.sort_by_key(|d| d.span.start);
        let allowed = self.allowed;
        let known =
            |diagnostic: &Diagnostic| diagnostic.warning.is_some_and(|d| allowed.contains(&d));
        self.diagnostics.retain(|diagnostic| !known(diagnostic));
        let (mut errors, notes): (Vec<_>, Vec<_>) = self
            .diagnostics
            .into_iter()
            .partition(|d| d.severity == Severity::Error);
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
    let good = bytes.get(..at).unwrap_or_default();
    let good = core::str::from_utf8(good).unwrap_or_default();
    let mut sink = Sink::new(good);
    let message = format!("the file is not UTF-8 text from byte {at} on");
    sink.error(at..at + 1, message, "save it as UTF-8");
    Diagnostics(sink.diagnostics)
}

pub(super) fn quote(text: &str) -> String {
    let mut shown: String = text
        .chars()
        .take(40)
        .map(|c| if c.is_control() { '\u{fffd}' } else { c })
        .collect();
    if text.chars().nth(40).is_some() {
        shown.push('…');
    }
    format!("`{shown}`")
}
