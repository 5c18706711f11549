//! The arrays and the struct that a function ends with.

use crate::function::{Function, Quantity, Sizes};
use crate::language::list;
use crate::program::ScalarType;

pub(crate) fn array_type(quantity: Quantity, sizes: Sizes, scalar: ScalarType) -> String {
    let array = |inner: String, length: usize| format!("[{inner}; {length}]");
    let lengths = quantity.shape().lengths(sizes).rev();
    lengths.fold(scalar.name().to_owned(), array)
}

pub(crate) fn structure(function: Function, sizes: Sizes, scalar: ScalarType) -> Option<String> {
    let name = function.structure()?;
    let mut text = format!("/// What [`{function}`] returns.\n");
    text.push_str("#[derive(Clone, Copy, Debug, PartialEq)]\n");
    text += &format!("pub struct {name} {{\n");
    for &quantity in function.quantities() {
        let (doc, field) = (quantity.facts().summary, quantity.field());
        let array = array_type(quantity, sizes, scalar);
        text += &format!("    /// {doc}\n    pub {field}: {array},\n");
    }
    text.push_str("}\n");
    Some(text)
}

pub(super) fn write(
    text: &mut String,
    function: Function,
    sizes: Sizes,
    mut items: impl Iterator<Item = String>,
) {
    let lengths = |quantity: Quantity| -> Vec<usize> { quantity.shape().lengths(sizes).collect() };
    match function.structure() {
        None => {
            let [before, after] = match function {
                Function::Load => ["Load(", ")"],
                _ => [""; 2],
            };
            *text += &format!("    {before}");
            write_array(text, &mut items, &lengths(function.quantities()[0]), 1);
            *text += &format!("{after}\n");
        }
        Some(name) => {
            *text += &format!("    {name} {{\n");
            for quantity in function.quantities() {
                *text += &format!("        {}: ", quantity.field());
                write_array(text, &mut items, &lengths(*quantity), 2);
                text.push_str(",\n");
            }
            text.push_str("    }\n");
        }
    }
}

fn write_array(
    text: &mut String,
    items: &mut impl Iterator<Item = String>,
    lengths: &[usize],
    depth: usize,
) {
    let indent = "    ".repeat(depth);
    match *lengths {
        [] => text.push_str(&items.next().unwrap_or_default()),
        [length] => *text += &format!("[{}]", list(items.take(length))),
        [length, ref inner @ ..] => {
            text.push_str("[\n");
            for _ in 0..length {
                *text += &format!("{indent}    ");
                write_array(text, items, inner, depth + 1);
                text.push_str(",\n");
            }
            *text += &format!("{indent}]");
        }
    }
}
