//! Diagnostics: the message, the place and the likely fix of all that users see.

use alloc::boxed::Box;
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use core::fmt;
use core::ops::Range;

#[cfg(feature = "std")]
pub(crate) mod suggest;
mod warning;

#[cfg(feature = "std")]
pub use suggest::closest;
pub use warning::RobotWarning;

/// The most columns of a line that are printed.
const MAX_WIDTH: usize = 120;

/// The weight of a diagnostic.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// It says something that the user may want to know.
    Note,
    /// It is probably a mistake.
    Warning,
    /// It prevents any output.
    Error,
}

impl fmt::Display for Severity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Severity::Error => "error",
            Severity::Warning => "warning",
            Severity::Note => "note",
        })
    }
}

/// The place that a diagnostic is about.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Place {
    /// The message names it, or there is none.
    #[default]
    None,
    /// Bytes of a file.
    Text(Box<Excerpt>),
    /// The keys of a robot file that lead to the value, from the outermost one on, an entry of a
    /// list or a table by `#` and its number from one: `joint/#2/limits/velocity`.
    Keys(String),
    /// An option by its name, and the item of its value; empty where it is the option as a whole.
    Option(&'static str, String),
}

/// Bytes of a file, with the line that they begin in.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Excerpt {
    /// The file's name, as messages call it; empty until it is set.
    pub file: String,
    /// Bytes of the source.
    pub span: Range<usize>,
    /// Line of the span's start, from one.
    pub line: usize,
    /// Column of the span's start in characters, from one.
    pub column: usize,
    /// The line, cut so that the span's start is in view; `None` at the end of a source.
    text: Option<String>,
    /// The characters of `text` that the span covers.
    covered: Range<usize>,
}

impl Excerpt {
    /// Creates the excerpt of a span of a source, whose line, counted from one, begins at `start`.
    pub fn new(source: &str, span: Range<usize>, line: usize, start: usize) -> Excerpt {
        let before = source.get(start..span.start).unwrap_or_default();
        // A byte order mark takes no column.
        let column = before.trim_start_matches('\u{feff}').chars().count();
        let line_text = source.get(start..).and_then(|rest| rest.lines().next());
        let width = source.get(span.clone()).map_or(1, |text| {
            text.lines().next().unwrap_or_default().chars().count()
        });
        let first = if column < MAX_WIDTH { 0 } else { column - 20 };
        let printable = |letter| match letter {
            '\t' => ' ',
            letter if letter.is_control() => '\u{fffd}',
            letter => letter,
        };
        let text: Option<String> = line_text.map(|text| {
            let letters = text.chars().skip(first).take(MAX_WIDTH);
            letters.map(printable).collect()
        });
        let begin = column - first;
        let letters = text.as_ref().map_or(0, |text| text.chars().count());
        let room = letters.saturating_sub(begin).max(1);
        Excerpt {
            file: String::new(),
            span,
            line,
            column: column + 1,
            text,
            covered: begin..begin + width.clamp(1, room),
        }
    }
}

/// A mistake, a warning or a note: what is wrong, where, and the likely fix.
///
/// ```
/// use dalembert_model::diagnostic::{Diagnostic, Place};
///
/// let place = Place::Option("scalar", "f16".to_owned());
/// let mistake = Diagnostic::error("unknown scalar `f16`").with_help("known: f64, f32").at(place);
/// assert_eq!(mistake.to_string(), "scalar: unknown scalar `f16`: known: f64, f32");
/// assert_eq!(mistake.render(), "error: scalar: unknown scalar `f16`\n  = help: known: f64, f32\n");
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// Error, warning or note.
    pub severity: Severity,
    /// The name by which `allow` silences a warning about a robot; `None` of anything else.
    pub warning: Option<RobotWarning>,
    /// A sentence that says the mistake, and what was expected.
    pub message: String,
    /// The place.
    pub place: Place,
    /// The likely fix.
    pub help: Option<String>,
}

impl Diagnostic {
    /// Creates a diagnostic without a place or a fix.
    pub fn new(severity: Severity, message: impl Into<String>) -> Diagnostic {
        Diagnostic {
            severity,
            warning: None,
            message: message.into(),
            place: Place::None,
            help: None,
        }
    }

    /// Creates an error without a place or a fix.
    pub fn error(message: impl Into<String>) -> Diagnostic {
        Diagnostic::new(Severity::Error, message)
    }

    /// Creates a warning about a robot, which this name silences, without a place or a fix.
    pub fn robot_warning(name: RobotWarning, message: impl Into<String>) -> Diagnostic {
        Diagnostic {
            warning: Some(name),
            ..Diagnostic::new(Severity::Warning, message)
        }
    }

