//! Certificates as JSON: one, or a list of them.
//!
//! - `document`: the fields
//! - `program`: programs as lists of lines; `polynomials`: sines' code

mod document;
mod polynomials;
mod program;

use super::Certificate;
use document::Document;

/// The version of the format.
const VERSION: u32 = 2;

/// A range: both ends are numbers.
type Ends = [f64; 2];

/// Returns the text of certificates: one by itself, several as a list.
pub fn write(certificates: &[&Certificate]) -> String {
    let documents: Vec<Document> = certificates.iter().map(|c| Document::of(c)).collect();
    // Strings and numbers only: nothing that JSON does not have.
    let text = match documents.as_slice() {
        [one] => serde_json::to_string_pretty(one),
        all => serde_json::to_string_pretty(all),
    };
    compact(&text.unwrap_or_default()) + "\n"
}

/// Lists of numbers on one line each.
fn compact(pretty: &str) -> String {
    let mut text = String::with_capacity(pretty.len());
    let mut rest = pretty;
    while let Some(start) = rest.find(['[', '"']) {
        let (before, from) = rest.split_at(start);
        text.push_str(before);
        let end = if from.starts_with('"') {
            string_end(from)
        } else {
            let end = numbers_end(from);
            if let Some(end) = end {
                let words: Vec<&str> = from[..end].split_whitespace().collect();
                text.push_str(&words.join(" ").replace("[ ", "[").replace(" ]", "]"));
                rest = &from[end..];
                continue;
            }
            1
        };
        text.push_str(&from[..end]);
        rest = &from[end..];
    }
    text.push_str(rest);
    text
}

/// Returns the length of the string that a text begins with.
fn string_end(text: &str) -> usize {
    let mut escaped = false;
    for (index, byte) in text.bytes().enumerate().skip(1) {
        match byte {
            _ if escaped => escaped = false,
            b'\\' => escaped = true,
            b'"' => return index + 1,
            _ => {}
        }
    }
    text.len()
}

/// Returns the length of the list that a text begins with, if all in it are numbers
/// and lists of them.
fn numbers_end(text: &str) -> Option<usize> {
    let mut depth = 0;
    for (index, byte) in text.bytes().enumerate() {
        match byte {
            b'[' => depth += 1,
            b']' if depth == 1 => return (index > 1).then_some(index + 1),
            b']' => depth -= 1,
            b'"' | b'{' => return None,
            _ => {}
        }
    }
    None
}

impl Certificate {
    /// Returns the certificate as JSON.
    pub fn to_json(&self) -> String {
        write(&[self])
    }
}
