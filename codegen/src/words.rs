//! Values that users name by a word, and the words that there are.

use dalembert_model::diagnostic::Diagnostic;
use dalembert_model::outputs::RuntimeParameter;

use crate::function::Function;

/// A value that users name by a word.
pub trait Word: Copy {
    /// The name in messages.
    const WHAT: &'static str;

    /// Returns every value with its word, in the order that messages list them: the default first.
    fn all() -> Vec<(&'static str, Self)>;

    fn known() -> Vec<&'static str> {
        Self::all().into_iter().map(|(word, _)| word).collect()
    }

    fn from_name(text: &str) -> Option<Self> {
        let mut words = Self::all().into_iter();
        words.find_map(|(word, value)| (word == text).then_some(value))
    }
}

/// An enum whose variants have words: a line a variant, the default first.
#[doc(hidden)]
#[macro_export]
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

/// Returns the value of a word, or else the word that was probably meant.
pub fn parse<W: Word>(text: &str) -> Result<W, Diagnostic> {
    W::from_name(text).ok_or_else(|| {
        let message = format!("unknown {} `{text}`", W::WHAT);
        Diagnostic::unknown(message, text, &W::known(), "")
    })
}
