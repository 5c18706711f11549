//! Values that users name by a word, and the words that there are.

use std::fmt;

use dalembert_model::outputs::RuntimeParameter;
use dalembert_model::read::closest;

use crate::function::Function;

/// A value that users name by a word.
pub trait Word: Copy {
    /// The name in messages.
    const WHAT: &'static str;

    /// Returns every value with its word, in the order that messages list them: the default first.
    fn all() -> Vec<(&'static str, Self)>;

    /// Returns every word.
    fn known() -> Vec<&'static str> {
        Self::all().into_iter().map(|(word, _)| word).collect()
    }

    /// Returns the value of a word.
    fn from_name(text: &str) -> Option<Self> {
        let mut words = Self::all().into_iter();
        words.find_map(|(word, value)| (word == text).then_some(value))
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

/// A mistake in a word, a line or a file, and the likely fix.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Complaint {
    /// The message: the fault, with the value.
    pub message: String,
    /// The likely fix; empty if none is known.
    pub help: String,
}

impl Complaint {
    pub(crate) fn new(message: impl Into<String>, help: impl Into<String>) -> Complaint {
        let (message, help) = (message.into(), help.into());
        Complaint { message, help }
    }

    pub(crate) fn unknown(message: String, word: &str, known: &[&str], none: &str) -> Complaint {
        let help = match (closest(word, known), known) {
            (Some(meant), _) => format!("did you mean `{meant}`?"),
            (None, []) => none.to_owned(),
            (None, known) => format!("known: {}", known.join(", ")),
        };
        Complaint { message, help }
    }
}

impl fmt::Display for Complaint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.help.as_str() {
            "" => f.write_str(&self.message),
            help => write!(f, "{}: {help}", self.message),
        }
    }
}

impl std::error::Error for Complaint {}

pub(crate) fn complaint(message: impl Into<String>) -> Complaint {
    Complaint::new(message, "")
}

/// Returns the value of a word.
///
/// # Errors
/// The word that was probably meant.
pub fn parse<W: Word>(text: &str) -> Result<W, Complaint> {
    W::from_name(text).ok_or_else(|| {
        let message = format!("unknown {} `{text}`", W::WHAT);
        Complaint::unknown(message, text, &W::known(), "")
    })
}
