//! The functions that a file, or one of its scenes, is for.

use alloc::format;
use alloc::vec::Vec;

use toml_span::Value;

use super::suggest;
use super::value::{Context, first_line};
use crate::outputs::Function;

/// Reads a list of outputs by name, bundles among them; `None` if something in it was no
/// output, which was said then. `whose` is what the list belongs to, for messages.
pub(super) fn read(cx: &mut Context, value: &Value, whose: &str) -> Option<Vec<Function>> {
    let Some(items) = value.as_array() else {
        cx.wanted(value, "a list", "outputs = [\"inverse_dynamics\"]");
        return None;
    };
    if items.is_empty() {
        let span = first_line(cx.source, Context::span(value));
        let message = format!("{whose} wants one output at least");
        let help = "leave `outputs` out for the request's";
        cx.sink.error(span, message, help);
    }
    let mut outputs: Vec<Function> = Vec::new();
    let mut complete = true;
    for item in items {
        let Some(output) = output(cx, item, &outputs) else {
            complete = false;
            continue;
        };
        if outputs.iter().any(|other| output.is_namesake(*other)) {
            let message = format!("`{}` is in the list already", output.name());
            let span = Context::span(item);
            cx.sink.error(span, message, "once is enough");
        } else {
            outputs.push(output);
        }
    }
    complete.then_some(outputs)
}

/// Reads an output by its name, one at a frame, or a bundle of some.
fn output(cx: &mut Context, item: &Value, before: &[Function]) -> Option<Function> {
    let words = Function::ALL.map(|function| (function.name(), function));
    let Some(text) = item
        .as_str()
        .filter(|text| text.contains(['=', '+', '@', ':']))
    else {
        return cx.word(item, &words);
    };
    match Function::parse(text) {
        Ok(bundle) => Some(bundle),
        Err(error) => {
            let error = error.among(before);
            let help = suggest::for_bundle(&error);
            cx.sink.error(Context::span(item), error.message(), &help);
            None
        }
    }
}
