//! Errors, warnings and notes about a model, each at its place in the text.

use std::collections::BTreeMap;
use std::fmt::Display;
use std::sync::LazyLock;

use dalembert_model::read::{Diagnostic, Diagnostics, Severity, closest};

use crate::text::{Span, Text};

/// The most messages of a kind that are listed.
pub(crate) const MAX: usize = 200;
pub(crate) const MAX_NAMES: usize = 30;

/// All messages, by their names. `{0}`, `{1}` … stand for words of a place; a message with `{of}`
/// is said once of all joints or links that it is about.
static MESSAGES: LazyLock<BTreeMap<&str, Message>> = LazyLock::new(|| {
    let lines = include_str!("messages.tsv").lines().skip(1);
    let rows =
        lines.filter_map(|line| <[&str; 5]>::try_from(Vec::from_iter(line.split('\t'))).ok());
    let rows = rows.map(|[id, kind, idle, text, help]| {
        let severity = match kind {
            "error" => Severity::Error,
            "warning" => Severity::Warning,
            _ => Severity::Note,
        };
        let differs = kind == "difference";
        (
            id,
            Message {
                severity,
                differs,
                idle,
                text,
                help,
            },
        )
    });
    rows.collect()
});

#[derive(Debug)]
pub(crate) struct Message {
    severity: Severity,
    /// True if results of the robot file differ from the model's for this reason.
    differs: bool,
    /// For a keyword: the values without an effect.
    pub(crate) idle: &'static str,
    text: &'static str,
    help: &'static str,
}

impl Message {
    /// Finds a message by its id.
    pub(crate) fn of(id: &str) -> Option<&'static Message> {
        MESSAGES.get(id)
    }
}

/// Replaces `{0}`, `{1}` … by words.
fn filled(template: &str, words: &[&dyn Display]) -> String {
    let mut parts = template.split('{');
    let mut text = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let (index, rest) = part.split_once('}').unwrap_or((part, ""));
        match index.parse().ok().and_then(|index: usize| words.get(index)) {
            Some(word) => text += &format!("{word}{rest}"),
            None => text += &format!("{{{part}"),
        }
    }
    text
}

#[derive(Clone, Debug)]
pub(crate) struct Problem {
    message: &'static Message,
    at: Span,
    text: String,
    /// The first of the joints or links that the message is about, if it may be about several.
    of: Option<String>,
    more: usize,
    help: String,
}

impl Problem {
    pub(crate) fn new(message: &'static Message, at: &Span, words: &[&dyn Display]) -> Problem {
        let is_of_several = message.text.contains("{of}");
        let of = words.iter().take(usize::from(is_of_several));
        Problem {
            message,
            at: at.clone(),
            text: filled(message.text, words),
            of: of.map(ToString::to_string).next(),
            more: 0,
            help: filled(message.help, words),
        }
    }

    fn text(&self) -> String {
        match (&self.of, self.more) {
            (None, _) => self.text.clone(),
            (Some(of), 0) => self.text.replace("{of}", of),
            (Some(of), more) => self.text.replace("{of}", &format!("{of} and {more} more")),
        }
    }

    fn is_like(&self, other: &Problem) -> bool {
        let is_one = self.of.is_some() || self.at == other.at;
        is_one && self.text == other.text && self.message.text == other.message.text
    }
}

pub(crate) struct Problems<'t> {
    pub(crate) text: &'t Text,
    found: Vec<Problem>,
    more: usize,
}

impl<'t> Problems<'t> {
    pub(crate) fn of(text: &'t Text) -> Self {
        let found = Vec::new();
        Problems {
            text,
            found,
            more: 0,
        }
    }

    /// Says a message of the table.
    pub(crate) fn say(&mut self, id: &str, at: &Span, words: &[&dyn Display]) {
        let message = Message::of(id).or(Message::of("too_complex"));
        self.add(message.map(|message| Problem::new(message, at, words)));
    }

    /// Says an error where a value cannot be returned.
    pub(crate) fn refuse<T>(&mut self, id: &str, at: &Span, words: &[&dyn Display]) -> Option<T> {
        self.say(id, at, words);
        None
    }

