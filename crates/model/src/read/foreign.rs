//! Likely intentions behind a text that is no TOML: another format, characters that a
//! word processor or a web page puts in, decimal commas, leading zeros.

use alloc::format;
use alloc::string::String;

use crate::number::parse::split_sign;

const DASHES: [char; 9] = [
    '\u{2010}', '\u{2011}', '\u{2012}', '\u{2013}', '\u{2014}', '\u{2015}', '\u{2212}', '\u{fe63}',
    '\u{ff0d}',
];
const QUOTES: [char; 7] = [
    '\u{201c}', '\u{201d}', '\u{201e}', '\u{2018}', '\u{2019}', '\u{00ab}', '\u{00bb}',
];
const SPACES: [char; 5] = ['\u{00a0}', '\u{2007}', '\u{2009}', '\u{202f}', '\u{200b}'];

pub(super) fn format_of(source: &str) -> Option<(&'static str, &'static str)> {
    const TOML: &str =
        "a robot file is TOML: `name = \"arm\"` and a [[joint]] table for every joint";
    const URDF: &str = "a robot file is TOML: `dalembert import FILE` makes one of a URDF";
    let text = source.trim_start_matches('\u{feff}').trim_start();
    let after_bracket = text.strip_prefix('[').map(str::trim_start);
    if text.starts_with('{') || after_bracket.is_some_and(|rest| rest.starts_with('{')) {
        return Some(("JSON", TOML));
    }
    if text.starts_with('<') {
        return Some(match text.contains("<robot") {
            true => ("XML, probably URDF", URDF),
            false => ("XML", TOML),
        });
    }
    let mut lines = text.lines().map(str::trim_end);
    let first = lines.find(|line| !line.is_empty() && !line.starts_with('#'))?;
    let is_word = |key: &str| {
        let plain = |c: char| c.is_alphanumeric() || matches!(c, '_' | '-' | '"' | '\'');
        !key.is_empty() && key.chars().all(plain)
    };
    let is_keyed = first.split_once(':').is_some_and(|(key, value)| {
        is_word(key.trim_end()) && (value.is_empty() || value.starts_with([' ', '\t']))
    });
    (first == "---" || first.starts_with("%YAML") || is_keyed).then_some(("YAML", TOML))
}

pub(super) fn character(c: char) -> Option<(String, &'static str)> {
    let code = u32::from(c);
    let (what, help) = if DASHES.contains(&c) {
        ("no minus sign", "write the minus of the keyboard, `-`")
    } else if QUOTES.contains(&c) {
        let help = "write the quotation mark of the keyboard, `\"`";
        ("no quotation mark", help)
    } else if SPACES.contains(&c) {
        let message = format!("the invisible character U+{code:04X} is not a space in TOML");
        return Some((message, "write an ordinary space"));
    } else {
        return None;
    };
    let message = format!("the character `{c}` (U+{code:04X}) is {what} of TOML");
    Some((message, help))
}

pub(super) fn in_text(text: &str) -> Option<String> {
    if let Some(dash) = text.chars().find(|c| DASHES.contains(c)) {
        let meant = text.replace(dash, "-");
        return Some(format!("write \"{meant}\", with the minus of the keyboard"));
    }
    decimal_comma(text.trim()).map(|meant| format!("decimals have a point: {meant}"))
}

fn decimal_comma(text: &str) -> Option<String> {
    let (whole, part) = text.split_once(',')?;
    let digits = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
    let alone = whole.strip_prefix(['-', '+']).unwrap_or(whole);
    let fraction = part.split(['e', 'E']).next().unwrap_or(part);
    (digits(alone) && digits(fraction)).then(|| format!("{whole}.{part}"))
}

pub(super) fn decimal_comma_at(source: &str, comma: usize) -> Option<String> {
    let (before, rest) = (source.get(..comma)?, source.get(comma..)?);
    let ends = |c: char| c.is_whitespace() || matches!(c, '=' | '[' | '{' | ']' | '}' | '#');
    let start = before.rfind(ends).map_or(0, |at| at + 1);
    let end = rest.find(ends).unwrap_or(rest.len());
    let text = source.get(start..comma + end)?;
    decimal_comma(text.trim_end_matches(','))
}

/// Gives `-9.81` for `[0, 0, -9,81]`.
pub(super) fn decimal_comma_in(array: &str) -> Option<String> {
    let inner = array.trim().trim_start_matches('[').trim_end_matches(']');
    let mut words = inner.split_whitespace();
    words.find_map(|word| decimal_comma(word.trim_end_matches(',')))
}

pub(super) fn leading_zeros(word: &str) -> Option<String> {
    let (negative, digits) = split_sign(word);
    let sign = if negative { "-" } else { "" };
    let rest = digits.trim_start_matches('0');
    let zeros = digits.len() - rest.len();
    let is_whole = rest.starts_with(|c: char| c.is_ascii_digit());
    let is_part = |b: u8| b.is_ascii_digit() || b"._eE+-".contains(&b);
    match (digits.bytes().all(is_part), zeros, is_whole) {
        (true, 1.., true) => Some(format!("{sign}{rest}")),
        (true, 2.., false) => digits.get(zeros - 1..).map(|rest| format!("{sign}{rest}")),
        _ => None,
    }
}
