//! What a bundle may be called: what is a function's name in every generated
//! module, beside all that this may hold.

use alloc::string::{String, ToString};

use super::BundleError;
use crate::outputs::Function;
use crate::robot::ENDINGS;

/// The longest name.
const MAX_BYTES: usize = 64;

/// Names that modules use otherwise; with each the struct of the name is taken too.
const OWN: [&str; 7] = [
    "angles",
    "in_box",
    "load",
    "payload",
    "result",
    "robot",
    "state_box",
];

/// No function can have these names.
const WORDS: [&str; 51] = [
    "abstract", "as", "async", "await", "become", "box", "break", "const", "continue", "crate",
    "do", "dyn", "else", "enum", "extern", "false", "final", "fn", "for", "gen", "if", "impl",
    "in", "let", "loop", "macro", "match", "mod", "move", "mut", "override", "priv", "pub", "ref",
    "return", "self", "static", "struct", "super", "trait", "true", "try", "type", "typeof",
    "unsafe", "unsized", "use", "virtual", "where", "while", "yield",
];

/// Returns whether a bundle may have this name.
pub(in crate::outputs) fn check(name: &str) -> Result<(), BundleError> {
    let own = || name.to_string();
    let known = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_';
    let is_name = name.starts_with(|c: char| c.is_ascii_lowercase())
        && name.chars().all(known)
        && !name.ends_with('_')
        && !name.contains("__")
        && name.len() <= MAX_BYTES;
    if !is_name {
        // Whatever was written, a message has a line's length.
        return Err(BundleError::Name(name.chars().take(MAX_BYTES).collect()));
    }
    if WORDS.contains(&name) {
        return Err(BundleError::Keyword(own()));
    }
    if Function::from_name(name).is_some() {
        return Err(BundleError::Output(own()));
    }
    let structure = camel(name);
    let is_taken = |f: Function| f.structure() == Some(structure.as_str());
    if OWN.contains(&name) || Function::ALL.into_iter().any(is_taken) {
        return Err(BundleError::Taken(own()));
    }
    let ending = ENDINGS.into_iter().find(|ending| name.ends_with(ending));
    match ending {
        Some(ending) => Err(BundleError::Ending(own(), ending)),
        None => Ok(()),
    }
}

/// Returns the struct of a function: `servo_state` returns a `ServoState`.
pub(super) fn camel(name: &str) -> String {
    let words = name.split('_').map(|word| {
        let (first, rest) = word.split_at(word.len().min(1));
        first.to_ascii_uppercase() + rest
    });
    words.collect()
}
