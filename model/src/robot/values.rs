//! Values as robot files have them: each reads back exactly.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;
use core::fmt::Write;

use super::{Placement, Position};
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

/// Returns a table of `xyz` and `rpy`.
pub fn placement(value: &Placement) -> String {
    let (xyz, rpy) = (value.xyz.iter().map(number), value.rpy.iter().map(angle));
    format!("{{ xyz = {}, rpy = {} }}", list(xyz), list(rpy))
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
