//! Errors of the TOML syntax, in words that say what to write instead.

use alloc::format;
use alloc::string::ToString;

use toml_span::{Error, ErrorKind};

use super::foreign;
use super::report::{Sink, quote};
use crate::number::Angle;
use crate::number::parse::NumberError;

pub(super) fn report(source: &str, error: &Error, sink: &mut Sink) {
    if let Some((format, help)) = foreign::format_of(source) {
        sink.error(0..1, format!("the file is {format}, not TOML"), help);
        return;
    }
    let start = error.span.start.min(source.len());
    let end = error.span.end.clamp(start, source.len());
    let word = word_at(source, start);
    // The parser points behind the zeros that a number begins with.
    let digits = |c: char| c.is_ascii_digit() || matches!(c, '+' | '-' | '.');
    let before = source.get(..start).unwrap_or_default();
    let whole = word_at(source, before.trim_end_matches(digits).len());
    let zeros = foreign::leading_zeros(whole);
    let earlier = |byte: usize| format!("it is first defined on line {}", sink.line(byte));
    let (message, help) = match &error.kind {
        // A text that is not a number may be an angle without its quotes: -pi/2, 90deg.
        ErrorKind::InvalidNumber | ErrorKind::UnquotedString if Angle::parse(word).is_ok() => (
            format!("{} is not a number", quote(word)),
            format!("write \"{word}\", in quotes"),
        ),
        ErrorKind::Unexpected(c @ ('*' | '/')) => (
            format!("expected the end of the value, found `{c}`"),
            "angles and fractions are written in quotes: \"3*pi/4\", \"1/3\"".to_string(),
        ),
        ErrorKind::InvalidNumber if zeros.is_some() => (
            quote(whole) + " begins with a zero, which TOML does not allow",
            format!("write {}", zeros.unwrap_or_default()),
        ),
        ErrorKind::Unexpected(c) if foreign::character(*c).is_some() => {
            let (message, help) = foreign::character(*c).unwrap_or_default();
            (message, help.to_string())
        }
        ErrorKind::InvalidNumber if word.parse().is_ok_and(f64::is_infinite) => (
            format!("{} is {}", quote(word), NumberError::OutOfRange),
            NumberError::OutOfRange.help().to_string(),
        ),
        ErrorKind::InvalidNumber => (
            format!("{} is not a number that TOML can hold", quote(word)),
            "write 0.5 for .5, 5.0 for 5., and integers beyond 64 bits as 1e30".to_string(),
        ),
        ErrorKind::UnquotedString => (
            format!("{} is neither a number nor a quoted string", quote(word)),
            "write text in quotes".to_string(),
        ),
        ErrorKind::DuplicateKey { key, first } => (
            format!("the key {} is defined twice", quote(key)),
            earlier(first.start),
        ),
        ErrorKind::DuplicateTable { name, first } => (
            format!("the table {} is defined twice", quote(name)),
            earlier(first.start) + "; several joints are written [[joint]]",
        ),
        ErrorKind::RedefineAsArray => (
            "a table is defined both as [table] and as [[table]]".to_string(),
            "every joint starts with [[joint]]".to_string(),
        ),
        ErrorKind::DottedKeyInvalidType { first } => (
            "the dotted key extends something that is not a table".to_string(),
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
            let found = match *found {
                "eof" => "the end of the file",
                found => found,
            };
            let meant = foreign::decimal_comma_at(source, start);
            let help = meant.map(|meant| format!("decimals have a point: {meant}"));
            (
                format!("expected {expected}, found {found}"),
                help.unwrap_or_default(),
            )
        }
        _ => (error.to_string(), "".to_string()),
    };
    sink.error(start..end.max(start + 1), message, &help);
}

fn word_at(source: &str, start: usize) -> &str {
    let rest = source.get(start..).unwrap_or_default();
    let end = rest.find(|c: char| c.is_whitespace() || matches!(c, ',' | ']' | '}' | '#'));
    &rest[..end.unwrap_or(rest.len())]
}
