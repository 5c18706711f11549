//! Values as robot files have them: each reads back exactly.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;
use core::fmt::Write;

use super::units::turns_text;
use super::{BodyRange, Parent, Placement, Position};
use crate::number::parse::write_decimal;
use crate::number::{Angle, Rational};

/// Returns a decimal, or a string where there is none: `"1/3"`.
pub fn number(value: &Rational) -> String {
    write_decimal(value).unwrap_or_else(|| format!("\"{value}\""))
}

/// Returns an angle as a number of radians, or a string with π.
pub fn angle(value: &Angle) -> String {
    match value {
        Angle::Radians(value) => number(value),
        value if value.is_zero() => String::from("0"),
        value => format!("\"{value}\""),
    }
}

/// Returns an angle or a length.
pub fn position(value: &Position) -> String {
    match value {
        Position::Angle(value) => angle(value),
        Position::Length(value) => number(value),
    }
}

/// Returns an array of these texts.
pub fn list(items: impl IntoIterator<Item = String>) -> String {
    let items: Vec<String> = items.into_iter().collect();
    format!("[{}]", items.join(", "))
}

/// Returns an array of numbers.
pub fn numbers<'v>(values: impl IntoIterator<Item = &'v Rational>) -> String {
    list(values.into_iter().map(number))
}

/// Returns an array of the ends of a range.
pub fn range(ends: &[Position; 2]) -> String {
    list(ends.each_ref().map(position))
}

/// Returns a table of `mass` and `radius`.
pub fn bodies(range: &BodyRange) -> Option<String> {
    let radius = Some(number(&range.radius));
    table([("mass", Some(numbers(&range.mass))), ("radius", radius)])
}

pub(crate) fn parent(parent: Parent) -> String {
    match parent {
        Parent::Base => quoted(Parent::BASE),
        Parent::Row(row) => format!("{}", row + 1),
    }
}

/// Returns a table of `xyz` and `rpy`.
pub fn placement(value: &Placement) -> String {
    let (xyz, rpy) = (numbers(&value.xyz), list(value.rpy.iter().map(angle)));
    format!("{{ xyz = {xyz}, rpy = {rpy} }}")
}

/// Returns a value that the reader would not take for granted.
pub fn unless_zero(value: String) -> Option<String> {
    (value != "0").then_some(value)
}

/// Writes the keys that have a value, a line each.
pub fn lines<'k>(text: &mut String, keys: impl IntoIterator<Item = (&'k str, Option<String>)>) {
    for (key, value) in keys {
        if let Some(value) = value {
            // Writing to a string cannot fail.
            let _ = writeln!(text, "{key} = {value}");
        }
    }
}

/// Returns an inline table of the keys that have a value; `None` if none has.
pub fn table<'k>(keys: impl IntoIterator<Item = (&'k str, Option<String>)>) -> Option<String> {
    let mut text = String::new();
    lines(&mut text, keys);
    let keys: Vec<&str> = text.lines().collect();
    (!keys.is_empty()).then(|| format!("{{ {} }}", keys.join(", ")))
}

/// Returns an array of texts, a line each; `None` if there are none.
pub fn texts(texts: &[String]) -> Option<String> {
    let line = |text: &String| format!("    {},\n", quoted(text));
    let lines: String = texts.iter().map(line).collect();
    (!texts.is_empty()).then(|| format!("[\n{lines}]"))
}

/// Returns a text as one line: a character that controls text or turns its direction becomes `�`.
pub fn one_line(text: &str) -> String {
    let shown = |c: char| match c.is_control() || turns_text(c) {
        true => '\u{fffd}',
        false => c,
    };
    text.chars().map(shown).collect()
}

/// Returns the first 16 hexadecimal digits of the SHA-256 of a text.
pub fn short_hash(text: &str) -> String {
    let hash = &hmac_sha256::Hash::hash(text.as_bytes())[..8];
    hash.iter().map(|byte| format!("{byte:02x}")).collect()
}

pub(crate) fn word<T: PartialEq>(words: &[(&'static str, T)], value: &T) -> &'static str {
    let mut words = words.iter();
    let entry = words.find(|(_, meaning)| meaning == value);
    entry.map_or("", |(word, _)| word)
}

/// Returns a text as a TOML basic string.
pub fn quoted(value: &str) -> String {
    let mut text = String::from("\"");
    for c in value.chars() {
        match c {
            '"' | '\\' => {
                text.push('\\');
                text.push(c);
            }
            c if c.is_control() => {
                let _ = write!(text, "\\U{:08X}", u32::from(c));
            }
            c => text.push(c),
        }
    }
    text.push('"');
    text
}
