//! Lists of outputs by name.

use alloc::format;
use alloc::vec::Vec;

use toml_span::Value;

use super::suggest;
use super::value::Context;
use crate::outputs::Function;

/// Reads a list of outputs by name, bundles among them; `whose` is the owner of the list in
/// messages.
pub(super) fn outputs(cx: &mut Context, value: &Value, whose: &str) -> Option<Vec<Function>> {
    let items = cx.list(value, "a list", "outputs = [\"inverse_dynamics\"]")?;
    if items.is_empty() {
        let message = format!("{whose} wants one output at least");
        return cx.refuse(value, message, "leave `outputs` out for the request's");
    }
    let words = Function::ALL.map(|function| (function.name(), function));
    let mut outputs: Vec<Function> = Vec::new();
    cx.each(items, |cx, _, item| {
        let is_bundle = |text: &&str| text.contains(['=', '+', '@', ':']);
        let output = match item.as_str().filter(is_bundle).map(Function::parse) {
            None => cx.word(item, &words, "")?,
            Some(Ok(bundle)) => bundle,
            Some(Err(error)) => {
                let error = error.among(&outputs);
                let help = suggest::for_bundle(&error);
                return cx.refuse(item, error.message, &help);
            }
        };
        if outputs.iter().any(|other| output.is_namesake(*other)) {
            let message = format!("`{}` is in the list already", output.name());
            return cx.refuse(item, message, "once is enough");
        }
        outputs.push(output);
        Some(())
    })?;
    Some(outputs)
}
