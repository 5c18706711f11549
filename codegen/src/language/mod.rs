//! Programs as flat text of a language, printed and read back.
//!
//! Takes `Code`; returns its text in a [`Language`], and from the text the same code again.
//! `Dialect` is the table of a language, `Names` are the identifiers of a file.

pub(crate) mod c99;
pub(crate) mod called;
pub(crate) mod columns;
pub(crate) mod dialect;
pub(crate) mod function;
mod loops;
pub(crate) mod names;
pub(crate) mod read;
pub(crate) mod result;
mod trig;

use std::path::Path;

use crate::program::ScalarType;
use crate::words::words;

words! {
    /// The language of generated code.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
    pub enum Language: "language" {
        /// Rust: modules.
        #[default]
        Rust = "rust",
        /// C99, which C++ reads too: one header.
        C = "c",
        /// CUDA: one header of functions for host and device, and of kernels.
        Cuda = "cuda",
    }
}

/// The endings of the languages' files; the first of each is advised.
const ENDINGS: [(&str, Language); 6] = [
    ("rs", Language::Rust),
    ("h", Language::C),
    ("hpp", Language::C),
    ("hh", Language::C),
    ("cuh", Language::Cuda),
    ("cu", Language::Cuda),
];

impl Language {
    /// Returns the language of a file, by its ending.
    ///
    /// # Errors
    /// The endings that there are.
    pub fn of(path: &Path) -> Result<Language, String> {
        let ending = path.extension().unwrap_or_default();
        let mut known = ENDINGS.into_iter();
        let entry = known.find(|(known, _)| ending.eq_ignore_ascii_case(known));
        let shown = |(ending, of): (&str, Language)| format!(".{ending} ({})", of.name());
        let endings = || ENDINGS.map(shown).join(", ");
        entry.map(|(_, language)| language).ok_or_else(endings)
    }

    /// Returns the default scalars: f64 in Rust, where each has a file of its own, else both.
    pub fn scalars(self) -> &'static [ScalarType] {
        match self {
            Language::Rust => &[ScalarType::F64],
            Language::C | Language::Cuda => &ScalarType::ALL,
        }
    }
}

pub(crate) fn list(items: impl Iterator<Item = String>) -> String {
    items.collect::<Vec<String>>().join(", ")
}

pub(crate) fn comment(mark: &str, lines: &[String]) -> String {
    let marked = lines.iter().map(|line| match line.as_str() {
        "" => format!("{mark}\n"),
        line => format!("{mark} {line}\n"),
    });
    marked.collect()
}
