//! The warnings that a file knows of, by name.

use alloc::format;

use toml_span::Value;

use super::report::quote;
use super::suggest;
use super::value::Context;
use crate::robot::RobotWarning;

/// Reads the list and keeps its warnings from being said. A name that there is
/// not is an error: it silences nothing, and whoever wrote it thinks it does.
pub(super) fn read(cx: &mut Context, value: &Value) {
    let names = RobotWarning::WORDS.map(|(name, _)| name);
    let Some(items) = value.as_array() else {
        let help = format!("allow = [\"{}\"]", names[0]);
        cx.wanted(value, "an array of the names of warnings", &help);
        return;
    };
    for item in items {
        let Some(text) = cx.string(item) else {
            continue;
        };
        let mut words = RobotWarning::WORDS.iter();
        if let Some((_, warning)) = words.find(|(name, _)| *name == text) {
            cx.sink.allow(*warning);
            continue;
        }
        let message = format!("there is no warning {}", quote(&text));
        let help = match suggest::closest(&text, &names) {
            Some(meant) => format!("did you mean \"{meant}\"?"),
            None => format!("warnings are: {}", names.join(", ")),
        };
        cx.sink.error(Context::span(item), message, &help);
    }
}
