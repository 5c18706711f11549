//! The arrays and the struct that an emitted function ends with.
//!
//! Brackets, commas and field names are checked: two fields of one type that
//! trade names would compile.

use dalembert_model::outputs::Axis;

use super::error::{Kind, TextFault, WordFault};
use crate::function::Function;

/// Whether every bracket that opens is closed again.
pub(super) fn is_complete(text: &str) -> bool {
    let depth = text.chars().fold(0i64, |depth, c| match c {
        '{' | '[' => depth + 1,
        '}' | ']' => depth - 1,
        _ => depth,
    });
    !text.trim().is_empty() && depth == 0
}

/// The entries of the result, flat, in the order of the function's quantities.
pub(super) fn items(text: &str, function: Function) -> Result<Vec<&str>, TextFault> {
    let mut words = Words(text.trim());
    let mut items = Vec::new();
    match function.structure() {
        None => {
            let is_load = function == Function::Load;
            if is_load {
                words.expect("Load(")?;
            }
            let shape = function.quantities()[0].shape();
            array(&mut words, shape.0, &mut items)?;
            if is_load {
                words.expect(")")?;
            }
        }
        Some(name) => {
            words.expect(name)?;
            words.expect("{")?;
            for quantity in function.quantities() {
                words.expect(quantity.field())?;
                words.expect(":")?;
                array(&mut words, quantity.shape().0, &mut items)?;
                words.expect(",")?;
            }
            words.expect("}")?;
        }
    }
    match words.next() {
        "" => Ok(items),
        word => Err(TextFault::Trailing(word.to_owned())),
    }
}

/// An array of these axes, the outermost first, or one entry; returns how many
/// entries it has. The lengths of inner arrays are equal, as in Rust.
fn array<'a>(
    words: &mut Words<'a>,
    axes: &[Axis],
    items: &mut Vec<&'a str>,
) -> Result<usize, TextFault> {
    let Some((axis, inner)) = axes.split_first() else {
        return match words.next() {
            word @ ("" | "[" | "]" | "{" | "}" | ":" | ",") => Err(Kind::Entry.not(word).into()),
            word => {
                items.push(word);
                Ok(1)
            }
        };
    };
    words.expect("[")?;
    let (mut len, mut each) = (0, None);
    while words.peek() != "]" {
        let found = array(words, inner, items)?;
        if *each.get_or_insert(found) != found {
            return Err(TextFault::Ragged);
        }
        len += 1;
        if words.peek() != "]" {
            words.expect(",")?;
        }
    }
    words.expect("]")?;
    match *axis {
        Axis::Fixed(expected) if len != expected => Err(TextFault::Length {
            expected,
            found: len,
        }),
        _ => Ok(len * each.unwrap_or(0)),
    }
}

/// Brackets, colons and commas, and what is between them.
struct Words<'a>(&'a str);

impl<'a> Words<'a> {
    fn peek(&self) -> &'a str {
        Words(self.0).next()
    }

    /// The next word; empty at the end.
    fn next(&mut self) -> &'a str {
        let text = self.0.trim_start();
        let single = |c: char| matches!(c, '[' | ']' | '{' | '}' | ':' | ',');
        let end = match text.find(|c: char| single(c) || c.is_whitespace()) {
            Some(0) => 1,
            Some(end) => end,
            None => text.len(),
        };
        // `t1`, `q[0]` and `d[0][1]` are one word each: indices follow a name.
        let mut end = end;
        while is_name(&text[..end])
            && let Some(index) = text[end..].strip_prefix('[')
            && let Some(close) = index.find(']')
        {
            end += close + 2;
        }
        let (word, rest) = text.split_at(end);
        self.0 = rest;
        word
    }

    fn expect(&mut self, expected: &str) -> Result<(), WordFault> {
        match self.next() {
            word if word == expected => Ok(()),
            word => Err(WordFault::InsteadInResult {
                expected: expected.to_owned(),
                found: word.to_owned(),
            }),
        }
    }
}

fn is_name(word: &str) -> bool {
    word.trim_start_matches('-')
        .starts_with(|c: char| c.is_ascii_lowercase())
}
