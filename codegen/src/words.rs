//! Values that users name by a word, and the words that there are.

use std::fmt;

use dalembert_model::outputs::RuntimeParameter;
use dalembert_model::read::{closest, for_bundle};

use crate::function::{BundleError, Function};

/// A value that users name by a word.
pub trait Word: Copy {
    /// The name in messages.
    const WHAT: &'static str;

    /// Returns every value with its word, in the order that messages list them: the
    /// default first.
    fn all() -> Vec<(&'static str, Self)>;

    /// Returns every word.
    fn known() -> Vec<&'static str> {
        Self::all().into_iter().map(|(word, _)| word).collect()
    }

    /// Returns the value of a word.
    fn from_name(text: &str) -> Option<Self> {
        let mut all = Self::all().into_iter();
        all.find_map(|(word, value)| (word == text).then_some(value))
    }
}

/// An enum whose variants have words: a line a variant, the default first.
macro_rules! words {
    ($(#[$meta:meta])* pub enum $name:ident: $what:literal {
        $($(#[$doc:meta])* $variant:ident = $word:literal,)*
    }) => {
        $(#[$meta])*
        pub enum $name {
            $($(#[$doc])* $variant,)*
        }

        impl $name {
            /// All, in the order that messages list them.
            pub const ALL: [$name; [$($word),*].len()] = [$($name::$variant),*];

            /// Returns its word, which the command line, the macro and files have for it.
            pub const fn name(self) -> &'static str {
                match self {
                    $($name::$variant => $word,)*
                }
            }
        }

        impl $crate::words::Word for $name {
            const WHAT: &'static str = $what;

            fn all() -> Vec<(&'static str, Self)> {
                $name::ALL.map(|value| (value.name(), value)).to_vec()
            }
        }
    };
}
pub(crate) use words;

impl Word for Function {
    const WHAT: &'static str = "output";

    fn all() -> Vec<(&'static str, Self)> {
        Function::ALL.map(|f| (f.name(), f)).to_vec()
    }
}

impl Word for RuntimeParameter {
    const WHAT: &'static str = "parameter that can be an argument";

    fn all() -> Vec<(&'static str, Self)> {
        RuntimeParameter::ALL.map(|p| (p.name(), p)).to_vec()
    }
}

impl Word for bool {
    const WHAT: &'static str = "choice";

    fn all() -> Vec<(&'static str, Self)> {
        vec![("off", false), ("on", true)]
    }
}

/// Returns the value of a word.
///
/// # Errors
/// `UnknownWord`, with the word that was probably meant.
pub fn parse<W: Word>(text: &str) -> Result<W, UnknownWord> {
    W::from_name(text).ok_or_else(|| {
        let known = W::known();
        UnknownWord {
            what: W::WHAT,
            found: text.to_owned(),
            meant: closest(text, &known),
            known,
        }
    })
}

/// Returns the bundle that a text makes, `NAME=OUTPUT+OUTPUT`.
///
/// ```
/// use dalembert_codegen::workspace::bundle;
///
/// assert_eq!(bundle("still=inertia+gravity").unwrap().name(), "still");
/// let error = bundle("still=inertia+gravty").unwrap_err();
/// assert_eq!(error.to_string(), "unknown output `gravty`: did you mean `gravity`?");
/// ```
///
/// # Errors
/// What is wrong with it, and the likely fix.
pub fn bundle(text: &str) -> Result<Function, NoBundle> {
    Function::parse(text).map_err(NoBundle)
}

/// Why a text makes no bundle. Other than the error by itself, it says which
/// output was probably meant.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NoBundle(pub BundleError);

impl fmt::Display for NoBundle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.0.message(), for_bundle(&self.0))
    }
}

impl std::error::Error for NoBundle {}

/// A word that names nothing.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnknownWord {
    /// The kind of word that it should be: `output`, `scalar`, …
    pub what: &'static str,
    /// The word.
    pub found: String,
    /// The word that was probably meant.
    pub meant: Option<&'static str>,
    /// Every word there is.
    pub known: Vec<&'static str>,
}

impl UnknownWord {
    /// Returns what is wrong.
    pub(crate) fn message(&self) -> String {
        format!("unknown {} `{}`", self.what, self.found)
    }

    /// Returns the likely fix.
    pub(crate) fn help(&self) -> String {
        match self.meant {
            Some(meant) => format!("did you mean `{meant}`?"),
            None => format!("known: {}", self.known.join(", ")),
        }
    }
}

impl fmt::Display for UnknownWord {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.message(), self.help())
    }
}

impl std::error::Error for UnknownWord {}
