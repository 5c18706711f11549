//! What a bundle may be called: what is a function's name in every generated
//! module, beside all that this may hold.

use alloc::format;
use alloc::string::String;

use super::BundleError;
use crate::outputs::Function;
use crate::robot::{ENDINGS, WORDS, is_snake};

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

/// Returns whether a bundle may have this name.
pub(in crate::outputs) fn check(name: &str) -> Result<(), BundleError> {
    let bars = name.ends_with('_') || name.contains("__");
    if !is_snake(name) || bars || name.len() > MAX_BYTES {
        // Whatever was written, a message has a line's length.
        let name: String = name.chars().take(MAX_BYTES).collect();
        let help = "small letters, digits and single `_` between them, such as `servo_2`";
        let message = format!("`{name}` is no name of a function");
        return Err(BundleError::new(message, help));
    }
    let structure = camel(name);
    let is_taken = |f: Function| f.structure() == Some(structure.as_str());
    let end = |ending: &'static str| Some((name.strip_suffix(ending)?, ending));
    let message = if WORDS.contains(&name) {
        format!("`{name}` is a word of Rust")
    } else if Function::from_name(name).is_some() {
        format!("`{name}` is an output by itself")
    } else if OWN.contains(&name) || Function::ALL.into_iter().any(is_taken) {
        format!("`{name}` has a meaning of its own in generated modules")
    } else if let Some((of, ending)) = ENDINGS.into_iter().find_map(end) {
        format!("`{name}` would end as the other way to call `{of}` does, `{ending}`")
    } else {
        return Ok(());
    };
    Err(BundleError::new(message, "call the bundle otherwise"))
}

/// Returns the struct of a function: `servo_state` returns a `ServoState`.
pub(super) fn camel(name: &str) -> String {
    let words = name.split('_').map(|word| {
        let (first, rest) = word.split_at(word.len().min(1));
        first.to_ascii_uppercase() + rest
    });
    words.collect()
}
