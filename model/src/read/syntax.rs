//! Errors of the TOML syntax, in words that say what to write instead.

use alloc::format;
use alloc::string::ToString;

use toml_span::{Error, ErrorKind};

use super::report::{Sink, quote};

/// Reports an error of the TOML parser.
pub(super) fn report(source: &str, error: &Error, sink: &mut Sink) {
    let start = error.span.start.min(source.len());
    let end = error.span.end.clamp(start, source.len());
    let text = source.get(start..end).unwrap_or_default();
    let earlier = |byte: usize| format!("it is first defined on line {}", sink.position(byte).0);
    let (message, help) = match &error.kind {
        ErrorKind::InvalidNumber => (
            format!("{} is not a number that TOML can hold", quote(text)),
            "write 0.5 for .5, 5.0 for 5., and integers beyond 64 bits as 1e30".to_string(),
        ),
        ErrorKind::UnquotedString => (
            format!("{} is neither a number nor a quoted string", quote(text)),
            format!("write \"{}\"", text.trim_end_matches(',').trim()),
        ),
        ErrorKind::DuplicateKey { key, first } => (
            format!("the key {} is defined twice", quote(key)),
            earlier(first.start),
        ),
        ErrorKind::DuplicateTable { name, first } => (
            format!("the table {} is defined twice", quote(name)),
            format!(
                "{}; several joints are written [[joint]]",
                earlier(first.start)
            ),
        ),
        ErrorKind::RedefineAsArray => (
            "a table is defined both as [table] and as [[table]]".to_string(),
            "every joint starts with [[joint]]".to_string(),
        ),
        ErrorKind::DottedKeyInvalidType { first } => (
            "the dotted key extends something that is no table".to_string(),
            earlier(first.start),
        ),
        ErrorKind::UnterminatedString => (
            "the string has no end".to_string(),
            "close it with a quotation mark on the same line".to_string(),
        ),
        ErrorKind::InvalidCharInString('\n') => (
            "the string does not end on its line".to_string(),
            "close it with a quotation mark".to_string(),
        ),
        ErrorKind::UnexpectedEof => (
            "the file ends in the middle of a value".to_string(),
            "close the brackets and write a value after every `=`".to_string(),
        ),
        ErrorKind::Wanted { expected, found } => {
            let found = if *found == "eof" {
                "the end of the file"
            } else {
                found
            };
            (
                format!("expected {expected}, found {found}"),
                "".to_string(),
            )
        }
        _ => (error.to_string(), "".to_string()),
    };
    sink.error(start..end.max(start + 1), message, &help);
}
