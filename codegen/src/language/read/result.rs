//! The arrays and the struct that an emitted function ends with.
//!
//! Brackets, commas and field names are checked: two fields of one type that trade names
//! would compile.

use dalembert_model::outputs::Axis;

use super::expect;
use crate::function::Function;

/// Returns whether every bracket that opens is closed again.
pub(super) fn is_complete(text: &str) -> bool {
    let depth = text.chars().fold(0i64, |depth, c| match c {
        '{' | '[' => depth + 1,
        '}' | ']' => depth - 1,
        _ => depth,
    });
    !text.trim().is_empty() && depth == 0
}

/// Returns the entries of the result, flat, in the order of the function's quantities.
pub(super) fn items(text: &str, function: Function) -> Result<Vec<&str>, String> {
    let mut words = words(text).into_iter();
    let mut items = Vec::new();
    match function.structure() {
        None => {
            let shape = function.quantities()[0].shape();
            let is_load = function == Function::Load;
            if is_load {
                next(&mut words, "Load(")?;
            }
            array(&mut words, shape.0, &mut items)?;
            if is_load {
                next(&mut words, ")")?;
            }
        }
        Some(name) => {
            next(&mut words, name)?;
            next(&mut words, "{")?;
            for quantity in function.quantities() {
                next(&mut words, quantity.field())?;
                next(&mut words, ":")?;
                array(&mut words, quantity.shape().0, &mut items)?;
                next(&mut words, ",")?;
            }
            next(&mut words, "}")?;
        }
    }
    match words.next() {
        None => Ok(items),
        Some(word) => Err(format!("`{word}` after the result")),
    }
}

type Words<'a> = std::vec::IntoIter<&'a str>;

fn next(words: &mut Words<'_>, expected: &str) -> Result<(), String> {
    expect(words.next().unwrap_or_default(), expected)
}

/// Reads an array of these axes, the outermost first, or one entry; returns how many entries
/// it has. The lengths of inner arrays are equal, as in Rust.
fn array<'a>(
    words: &mut Words<'a>,
    axes: &[Axis],
    items: &mut Vec<&'a str>,
) -> Result<usize, String> {
    let Some((axis, inner)) = axes.split_first() else {
        return match words.next().unwrap_or_default() {
            word @ ("" | "[" | "]" | "{" | "}" | ":" | ",") => {
                Err(format!("`{word}` is no entry of the result"))
            }
            word => {
                items.push(word);
                Ok(1)
            }
        };
    };
    next(words, "[")?;
    let (mut length, mut each) = (0, None);
    while words.as_slice().first() != Some(&"]") {
        let found = array(words, inner, items)?;
        if *each.get_or_insert(found) != found {
            return Err("rows of different lengths".into());
        }
        length += 1;
        if words.as_slice().first() != Some(&"]") {
            next(words, ",")?;
        }
    }
    next(words, "]")?;
    match *axis {
        Axis::Fixed(expected) if length != expected => Err(format!(
            "an array of {expected} expected in the result, not of {length}"
        )),
        _ => Ok(length * each.unwrap_or(0)),
    }
}

/// Brackets, colons and commas, and what is between them.
fn words(mut text: &str) -> Vec<&str> {
    let single = |c: char| matches!(c, '[' | ']' | '{' | '}' | ':' | ',');
    let mut words = Vec::new();
    loop {
        text = text.trim_start();
        let end = text.find(|c: char| single(c) || c.is_whitespace());
        let mut end = end.unwrap_or(text.len()).max(1).min(text.len());
        // `t1`, `q[0]` and `d[0][1]` are one word each: indices follow a name.
        let name = text.trim_start_matches('-');
        while name.starts_with(|c: char| c.is_ascii_lowercase())
            && let Some(index) = text[end..].strip_prefix('[')
            && let Some(close) = index.find(']')
        {
            end += close + 2;
        }
        match text.split_at(end) {
            ("", _) => return words,
            (word, rest) => {
                words.push(word);
                text = rest;
            }
        }
    }
}
