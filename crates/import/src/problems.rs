//! What is wrong with a URDF, or odd about it, at its place in the file.

use std::ops::Range;

use dalembert_model::read::{Diagnostic, Diagnostics, Severity, closest};

use crate::text::{Text, place};

/// More than these are counted, not listed.
const MAX: usize = 200;
pub(crate) const MAX_NAMES: usize = 30;

#[derive(Default)]
pub(crate) struct Problems<'s> {
    pub(crate) source: &'s str,
    text: Option<&'s Text>,
    found: Vec<Diagnostic>,
    /// Notes of what the robot file has otherwise than the model, so that results differ.
    pub(crate) differences: Vec<Diagnostic>,
    more: usize,
}

impl<'s> Problems<'s> {
    pub(crate) fn new(source: &'s str) -> Self {
        Problems {
            source,
            ..Problems::default()
        }
    }

    pub(crate) fn of(text: &'s Text) -> Self {
        Problems {
            text: Some(text),
            ..Problems::new(text.as_str())
        }
    }

    pub(crate) fn line(&self, byte: usize) -> String {
        match self.text.and_then(|text| text.in_file(byte)) {
            None => format!("line {}", place(self.source, byte).0),
            Some((name, line)) => {
                let file = std::path::Path::new(name).file_name().unwrap_or_default();
                format!("{}, line {line}", file.to_string_lossy())
            }
        }
    }

    pub(crate) fn error(&mut self, span: &Range<usize>, message: impl Into<String>, help: &str) {
        self.push(Severity::Error, span, message.into(), help);
    }

    /// Adds an error, of which there is nothing to return but that.
    pub(crate) fn refuse<T>(
        &mut self,
        span: &Range<usize>,
        message: impl Into<String>,
        help: &str,
    ) -> Option<T> {
        self.error(span, message, help);
        None
    }

    pub(crate) fn warning(&mut self, span: &Range<usize>, message: String, help: &str) {
        self.push(Severity::Warning, span, message, help);
    }

    pub(crate) fn note(&mut self, span: &Range<usize>, message: String, help: &str) {
        self.push(Severity::Note, span, message, help);
    }

    pub(crate) fn difference(&mut self, span: &Range<usize>, message: String, help: &str) {
        if self.differences.len() < MAX {
            let note = self.at(Severity::Note, span, message, help);
            self.differences.push(note);
            self.differences.sort_by_key(|own| own.span.start);
        }
    }

    fn push(&mut self, severity: Severity, span: &Range<usize>, message: String, help: &str) {
        if self.found.len() == MAX {
            self.more += usize::from(severity == Severity::Error);
            return;
        }
        let own = self.at(severity, span, message, help);
        self.found.push(own);
    }

    fn at(
        &self,
        severity: Severity,
        span: &Range<usize>,
        message: String,
        help: &str,
    ) -> Diagnostic {
        let (line, column) = place(self.source, span.start);
        Diagnostic {
            severity,
            warning: None,
            message,
            span: span.clone(),
            line,
            column,
            help: (!help.is_empty()).then(|| help.to_owned()),
        }
    }

    pub(crate) fn has_errors(&self) -> bool {
        let mut found = self.found.iter();
        self.more > 0 || found.any(|found| found.severity == Severity::Error)
    }

    pub(crate) fn refused(&mut self, errors: &Diagnostics, text: &str) {
        for error in &errors.0 {
            let line = text.lines().nth(error.line.saturating_sub(1));
            let (message, line) = (&error.message, line.unwrap_or_default());
            let message = format!("the robot file would be refused: {message} in `{line}`");
            self.error(&(0..0), message, error.help.as_deref().unwrap_or_default());
        }
    }

    /// The differences first, then the rest in the order of the file; or the errors alone.
    pub(crate) fn finish(mut self) -> Result<Vec<Diagnostic>, Diagnostics> {
        if let (1.., Some(last)) = (self.more, self.found.last_mut()) {
            last.severity = Severity::Error;
            last.message += &format!(" (and {} more errors)", self.more);
        }
        self.found.sort_by_key(|found| found.span.start);
        let is_error = |found: &Diagnostic| found.severity == Severity::Error;
        let (errors, notes): (Vec<_>, Vec<_>) = self.found.into_iter().partition(is_error);
        match errors.is_empty() {
            true => Ok([self.differences, notes].concat()),
            false => Err(Diagnostics(errors)),
        }
    }
}

pub(crate) fn instead<'n, N: AsRef<str> + ?Sized + 'n>(
    name: &str,
    names: impl IntoIterator<Item = &'n N>,
) -> String {
    let names: Vec<&str> = names.into_iter().map(|name| name.as_ref()).collect();
    let mut meant = Vec::from_iter(closest(name, &names));
    if meant.is_empty() && !name.is_empty() {
        meant.extend(names.iter().filter(|known| known.contains(name)));
    }
    match (meant.len(), names.get(..MAX_NAMES)) {
        (1..=3, _) => format!("did you mean `{}`?", meant.join("` or `")),
        (_, Some(first)) if names.len() > MAX_NAMES => format!("known: {}, …", first.join(", ")),
        _ => format!("known: {}", names.join(", ")),
    }
}
