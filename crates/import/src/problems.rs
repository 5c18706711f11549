//! Errors, warnings and notes about a model, each at its place in the text.

use std::collections::BTreeMap;
use std::fmt::Display;
use std::sync::LazyLock;

use dalembert_model::diagnostic::{Diagnostic, Diagnostics, Place, Severity, closest};

use crate::text::{Span, Text};

/// The most messages of a kind that are listed.
pub(crate) const MAX: usize = 200;
const MAX_OF_ALL: usize = 10 * MAX;
pub(crate) const MAX_NAMES: usize = 30;

/// All messages, by their names. `{0}`, `{1}` … stand for words of a place; a message with `{of}`
/// is said once of all joints or links that it is about.
static MESSAGES: LazyLock<BTreeMap<&str, Message>> = LazyLock::new(|| {
    let rows = include_str!("messages.tsv").lines().skip(1);
    let messages = rows.filter_map(|row| {
        let [id, kind, idle, text, help] = Vec::from_iter(row.split('\t')).try_into().ok()?;
        let message = Message {
            severity: match kind {
                "error" => Severity::Error,
                "warning" => Severity::Warning,
                _ => Severity::Note,
            },
            differs: kind == "difference",
            idle,
            text,
            help,
        };
        Some((id, message))
    });
    messages.collect()
});

/// The words of a place, which a message shows.
pub(crate) type Words<'w> = [&'w dyn Display];

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
    pub(crate) fn of(id: &str) -> Option<&'static Message> {
        MESSAGES.get(id)
    }
}

/// Replaces `{0}`, `{1}` … by words.
fn filled(template: &str, words: &Words) -> String {
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
    /// The begin of the joint, link or body that the message is about: the message matters if the
    /// robot has it.
    part: Option<usize>,
}

impl Problem {
    fn is_error(&self) -> bool {
        self.message.severity == Severity::Error
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
        let is_same = self.text == other.text && self.message.text == other.message.text;
        is_one && is_same && self.part == other.part
    }
}

#[derive(Clone)]
pub(crate) struct Problems<'t> {
    pub(crate) text: &'t Text,
    problems: Vec<Problem>,
    more: usize,
    /// The part of the model that is read.
    part: Option<usize>,
}

impl<'t> Problems<'t> {
    pub(crate) fn of(text: &'t Text) -> Self {
        Problems {
            text,
            problems: Vec::new(),
            more: 0,
            part: None,
        }
    }

    pub(crate) fn report(&mut self, id: &str, at: &Span, words: &Words) {
        if let Some(message) = Message::of(id).or(Message::of("too_complex")) {
            self.report_message(message, at, words);
        }
    }

    pub(crate) fn report_message(&mut self, message: &'static Message, at: &Span, words: &Words) {
        let is_of_several = message.text.contains("{of}");
        let of = words.first().filter(|_| is_of_several);
        self.add(Problem {
            message,
            at: at.clone(),
            text: filled(message.text, words),
            of: of.map(ToString::to_string),
            more: 0,
            help: filled(message.help, words),
            part: self.part,
        });
    }

    /// Reports an error where a value cannot be returned.
    pub(crate) fn refuse<T>(&mut self, id: &str, at: &Span, words: &Words) -> Option<T> {
        self.report(id, at, words);
        None
    }

    fn add(&mut self, problem: Problem) {
        let Message {
            severity, differs, ..
        } = problem.message;
        let is_of_kind = |other: &&Problem| {
            let kind = (other.message.severity, other.message.differs);
            kind == (*severity, *differs) && other.part == problem.part
        };
        let count = self.problems.iter().filter(is_of_kind).count();
        let has_room = count < MAX && self.problems.len() < MAX_OF_ALL;
        let mut others = self.problems.iter_mut();
        match others.find(|other| other.is_like(&problem)) {
            Some(same) => same.more += 1 + problem.more,
            None if has_room => self.problems.push(problem),
            None => self.more += usize::from(problem.is_error()),
        }
    }

