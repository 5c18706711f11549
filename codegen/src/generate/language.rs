//! Refuses by name, before any search, requests that a language cannot express.

use std::fmt;

use dalembert_model::robot::Robot;

use crate::emit::header;
use crate::function::Function;
use crate::language::Language;
use crate::task::Request;

/// A request that a language cannot express.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Lacks {
    /// A name that all compilers take, for this one.
    Name(String),
}

impl fmt::Display for Lacks {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Lacks::Name(name) => write!(
                f,
                "`{name}` is no name that every compiler takes: letters, digits and `_`, at most 31 \
                 of them, each name once; give the module a short name"
            ),
        }
    }
}

/// Refuses what the language lacks.
pub(super) fn check(robot: &Robot, request: &Request, functions: &[Function]) -> Result<(), Lacks> {
    if request.language == Language::Rust {
        return Ok(());
    }
    let name = request.module_name(robot);
    match header::misnamed(&name, functions, request.batch, &request.scalars) {
        Some(name) => Err(Lacks::Name(name)),
        None => Ok(()),
    }
}