    pub(crate) fn add(&mut self, problems: impl IntoIterator<Item = Problem>) {
        for problem in problems {
            let Message {
                severity, differs, ..
            } = problem.message;
            let is_of_kind = |other: &&Problem| {
                (other.message.severity, other.message.differs) == (*severity, *differs)
            };
            let count = self.found.iter().filter(is_of_kind).count();
            match self.found.iter_mut().find(|other| other.is_like(&problem)) {
                Some(same) => same.more += 1 + problem.more,
                None if count < MAX => self.found.push(problem),
                None => self.more += usize::from(*severity == Severity::Error),
            }
        }
    }

    /// Begins a part of the model, whose problems are said where it turns out to matter; returns
    /// those before it.
    pub(crate) fn begin(&mut self) -> Vec<Problem> {
        std::mem::take(&mut self.found)
    }

    /// Ends a part of the model; returns its problems.
    pub(crate) fn end(&mut self, before: Vec<Problem>) -> Vec<Problem> {
        std::mem::replace(&mut self.found, before)
    }

    /// Says the problems of a part of the model: its mistakes are notes if the robot lacks it.
    pub(crate) fn said_of(&mut self, problems: &[Problem], is_part: bool) {
        if is_part {
            return self.add(problems.iter().cloned());
        }
        let is_error = |problem: &&Problem| problem.message.severity == Severity::Error;
        for problem in problems.iter().filter(is_error) {
            self.say("outside", &problem.at, &[&problem.text(), &problem.help]);
        }
    }

    pub(crate) fn has_errors(&self) -> bool {
        let mut found = self.found.iter();
        found.any(|problem| problem.message.severity == Severity::Error)
    }

    /// Returns the messages of the differences, in the order of the file.
    pub(crate) fn differences(&self) -> Vec<String> {
        let differences = self.found.iter().filter(|problem| problem.message.differs);
        let mut differences: Vec<&Problem> = differences.collect();
        differences.sort_by_key(|problem| problem.at.start);
        differences.iter().map(|problem| problem.text()).collect()
    }

    /// Returns the differences, then the other notes, each in the order of the file; or the errors
    /// alone.
    pub(crate) fn finish(mut self) -> Result<Vec<Diagnostic>, Diagnostics> {
        let has_errors = self.has_errors();
        let is_error = |problem: &Problem| problem.message.severity == Severity::Error;
        self.found
            .retain(|problem| is_error(problem) || !has_errors);
        self.found
            .sort_by_key(|problem| (!problem.message.differs, problem.at.start));
        let found = self.found.iter().map(|problem| {
            let (line, column) = self.text.line_and_column(problem.at.start);
            Diagnostic {
                severity: problem.message.severity,
                warning: None,
                message: problem.text(),
                span: problem.at.clone(),
                line,
                column,
                help: (!problem.help.is_empty()).then(|| problem.help.clone()),
            }
        });
        let mut found: Vec<Diagnostic> = found.collect();
        if let (1.., Some(last)) = (self.more, found.last_mut()) {
            last.severity = Severity::Error;
            last.message += &format!(" (and {} more errors)", self.more);
        }
        if has_errors {
            Err(Diagnostics(found))
        } else {
            Ok(found)
        }
    }
}

/// Returns the help for an unknown name: the likely ones, or all that there are.
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

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    fn texts(folder: &Path) -> String {
        let entries = std::fs::read_dir(folder)
            .unwrap()
            .map(|entry| entry.unwrap().path());
        let texts = entries.map(
            |path| match path.extension().is_some_and(|end| end == "rs") {
                true => std::fs::read_to_string(&path).unwrap(),
                false if path.is_dir() => texts(&path),
                false => String::new(),
            },
        );
        texts.collect()
    }

    /// Every message is said somewhere, and every one that is said is in the table.
    #[test]
    fn the_table_has_all_messages() {
        let source = texts(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src"));
        let source: String = source.split_whitespace().collect();
        let keywords = |id: &&&str| id.contains(' ');
        for id in MESSAGES.keys().filter(|id| !keywords(id)) {
            assert!(source.contains(&format!("\"{id}\"")), "nobody says {id}");
        }
        let has = |id: &str| MESSAGES.keys().any(|known| known.replace(' ', "") == id);
        for call in ["say(\"", "refuse(\""] {
            let said = source
                .split(call)
                .skip(1)
                .map(|rest| rest.split('"').next().unwrap());
            let unknown: Vec<&str> = said.filter(|id| !has(id) && !id.contains('\\')).collect();
            assert!(unknown.is_empty(), "the table lacks {unknown:?}");
        }
    }
}
