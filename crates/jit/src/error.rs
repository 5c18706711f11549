//! The errors of loading, compiling and calling.

use dalembert_codegen::{Diagnostic, Diagnostics, GenerateError, ScalarType};

/// The reasons for which an arm is not loaded, a program not compiled or a function not called.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The robot cannot be read, or the request asks for what there is not.
    #[error("{0}")]
    Input(Diagnostics),
    /// Nothing was generated, or not proved.
    #[error("{0}")]
    Generate(#[from] GenerateError),
    /// A function of an arm was not compiled.
    #[error("`{0}`: {1}")]
    Function(&'static str, Box<Error>),
    /// The program reads what it does not have.
    #[error(
        "the program reads an argument or a step that it does not have: a defect of this library"
    )]
    Program,
    /// The program returns another number of results than its signature says.
    #[error("the program returns {found} numbers, expected {expected}: a defect of this library")]
    Results {
        /// The signature's number of results.
        expected: usize,
        /// The program's number of results.
        found: usize,
    },
    /// Cranelift refuses: an unknown processor, or no memory.
    #[error("no machine code for this machine: {0}")]
    Cranelift(String),
    /// At a state, the code computes another number than the program.
    #[error(
        "machine code is refused: at state {state} of the check, result {result} has other bits \
         than the proved program"
    )]
    Differs {
        /// The number of the state among those of the check.
        state: usize,
        /// The number of the result.
        result: usize,
    },
    /// A function is called in the other scalar.
    #[error("the function computes in {}", expected.name())]
    Scalar {
        /// The function's.
        expected: ScalarType,
    },
    /// Another number of arguments, or of results, than the function has.
    #[error("expected {expected} arguments or results, found {found}")]
    Count {
        /// The function's.
        expected: usize,
        /// The caller's.
        found: usize,
    },
    /// An argument, or a result, has too few or too many numbers.
    #[error("argument {place}: expected {expected} entries, found {found}")]
    Length {
        /// Its place in the signature; results come after the arguments.
        place: usize,
        /// The number of entries that it must have.
        expected: usize,
        /// The number that it has.
        found: usize,
    },
    /// An entry of some state is outside of its slice.
    #[error("argument {place}: an entry is outside of its slice")]
    Outside {
        /// Its place in the signature.
        place: usize,
    },
    /// Two states, or two entries, of a result are at the same place.
    #[error("result {place}: two numbers would be written to one place")]
    Overlap {
        /// Its place in the signature.
        place: usize,
    },
}

impl Error {
    pub(crate) fn input(message: impl Into<String>) -> Error {
        Diagnostic::error(message).into()
    }

    pub(crate) fn cranelift<T>(result: Result<T, impl std::fmt::Display>) -> Result<T, Error> {
        result.map_err(|error| Error::Cranelift(error.to_string()))
    }

    pub(crate) fn unless(self, holds: bool) -> Result<(), Error> {
        if holds { Ok(()) } else { Err(self) }
    }

    pub(crate) fn length(place: usize, expected: usize, found: usize) -> Result<(), Error> {
        let error = Error::Length {
            place,
            expected,
            found,
        };
        error.unless(expected == found)
    }
}

impl From<Diagnostic> for Error {
    fn from(error: Diagnostic) -> Error {
        Error::Input(error.into())
    }
}

impl From<Diagnostics> for Error {
    fn from(errors: Diagnostics) -> Error {
        Error::Input(errors)
    }
}
