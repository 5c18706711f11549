//! What is wrong with a model, or odd about it, at its place in the text.

use std::collections::BTreeMap;
use std::fmt::Display;
use std::sync::LazyLock;

use dalembert_model::read::{Diagnostic, Diagnostics, Severity, closest};

use crate::text::{Span, Text};

/// More than these are counted, not listed.
const MAX: usize = 200;
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
    /// Of a keyword, the values without an effect.
    pub(crate) idle: &'static str,
    text: &'static str,
    help: &'static str,
}

impl Message {
    /// Finds a message; the one that shows its words stands for one that there is not.
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
    /// The joints or links that the message is about, if it may be about several.
    of: Vec<String>,
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
            of: of.map(ToString::to_string).collect(),
            help: filled(message.help, words),
        }
    }

    fn text(&self) -> String {
        match self.of.as_slice() {
            [] => self.text.clone(),
            [one] => self.text.replace("{of}", one),
            [first, rest @ ..] => self
                .text
                .replace("{of}", &format!("{first} and {} more", rest.len())),
        }
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
            let text = problem.message.text;
            let is_same = |own: &Problem| {
                !own.of.is_empty() && own.text == problem.text && own.message.text == text
            };
            match self.found.iter().position(is_same) {
                Some(same) => self.found[same].of.extend(problem.of),
                None if self.found.len() < MAX => self.found.push(problem),
                None => self.more += usize::from(problem.message.severity == Severity::Error),
            }
        }
    }

    pub(crate) fn count(&self) -> usize {
        self.found.len()
    }

    /// Takes what was found since there were `count`, to be said where it turns out to matter.
    pub(crate) fn since(&mut self, count: usize) -> Vec<Problem> {
        self.found.split_off(count.min(self.found.len()))
    }

    /// Says the problems of a part of the model: its mistakes are notes if the robot lacks it.
    pub(crate) fn said_of(&mut self, problems: &[Problem], is_part: bool) {
        if is_part {
            return self.add(problems.iter().cloned());
        }
        let is_error = |own: &&Problem| own.message.severity == Severity::Error;
        for problem in problems.iter().filter(is_error) {
            self.say("outside", &problem.at, &[&problem.text(), &problem.help]);
        }
    }

    pub(crate) fn has_errors(&self) -> bool {
        let mut found = self.found.iter();
        self.more > 0 || found.any(|own| own.message.severity == Severity::Error)
    }

    /// Returns the messages of the differences, in the order of the file.
    pub(crate) fn differences(&self) -> Vec<String> {
        let differences = self.found.iter().filter(|own| own.message.differs);
        let mut differences: Vec<&Problem> = differences.collect();
        differences.sort_by_key(|own| own.at.start);
        differences.iter().map(|own| own.text()).collect()
    }

    /// Returns the differences, then the other notes, each in the order of the file; or the errors
    /// alone.
    pub(crate) fn finish(mut self) -> Result<Vec<Diagnostic>, Diagnostics> {
        let has_errors = self.has_errors();
        let is_error = |own: &Problem| own.message.severity == Severity::Error;
        self.found.retain(|own| is_error(own) || !has_errors);
        self.found
            .sort_by_key(|own| (!own.message.differs, own.at.start));
        let found = self.found.iter().map(|own| {
            let (line, column) = self.text.line_and_column(own.at.start);
            Diagnostic {
                severity: own.message.severity,
                warning: None,
                message: own.text(),
                span: own.at.clone(),
                line,
                column,
                help: (!own.help.is_empty()).then(|| own.help.clone()),
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
        for call in ["say(\"", "refuse(\""] {
            let mut said = source
                .split(call)
                .skip(1)
                .map(|rest| rest.split('"').next().unwrap());
            assert!(
                said.all(|id| MESSAGES.contains_key(id) || id.contains('\\')),
                "{call}"
            );
        }
    }
}
