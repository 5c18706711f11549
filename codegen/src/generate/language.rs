//! Refuses by name, before any search, requests that a language cannot express, and shortens names
//! that are too long for a header.

use std::borrow::Cow;

use dalembert_model::robot::Robot;
use hmac_sha256::Hash;

use super::{GenerateError, Outcome};
use crate::emit::header;
use crate::function::Function;
use crate::language::Language;
use crate::language::c99::LONGEST;
use crate::task::Request;

pub(super) fn check(robot: &Robot, request: &Request, functions: &[Function]) -> Outcome<()> {
    if request.language == Language::Rust {
        return Ok(());
    }
    let name = request.module_name(robot);
    let Some(name) = header::misnamed(&name, functions, request) else {
        return Ok(());
    };
    let message = format!("`{name}` is not a valid C identifier, or is defined twice");
    let help =
        "names have at most 31 letters, digits and `_`: set the option `name` to a short one";
    Err(GenerateError::refused(None, message, help))
}

/// The short name is the beginning of the module's own with four digits of its hash, which tell
/// robots apart that begin alike. Where none is short enough, [`check`] refuses the request.
pub(crate) fn with_short_name<'a>(robot: &Robot, request: &'a Request) -> Cow<'a, Request> {
    let misnamed = |name: &str| header::misnamed(name, &request.functions, request).is_some();
    let name = request.module_name(robot);
    if request.language == Language::Rust || request.module.is_some() || !misnamed(&name) {
        return Cow::Borrowed(request);
    }
    let [first, second, ..] = Hash::hash(name.as_bytes());
    let shortened = |length: usize| {
        let beginning = name.get(..length)?.trim_end_matches('_');
        Some(format!("{beginning}_{first:02x}{second:02x}"))
    };
    let mut shorter = (1..name.len()).rev().filter_map(shortened);
    let Some(short) = shorter.find(|name| !misnamed(name)) else {
        return Cow::Borrowed(request);
    };
    let mut named = request.clone();
    named.module = Some(short);
    Cow::Owned(named)
}

pub(super) fn renamed(robot: &Robot, request: &Request, named: &Request) -> Option<String> {
    let (name, short) = (request.module_name(robot), named.module_name(robot));
    (name != short).then(|| {
        format!(
            "the module is called `{short}` in C: with `{name}`, names would be longer than {LONGEST} \
             letters, beyond which compilers need not tell them apart; the option `name` chooses another"
        )
    })
}
