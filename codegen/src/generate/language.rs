//! Refuses by name, before any search, requests that a language cannot express, and shortens names
//! that are too long for a header.

use std::borrow::Cow;
use std::fmt;

use dalembert_model::robot::Robot;
use hmac_sha256::Hash;

use crate::emit::header;
use crate::function::Function;
use crate::language::c99::LONGEST;
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
                 of them, each name once; give the module a short name, by `--name` or, in a build \
                 script, `module`"
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

/// Gives the module of a header a short name where nobody chose one and its own is too long: its
/// beginning, and four digits of its hash, which tell robots apart that begin alike.
///
/// The request stays as it is where no such name is short enough: [`check`] refuses that.
pub(super) fn with_short_name<'a>(robot: &Robot, request: &'a Request) -> Cow<'a, Request> {
    let misnamed = |name: &str| {
        header::misnamed(name, &request.functions, request.entries, &request.scalars).is_some()
    };
    let name = request.module_name(robot);
    if request.language == Language::Rust || request.module.is_some() || !misnamed(&name) {
        return Cow::Borrowed(request);
    }
    let [first, second, ..] = Hash::hash(name.as_bytes());
    let beginnings = (1..name.len())
        .rev()
        .filter_map(|length| name.get(..length));
    let mut shorter = beginnings.map(|beginning| {
        format!(
            "{}_{first:02x}{second:02x}",
            beginning.trim_end_matches('_')
        )
    });
    match shorter.find(|name| !misnamed(name)) {
        None => Cow::Borrowed(request),
        short => Cow::Owned(Request {
            module: short,
            ..request.clone()
        }),
    }
}

/// Returns what to say of a module whose name was shortened.
pub(super) fn renamed(robot: &Robot, request: &Request, named: &Request) -> Option<String> {
    let (name, short) = (request.module_name(robot), named.module_name(robot));
    (name != short).then(|| {
        format!(
            "the module is called `{short}` in C: with `{name}`, names would be longer than {LONGEST} \
             letters, beyond which compilers need not tell them apart; choose another by `--name` or, in a \
             build script, `module`"
        )
    })
}