    /// Creates the error of an unknown word: with the one that was meant, all known, or `otherwise`.
    #[cfg(feature = "std")]
    pub fn unknown(message: String, word: &str, known: &[&str], otherwise: &str) -> Diagnostic {
        let help = match (closest(word, known), known) {
            (Some(meant), _) => format!("did you mean `{meant}`?"),
            (None, []) => otherwise.to_string(),
            (None, known) => format!("known: {}", known.join(", ")),
        };
        Diagnostic::error(message).with_help(help)
    }

    /// Sets the likely fix; an empty text means none.
    #[must_use]
    pub fn with_help(mut self, help: impl Into<String>) -> Diagnostic {
        self.help = Some(help.into()).filter(|help| !help.is_empty());
        self
    }

    /// Gives the place.
    #[must_use]
    pub fn at(mut self, place: Place) -> Diagnostic {
        self.place = place;
        self
    }

    /// Puts the name of its subject before the message.
    #[must_use]
    pub fn within(mut self, part: impl fmt::Display) -> Diagnostic {
        self.message = format!("{part}: {}", self.message);
        self
    }

    /// Returns the keys of a robot file that lead to the value; empty of another place.
    pub fn keys(&self) -> &str {
        match &self.place {
            Place::Keys(keys) => keys,
            _ => "",
        }
    }

    /// Names the file of an excerpt that has no name yet.
    #[must_use]
    pub fn in_file(mut self, name: &str) -> Diagnostic {
        if let Place::Text(excerpt) = &mut self.place
            && excerpt.file.is_empty()
        {
            excerpt.file = name.to_string();
        }
        self
    }

    /// True if it is an error, not a warning or a note.
    pub fn is_error(&self) -> bool {
        self.severity == Severity::Error
    }

    /// Returns the line in its file, from one, if the place is in a file.
    pub fn line(&self) -> Option<usize> {
        self.excerpt().map(|excerpt| excerpt.line)
    }

    /// Returns the bytes of a file that it is about, with their line.
    pub fn excerpt(&self) -> Option<&Excerpt> {
        match &self.place {
            Place::Text(excerpt) => Some(excerpt),
            _ => None,
        }
    }

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
    pub fn render(&self) -> String {
        format!("{}: {}", self.severity, self.render_plain())
    }

    /// Returns [`Diagnostic::render`] without the severity, for a program that prints it itself.
    pub fn render_plain(&self) -> String {
        let (mut text, mut margin) = (format!("{}\n", self.message), " ".to_string());
        match &self.place {
            Place::Text(excerpt) => {
                let line = excerpt.line;
                margin = " ".repeat(line.to_string().len());
                text += &format!(" --> {}:{line}:{}\n", excerpt.file, excerpt.column);
                if let Some(line_text) = &excerpt.text {
                    let skip = " ".repeat(excerpt.covered.start);
                    let carets = "^".repeat(excerpt.covered.len());
                    text += &format!("{margin} |\n{line} | {line_text}\n");
                    text += &format!("{margin} | {skip}{carets}\n");
                }
            }
            Place::Option(name, _) => text.insert_str(0, &format!("{name}: ")),
            _ => {}
        }
        if let Some(help) = &self.help {
            text += &format!("{margin} = help: {help}\n");
        }
        text
    }
}

/// In one line: the place, the message and the likely fix.
impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.place {
            Place::Text(at) => write!(f, "{}:{}: {}: ", at.line, at.column, self.severity)?,
            Place::Option(name, _) => write!(f, "{name}: ")?,
            _ => {}
        }
        match &self.help {
            Some(help) => write!(f, "{}: {help}", self.message),
            None => f.write_str(&self.message),
        }
    }
}

impl core::error::Error for Diagnostic {}

/// Every error of a file or a request, in their order; never empty.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostics(pub Vec<Diagnostic>);

impl Diagnostics {
    /// Sets the file name of excerpts that have none.
    #[must_use]
    pub fn in_file(self, name: &str) -> Diagnostics {
        let named = self.0.into_iter().map(|error| error.in_file(name));
        Diagnostics(named.collect())
    }

    /// Returns all of them [rendered](Diagnostic::render), an empty line between two.
    pub fn render(&self) -> String {
        let parts: Vec<String> = self.0.iter().map(Diagnostic::render).collect();
        parts.join("\n")
    }
}

impl From<Diagnostic> for Diagnostics {
    fn from(error: Diagnostic) -> Diagnostics {
        Diagnostics(alloc::vec![error])
    }
}

/// Rendered, if one of them is in a file; else a line each.
impl fmt::Display for Diagnostics {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.0.iter().any(|error| error.excerpt().is_some()) {
            return f.write_str(self.render().trim_end());
        }
        let lines: Vec<String> = self.0.iter().map(ToString::to_string).collect();
        f.write_str(&lines.join("\n"))
    }
}

impl core::error::Error for Diagnostics {}
