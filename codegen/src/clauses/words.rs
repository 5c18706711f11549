//! Outputs, scalars, formulations, efforts, preferences, sources of sines, entries
//! and parameters by name.

use std::fmt;

use dalembert_model::outputs::RuntimeParameter;
use dalembert_model::read::{closest, for_bundle};

use crate::emit::Interface;
use crate::function::{BundleError, Function};
use crate::generate::{Fma, Prefer};
use crate::language::Entries;
use crate::portfolio::Start;
use crate::program::ScalarType;
use crate::simplify::Effort;
use crate::sincos::SinCos;

/// A value that users name by a word.
pub trait Word: Copy {
    /// The name in messages.
    const WHAT: &'static str;

    /// Every value with its word, in the order that messages list them.
    fn all() -> Vec<(&'static str, Self)>;
}

impl Word for Function {
    const WHAT: &'static str = "output";

    fn all() -> Vec<(&'static str, Self)> {
        Function::ALL.map(|f| (f.name(), f)).to_vec()
    }
}

impl Word for ScalarType {
    const WHAT: &'static str = "scalar";

    fn all() -> Vec<(&'static str, Self)> {
        ScalarType::ALL.map(|s| (s.name(), s)).to_vec()
    }
}

impl Word for Effort {
    const WHAT: &'static str = "effort";

    fn all() -> Vec<(&'static str, Self)> {
        Effort::ALL.map(|e| (e.name(), e)).to_vec()
    }
}

impl Word for Prefer {
    const WHAT: &'static str = "preference";

    fn all() -> Vec<(&'static str, Self)> {
        Prefer::ALL.map(|p| (p.name(), p)).to_vec()
    }
}

impl Word for Fma {
    const WHAT: &'static str = "choice";

    fn all() -> Vec<(&'static str, Self)> {
        Fma::ALL.map(|f| (f.name(), f)).to_vec()
    }
}

impl Word for Entries {
    const WHAT: &'static str = "kind of entries";

    fn all() -> Vec<(&'static str, Self)> {
        Entries::ALL.map(|e| (e.name(), e)).to_vec()
    }
}

impl Word for RuntimeParameter {
    const WHAT: &'static str = "parameter that can be an argument";

    fn all() -> Vec<(&'static str, Self)> {
        RuntimeParameter::ALL.map(|p| (p.name(), p)).to_vec()
    }
}

impl Word for Interface {
    const WHAT: &'static str = "interface";

    fn all() -> Vec<(&'static str, Self)> {
        Interface::ALL.map(|i| (i.name(), i)).to_vec()
    }
}

impl Word for Start {
    const WHAT: &'static str = "formulation";

    fn all() -> Vec<(&'static str, Self)> {
        Start::all().map(|start| (start.name(), start)).collect()
    }
}

impl Word for SinCos {
    const WHAT: &'static str = "source of sines";

    fn all() -> Vec<(&'static str, Self)> {
        let named = |name: &'static str| SinCos::from_name(name).map(|sincos| (name, sincos));
        SinCos::NAMES.into_iter().filter_map(named).collect()
    }
}

/// The value of a word.
///
/// # Errors
/// [`UnknownWord`], with the word that was probably meant.
pub fn parse<W: Word>(text: &str) -> Result<W, UnknownWord> {
    let all = W::all();
    if let Some((_, value)) = all.iter().find(|(name, _)| *name == text) {
        return Ok(*value);
    }
    let known: Vec<&'static str> = all.into_iter().map(|(name, _)| name).collect();
    Err(UnknownWord {
        what: W::WHAT,
        found: text.to_owned(),
        meant: closest(text, &known),
        known,
    })
}

/// The bundle that a text makes, `NAME=OUTPUT+OUTPUT`.
///
/// ```
/// use dalembert_codegen::workspace::clauses::words::bundle;
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

    /// The likely fix.
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_word_or_the_one_that_was_probably_meant() {
        assert_eq!(parse("gravity"), Ok(Function::Gravity));
        let error = parse::<Function>("gravty").unwrap_err();
        let said = "unknown output `gravty`: did you mean `gravity`?";
        assert_eq!(error.to_string(), said);
    }

    #[test]
    fn every_word_reads_back() {
        fn check<W: Word + PartialEq + std::fmt::Debug>() {
            for (name, value) in W::all() {
                assert_eq!(parse(name), Ok(value));
            }
        }
        check::<Function>();
        check::<ScalarType>();
        check::<Effort>();
        check::<Prefer>();
        check::<Entries>();
        check::<Interface>();
        check::<RuntimeParameter>();
        check::<Start>();
        check::<SinCos>();
        assert_eq!(SinCos::all().len(), SinCos::NAMES.len());
        for start in Start::all() {
            assert_eq!(Start::from_name(start.name()), Some(start));
        }
    }

    #[test]
    fn unknown_words() {
        for (text, shown) in [
            ("f46", "unknown scalar `f46`: did you mean `f64`?"),
            ("double", "unknown scalar `double`: known: f64, f32"),
        ] {
            assert_eq!(
                parse::<ScalarType>(text).map_err(|e| e.to_string()),
                Err(shown.into())
            );
        }
    }
}
