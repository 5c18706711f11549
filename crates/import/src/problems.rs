//! Errors, warnings and notes about a model, each at its place in the text.

use std::collections::BTreeMap;
use std::fmt::Display;
use std::sync::LazyLock;

use dalembert_model::diagnostic::{Diagnostic, Diagnostics, Place, Severity};
use dalembert_model::read::closest;

use crate::text::{Span, Text};

/// The most messages of a kind that are listed.
pub(crate) const MAX: usize = 200;
const MAX_OF_ALL: usize = 10 * MAX;
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
    /// The begin of the joint, link or body that the message is about: the message matters if the
    /// robot has it.
    part: Option<usize>,
}

impl Problem {
    fn new(message: &'static Message, at: &Span, words: &[&dyn Display]) -> Problem {
        let is_of_several = message.text.contains("{of}");
        let of = words.iter().take(usize::from(is_of_several));
        Problem {
            message,
            at: at.clone(),
            text: filled(message.text, words),
            of: of.map(ToString::to_string).next(),
            more: 0,
            help: filled(message.help, words),
            part: None,
        }
    }

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
        let problems = Vec::new();
        Problems {
            text,
            problems,
            more: 0,
            part: None,
        }
    }

    /// Says a message of the table.
    pub(crate) fn say(&mut self, id: &str, at: &Span, words: &[&dyn Display]) {
        if let Some(message) = Message::of(id).or(Message::of("too_complex")) {
            self.say_message(message, at, words);
        }
    }

    pub(crate) fn say_message(
        &mut self,
        message: &'static Message,
        at: &Span,
        words: &[&dyn Display],
    ) {
        let part = self.part;
        self.add(Problem {
            part,
            ..Problem::new(message, at, words)
        });
    }

    /// Says an error where a value cannot be returned.
    pub(crate) fn refuse<T>(&mut self, id: &str, at: &Span, words: &[&dyn Display]) -> Option<T> {
        self.say(id, at, words);
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
        match self
            .problems
            .iter_mut()
            .find(|other| other.is_like(&problem))
        {
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
                self.say("outside", &problem.at, &[&problem.text(), &problem.help]);
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
    pub(crate) fn finish(mut self) -> Result<Vec<Diagnostic>, Diagnostics> {
        let has_errors = self.has_errors();
        self.problems
            .retain(|problem| problem.is_error() || !has_errors);
        self.problems
            .sort_by_key(|problem| (!problem.message.differs, problem.at.start));
        let mut diagnostics: Vec<Diagnostic> = self
            .problems
            .iter()
            .map(|problem| {
                Diagnostic::new(problem.message.severity, problem.text())
                    .with_help(&problem.help)
                    .at(Place::Text(Box::new(self.text.excerpt(&problem.at))))
            })
            .collect();
        if let (1.., Some(last)) = (self.more, diagnostics.last_mut()) {
            last.severity = Severity::Error;
            last.message += &format!(" (and {} more errors)", self.more);
        }
        if has_errors {
            Err(Diagnostics(diagnostics))
        } else {
            Ok(diagnostics)
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
        let source: String = texts(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src"))
            .split_whitespace()
            .collect();
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
