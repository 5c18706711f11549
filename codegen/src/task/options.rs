//! The options that have one word as their value: each is a line of a table, from which
//! come its field in a [`Request`](super::Request), its clause in `dynamics!`, its argument
//! of the command and its method on the build script's `Generator`.

use super::request::Request;
use crate::words::{UnknownWord, Word, parse, words};

words! {
    /// What programs are chosen by: what to do about one whose estimated rounding error is
    /// more than 4 times that of the textbook form, and in which order its operations are taken.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
    pub enum Prefer: "preference" {
        /// Take the cheapest that is not that much worse.
        #[default]
        Accuracy = "accuracy",
        /// Take the cheapest.
        Operations = "operations",
    }
}

words! {
    /// Whether products are fused with the sums that alone read them.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
    pub enum Fma: "choice" {
        /// Every operation is rounded.
        #[default]
        Off = "off",
        /// A product and its sum are one operation, `mul_add`, and rounded once. It
        /// needs `std`, and a processor that has it.
        On = "on",
    }
}

words! {
    /// What a generated file holds.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
    #[non_exhaustive]
    pub enum Layout: "layout" {
        /// A module for each scalar, for `include!` or a `pub use`.
        #[default]
        Modules = "modules",
        /// What would stand inside the one module, for a file that the user takes
        /// by `mod NAME;`: the file is the module.
        Contents = "contents",
    }
}

/// Gives the table of options to another macro: documentation, word, field, type, purpose.
/// The first word of a type is the default.
#[doc(hidden)]
#[macro_export]
macro_rules! each_option {
    ($then:ident) => {
        $then! {
            /// The formulation to start from: `auto`, which is never dearer than another, or one
            /// alone, to compare formulations
            formulation(start): $crate::Start, Search;

            /// How long to search for fewer operations. A `thorough` search saves a few more and
            /// takes minutes: better search once with `dalembert generate --effort thorough
            /// --save-plan`, whose plan macros, build scripts and the command replay
            effort(effort): $crate::Effort, Search;

            /// What programs are chosen by: `accuracy`, the cheapest whose rounding error is at
            /// most four times the textbook form's; `operations`, the cheapest even if it costs
            /// digits
            prefer(prefer): $crate::Prefer, Search;

            /// Whether a product and the sum that alone reads it are one operation, `mul_add`,
            /// rounded once. The code needs std, and a build for a processor that has it
            /// (-C target-cpu=native): any other calls a slow function for each
            fma(fma): $crate::Fma, Code;

            /// How sines and cosines are computed: `libm`, one call for each angle; `together`,
            /// one call of the crate dalembert-sines for all angles of a function, in a third of
            /// libm's time; `polynomial`, polynomials that hold inside the joints' limits only;
            /// `auto`, polynomials where a scene's tolerance admits them, else the library
            sincos(sincos): $crate::SinCos, Code;

            /// Whether each function has a second one for any number of states in columns:
            /// `NAME_columns` in Rust, by the crate dalembert-batch; `NAME_batch` in C and, as a
            /// kernel, in CUDA
            batch(batch): bool, Text;

            /// The language of the code: `rust`, a module for each scalar; `c`, one header of C99
            /// that C++ reads too; `cuda`, one header of functions for host and device, and
            /// kernels with `batch`
            language(language): $crate::Language, File;

            /// What the file holds: `modules`, one for each scalar, for `include!`; `contents`,
            /// what is inside the one module, for a file that is a module of your crate
            /// (`mod puma560;`)
            layout(layout): $crate::Layout, File;
        }
    };
}

/// What an option decides.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// How programs are found.
    Search,
    /// How they compute.
    Code,
    /// What is printed of them.
    Text,
    /// In which kind of file: `dynamics!` has none.
    File,
}

/// An option with one word as its value.
#[derive(Clone, Copy, Debug)]
pub struct WordOption {
    /// The word that it is called by.
    pub word: &'static str,
    /// Its documentation.
    pub doc: &'static str,
    /// What it decides.
    pub purpose: Purpose,
    /// The name of its values in messages.
    pub what: &'static str,
    /// Returns its values, the default first.
    pub known: fn() -> Vec<&'static str>,
    /// Sets it in a request by the word of a value.
    pub set: fn(&mut Request, &str) -> Result<(), UnknownWord>,
}

macro_rules! table {
    ($($(#[doc = $doc:literal])* $word:ident($field:ident): $type:ty, $purpose:ident;)*) => {
        impl WordOption {
            /// All, in the order of the documentation.
            pub const ALL: &[WordOption] = &[$(WordOption {
                word: stringify!($word),
                doc: concat!($($doc),*),
                purpose: Purpose::$purpose,
                what: <$type as Word>::WHAT,
                known: <$type as Word>::known,
                set: |request, text| parse::<$type>(text).map(|value| request.$field = value),
            }),*];
        }
    };
}
each_option!(table);

#[cfg(test)]
mod tests {
    use std::fmt::Debug;

    use dalembert_model::outputs::RuntimeParameter;

    use super::*;
    use crate::function::Function;
    use crate::language::Language;
    use crate::portfolio::Start;
    use crate::program::ScalarType;
    use crate::simplify::Effort;
    use crate::sincos::SinCos;

    #[test]
    fn a_word_or_the_one_that_was_probably_meant() {
        assert_eq!(parse("gravity"), Ok(Function::Gravity));
        let error = parse::<Function>("gravty").unwrap_err();
        let said = "unknown output `gravty`: did you mean `gravity`?";
        assert_eq!(error.to_string(), said);
    }

    #[test]
    fn every_word_reads_back() {
        fn check<W: Word + PartialEq + Debug>() {
            for (name, value) in W::all() {
                assert_eq!(parse(name), Ok(value));
            }
        }
        check::<Function>();
        check::<ScalarType>();
        check::<Effort>();
        check::<Prefer>();
        check::<RuntimeParameter>();
        check::<Start>();
        check::<SinCos>();
        check::<Fma>();
        check::<Language>();
        check::<Layout>();
        check::<bool>();
    }

    #[test]
    fn every_option_takes_its_words_and_the_first_is_the_default() {
        let of = |option: &WordOption, word: &str| {
            let mut request = Request::default();
            (option.set)(&mut request, word).unwrap();
            format!("{request:?}")
        };
        for option in WordOption::ALL {
            let known = (option.known)();
            let mut requests: Vec<String> = known.iter().map(|word| of(option, word)).collect();
            assert_eq!(
                requests[0],
                format!("{:?}", Request::default()),
                "{}",
                option.word
            );
            requests.sort();
            requests.dedup();
            assert_eq!(requests.len(), known.len(), "{}", option.word);
            assert!((option.set)(&mut Request::default(), "nonsense").is_err());
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
