//! Why there is no such bundle.

use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use core::fmt;

use crate::outputs::{Function, Quantity};

/// Why there is no such bundle.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum BundleError {
    /// This is no name of a function in generated code.
    Name(String),
    /// This is a word of the language.
    Keyword(String),
    /// An output has this name.
    Output(String),
    /// Something else in a module has this name.
    Taken(String),
    /// Another way to call a function would have this name: it ends so.
    Ending(String, &'static str),
    /// Parts, and no name before them.
    Nameless(String),
    /// There is no output of this name.
    Unknown(String),
    /// A bundle is no part of another.
    Nested(Function),
    /// It has no part, or only this.
    Few(Option<Function>),
    /// Two parts return the same.
    Twice(Quantity, [Function; 2]),
    /// This cannot name a frame.
    Frame(String),
    /// An output that is of no frame.
    NoFrame(Function),
    /// An output that is of a frame, but not in chosen axes or components.
    NoAxes(Function, String),
    /// A word that chooses neither axes nor components, or a second one.
    Word(String),
    /// Results of two parts would have one field.
    SameField(&'static str, [Function; 2]),
}

impl BundleError {
    /// Returns the same where these functions are known beside the outputs: a word
    /// that is the name of a bundle among them is that.
    #[must_use]
    pub fn among(self, functions: &[Function]) -> BundleError {
        match self {
            BundleError::Unknown(word) => {
                let is_it = |function: &&Function| {
                    matches!(function, Function::Bundle(_)) && function.name() == word
                };
                let bundle = functions.iter().find(is_it);
                bundle.map_or(BundleError::Unknown(word), |own| BundleError::Nested(*own))
            }
            other => other,
        }
    }

    /// Returns what is wrong.
    pub fn message(&self) -> String {
        match self {
            BundleError::Name(name) => format!("`{name}` is no name of a function"),
            BundleError::Keyword(name) => format!("`{name}` is a word of Rust"),
            BundleError::Output(name) => format!("`{name}` is an output by itself"),
            BundleError::Taken(name) => {
                format!("`{name}` has a meaning of its own in generated modules")
            }
            BundleError::Ending(name, ending) => {
                let of = name.strip_suffix(ending).unwrap_or(name);
                format!("`{name}` would end as the other way to call `{of}` does, `{ending}`")
            }
            BundleError::Nameless(parts) => format!("`{parts}` has no name"),
            BundleError::Unknown(word) if word.is_empty() => "expected an output".to_string(),
            BundleError::Unknown(word) => format!("unknown output `{word}`"),
            BundleError::Nested(bundle) => format!("`{bundle}` is a bundle itself"),
            BundleError::Few(_) => "a bundle has two parts at least".to_string(),
            BundleError::Twice(_, [one, other]) if one == other => {
                format!("`{one}` is in it twice")
            }
            BundleError::Twice(quantity, [one, other]) => {
                format!("`{one}` and `{other}` both return {}", quantity.symbol())
            }
            BundleError::Frame(name) => {
                let name: String = name.chars().take(64).collect();
                format!("`{name}` cannot name a frame")
            }
            BundleError::NoFrame(function) => format!("`{function}` is of no frame"),
            BundleError::NoAxes(function, words) => {
                format!("`{function}` has no choice of `{words}`")
            }
            BundleError::Word(word) => {
                let word: String = word.chars().take(64).collect();
                format!("`{word}` is no choice of axes or components")
            }
            BundleError::SameField(field, [one, other]) => {
                format!("`{one}` and `{other}` would both be the field `{field}`")
            }
        }
    }

    /// Returns the likely fix.
    pub fn help(&self) -> String {
        match self {
            BundleError::Name(_) => {
                "small letters, digits and single `_` between them, such as `servo_2`".to_string()
            }
            BundleError::Keyword(_)
            | BundleError::Output(_)
            | BundleError::Taken(_)
            | BundleError::Ending(..) => "call the bundle otherwise".to_string(),
            BundleError::Nameless(parts) => format!("write NAME = {parts}"),
            BundleError::Unknown(word) if word.is_empty() => {
                "write its name, such as `gravity`".to_string()
            }
            BundleError::Unknown(_) | BundleError::Few(None) => {
                "a bundle is NAME = OUTPUT + OUTPUT".to_string()
            }
            BundleError::Nested(bundle) => {
                let parts: Vec<&str> = bundle.parts().iter().map(|part| part.name()).collect();
                format!(
                    "bundles do not nest: write its parts, {}",
                    parts.join(" + ")
                )
            }
            BundleError::Few(Some(part)) => format!("ask for `{part}` by itself"),
            BundleError::Twice(..) => "leave one of them out".to_string(),
            BundleError::Frame(_) => {
                "small letters, digits and single `_` between them, such as `camera_2`".to_string()
            }
            BundleError::NoFrame(_) => "leave `@` and what follows out".to_string(),
            BundleError::NoAxes(..) => "it takes a frame alone".to_string(),
            BundleError::Word(_) => "`mixed`, `local` or `world`; `linear`, `angular`, or some of \
                                     x, y, z, rx, ry and rz, such as `x_y_rz`"
                .to_string(),
            BundleError::SameField(..) => "ask for one of them by itself".to_string(),
        }
    }
}

impl fmt::Display for BundleError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.message(), self.help())
    }
}

impl core::error::Error for BundleError {}