    /// Begins a part of the model, a joint, a link or a body; returns the one around it.
    pub(crate) fn enter(&mut self, part: &Span) -> Option<usize> {
        self.part.replace(part.start)
    }

    pub(crate) fn leave(&mut self, around: Option<usize>) {
        self.part = around;
    }

    /// Decides which parts the robot has: mistakes in others are notes.
    pub(crate) fn settle(&mut self, is_part: impl Fn(usize) -> bool) {
        for mut problem in std::mem::take(&mut self.problems) {
            let part = problem.part.take();
            if part.is_none_or(&is_part) {
                self.add(problem);
            } else if problem.is_error() {
                self.report("outside", &problem.at, &[&problem.text(), &problem.help]);
            }
        }
    }

    /// True if there are errors, not counting those in parts that the robot may lack.
    pub(crate) fn has_errors(&self) -> bool {
        let mut problems = self.problems.iter();
        problems.any(|problem| problem.part.is_none() && problem.is_error())
    }

    /// Returns the messages of the differences, in the order of the file.
    pub(crate) fn differences(&self) -> Vec<String> {
        let differs = |problem: &&Problem| problem.message.differs;
        let mut differences: Vec<&Problem> = self.problems.iter().filter(differs).collect();
        differences.sort_by_key(|problem| problem.at.start);
        differences.iter().map(|problem| problem.text()).collect()
    }

    /// Returns the differences, then the other notes, each in the order of the file; or the errors
    /// alone.
    pub(crate) fn finish(self) -> Result<Vec<Diagnostic>, Diagnostics> {
        let has_errors = self.has_errors();
        let mut problems = self.problems;
        problems.retain(|problem| problem.is_error() || !has_errors);
        problems.sort_by_key(|problem| (!problem.message.differs, problem.at.start));
        let mut diagnostics = Vec::new();
        for problem in &problems {
            let place = Place::Text(Box::new(self.text.excerpt(&problem.at)));
            let diagnostic = Diagnostic::new(problem.message.severity, problem.text());
            diagnostics.push(diagnostic.with_help(&problem.help).at(place));
        }
        if let (1.., Some(last)) = (self.more, diagnostics.last_mut()) {
            last.severity = Severity::Error;
            last.message += &format!(" (and {} more errors)", self.more);
        }
        match has_errors {
            true => Err(Diagnostics(diagnostics)),
            false => Ok(diagnostics),
        }
    }
}

/// Returns the part of a body's mass: no element begins inside of a tag.
pub(crate) fn mass_part(body: &Span) -> Span {
    body.start + 1..body.end
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
        let entries = std::fs::read_dir(folder).unwrap();
        let paths = entries.map(|entry| entry.unwrap().path());
        let texts = paths.map(|path| match path.extension() {
            Some(end) if end == "rs" => std::fs::read_to_string(&path).unwrap(),
            _ if path.is_dir() => texts(&path),
            _ => String::new(),
        });
        texts.collect()
    }

    /// Every message is said somewhere, and every one that is said is in the table.
    #[test]
    fn the_table_has_all_messages() {
        let files = texts(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src"));
        let source: String = files.split_whitespace().collect();
        let keywords = |id: &&&str| id.contains(' ');
        for id in MESSAGES.keys().filter(|id| !keywords(id)) {
            assert!(source.contains(&format!("\"{id}\"")), "nobody says {id}");
        }
        let has = |id: &str| MESSAGES.keys().any(|known| known.replace(' ', "") == id);
        for call in ["report(\"", "refuse(\""] {
            let calls = source.split(call).skip(1);
            let said = calls.map(|rest| rest.split('"').next().unwrap());
            let unknown: Vec<&str> = said.filter(|id| !has(id) && !id.contains('\\')).collect();
            assert!(unknown.is_empty(), "the table lacks {unknown:?}");
        }
    }
}
