//! Refuses by name, before any search, requests that a language cannot express.

use std::fmt;

use dalembert_model::robot::Robot;

use crate::emit::header;
use crate::function::Function;
use crate::language::{Entries, Language};
use crate::task::{Interface, Layout, Request};

/// A request that a language cannot express.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Lacks {
    /// A way to call functions.
    Entries(Entries),
    /// Contracts; of C it lacks them for batches only.
    Contracts,
    /// Traits.
    Traits,
    /// The contents of a module: there is one header.
    Contents,
    /// A name that all compilers take, for this one.
    Name(String),
}

impl fmt::Display for Lacks {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Lacks::Entries(entries) => write!(
                f,
                "it has no entries `{}`: ask for `single` or `batch`",
                entries.name()
            ),
            Lacks::Contracts => f.write_str(
                "it has no contracts here: functions of one state in `c` have them, so ask for that \
                 language and the entries `single`, or leave `--acsl` out",
            ),
            Lacks::Traits => f.write_str("it has no traits: leave the interface out"),
            Lacks::Contents => f.write_str(
                "it has no modules, and one header for all scalars: leave the layout `contents` out",
            ),
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
    let has_contracts = request.language == Language::C && request.entries == Entries::Single;
    if request.acsl && !has_contracts {
        return Err(Lacks::Contracts);
    }
    if request.language == Language::Rust {
        return Ok(());
    }
    match request.entries {
        Entries::Single | Entries::Batch => {}
        other => return Err(Lacks::Entries(other)),
    }
    if request.interface == Interface::Traits {
        return Err(Lacks::Traits);
    }
    if request.layout == Layout::Contents {
        return Err(Lacks::Contents);
    }
    let name = request.module_name(robot);
    match header::misnamed(&name, functions, request.entries, &request.scalars) {
        Some(name) => Err(Lacks::Name(name)),
        None => Ok(()),
    }
}
