//! Certificates as JSON: one, or a list of them.
//!
//! - `document`: the fields, derived for reading and writing alike
//! - `error`: why a text is none
//! - `program`: programs as lists of lines; `polynomials`: sines' code
//!
//! Reading is strict. A key that is unknown, missing or there twice is
//! refused, and so is whatever would be written differently: a certificate
//! has one text, but for white space and the digits of its numbers, and no
//! place for words that nobody checks. The programs come from their listings,
//! sines from their own code; the printed text is only ever compared.

mod document;
mod error;
mod polynomials;
mod program;

use super::Certificate;
use document::Document;
pub use document::text_hash;
pub use error::FormatError;
pub(crate) use error::FormatFault;

/// The version of the format.
pub(crate) const VERSION: u32 = 2;

/// The longest file that is read.
pub const MAX_BYTES: usize = 16 << 20;

/// The most certificates of a file: one a function and scalar.
pub(crate) const MAX_CERTIFICATES: usize = 16;

/// A range: both ends are numbers.
type Ends = [f64; 2];

/// Reads a certificate, or a list of them. Nothing that it says is believed:
/// that is for [`Certificate::check`] to decide.
///
/// # Errors
/// What is not as [`write`] writes it.
pub fn read(text: &str) -> Result<Vec<Certificate>, FormatError> {
    if text.len() > MAX_BYTES {
        return Err(FormatFault::TooLong.into());
    }
    let documents: Vec<Document> = match text.trim_start().starts_with('[') {
        true => serde_json::from_str(text)?,
        false => vec![serde_json::from_str(text)?],
    };
    match documents.len() {
        0 => return Err(FormatFault::Empty.into()),
        n if n > MAX_CERTIFICATES => {
            return Err(FormatFault::TooMany(n).into());
        }
        _ => {}
    }
    let one = |document: &Document| document.certificate().map_err(FormatError::from);
    documents.iter().map(one).collect()
}

/// The text of certificates: one by itself, several as a list.
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

/// The length of the string that a text begins with.
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

/// The length of the list that a text begins with, if all in it are numbers
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
    /// The certificate as JSON; [`read`] reads it back.
    pub fn to_json(&self) -> String {
        write(&[self])
    }
}
