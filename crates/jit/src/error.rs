//! The errors of compiling and of calling.

use std::fmt;

use dalembert_codegen::{GenerateError, ScalarType};

/// The reasons for which a program is not compiled.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum CompileError {
    /// The program reads what it does not have.
    Program,
    /// The program returns another number of results than its signature says.
    Results {
        /// The signature's number of results.
        expected: usize,
        /// The program's number of results.
        found: usize,
    },
    /// Cranelift refuses: an unknown processor, or no memory.
    Cranelift(String),
    /// At a state, the code computes another number than the program.
    Differs {
        /// The number of the state among those of the check.
        state: usize,
        /// The number of the result.
        result: usize,
    },
}

impl CompileError {
    pub(crate) fn checked<T>(result: Result<T, impl fmt::Display>) -> Result<T, CompileError> {
        result.map_err(|error| CompileError::Cranelift(error.to_string()))
    }
}

impl fmt::Display for CompileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            CompileError::Program => f.write_str(
                "the program reads an argument or a step that it does not have: a defect of \
                 this library",
            ),
            CompileError::Results { expected, found } => write!(
                f,
                "the program returns {found} numbers, expected {expected}: a defect of this library"
            ),
            CompileError::Cranelift(why) => write!(f, "no machine code for this machine: {why}"),
            CompileError::Differs { state, result } => write!(
                f,
                "machine code is refused: at state {state} of the check, result {result} has \
                 other bits than the proved program"
            ),
        }
    }
}

impl std::error::Error for CompileError {}

/// The reasons for which a function is not called.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum CallError {
    /// It computes in the other scalar.
    Scalar {
        /// The function's.
        expected: ScalarType,
    },
    /// Another number of arguments, or of results, than the function has.
    Count {
        /// The function's.
        expected: usize,
        /// The caller's.
        found: usize,
    },
    /// An argument, or a result, has too few or too many numbers.
    Length {
        /// Its place in the signature; results come after the arguments.
        place: usize,
        /// The number of entries that it must have.
        expected: usize,
        /// The number that it has.
        found: usize,
    },
    /// An entry of some state is outside of its slice.
    Outside {
        /// Its place in the signature.
        place: usize,
    },
    /// Two states, or two entries, of a result are at the same place.
    Overlap {
        /// Its place in the signature.
        place: usize,
    },
    /// There is no machine code for many states.
    Compile(CompileError),
}

impl CallError {
    pub(crate) fn unless(self, holds: bool) -> Result<(), CallError> {
        if holds { Ok(()) } else { Err(self) }
    }

    pub(crate) fn length(place: usize, expected: usize, found: usize) -> Result<(), CallError> {
        let error = CallError::Length {
            place,
            expected,
            found,
        };
        error.unless(expected == found)
    }
}

impl fmt::Display for CallError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            CallError::Scalar { expected } => {
                write!(f, "the function computes in {}", expected.name())
            }
            CallError::Count { expected, found } => {
                write!(f, "expected {expected} arguments or results, found {found}")
            }
            CallError::Length {
                place,
                expected,
                found,
            } => write!(
                f,
                "argument {place}: expected {expected} entries, found {found}"
            ),
            CallError::Outside { place } => {
                write!(f, "argument {place}: an entry is outside of its slice")
            }
            CallError::Overlap { place } => {
                write!(
                    f,
                    "result {place}: two numbers would be written to one place"
                )
            }
            CallError::Compile(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for CallError {}

/// The reasons for which no arm is loaded.
#[derive(Debug)]
#[non_exhaustive]
pub enum LoadError {
    /// The robot cannot be read: everything that is wrong with it, each at its place.
    Robot(String),
    /// The request asks for what there is not.
    Request(String),
    /// Nothing was generated, or not proved.
    Generate(GenerateError),
    /// A function was not compiled.
    Compile(&'static str, CompileError),
}

impl fmt::Display for LoadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            LoadError::Robot(text) | LoadError::Request(text) => f.write_str(text.trim_end()),
            LoadError::Generate(error) => error.fmt(f),
            LoadError::Compile(function, error) => write!(f, "`{function}`: {error}"),
        }
    }
}

impl std::error::Error for LoadError {}
