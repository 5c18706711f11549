//! One value of the file: a number, an angle, a word, a vector, a tensor.
//!
//! Every reader returns `None` after reporting what is wrong, so that its
//! caller goes on with the rest of the file.

use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use core::ops::Range;

use toml_span::Value;
use toml_span::value::{Table, ValueInner};

use super::report::{Sink, quote};
use super::table::Keys;
use super::{RobotWarning, foreign, suggest};
use crate::number::parse::{parse_decimal, parse_fraction};
use crate::number::{Angle, Rational, Snap, Snapped};
use crate::robot::{Inertia, Placement};

/// The source, the sink and the options of a reading.
pub(super) struct Context<'s, 'k> {
    pub(super) source: &'s str,
    pub(super) snap: Snap,
    pub(super) sink: &'k mut Sink<'s>,
}

impl<'s> Context<'s, '_> {
    /// Returns the bytes of a value. The parser leaves the quotes of a string out,
    /// and for an empty one points at the quote alone.
    pub(super) fn span(value: &Value) -> Range<usize> {
        value.span.start..value.span.end.max(value.span.start)
    }

    /// Returns the literal of a number as it stands in the source.
    fn literal(&self, value: &Value) -> &'s str {
        self.source.get(Self::span(value)).unwrap_or_default()
    }

    /// Says that a value has the wrong type.
    pub(super) fn wanted(&mut self, value: &Value, expected: &str, help: &str) {
        let found = match value.as_ref() {
            ValueInner::String(text) => format!("the string {}", quote(text)),
            ValueInner::Integer(_) | ValueInner::Float(_) => {
                format!("the number {}", quote(self.literal(value)))
            }
            ValueInner::Boolean(flag) => format!("`{flag}`"),
            ValueInner::Array(items) => format!("an array of {}", items.len()),
            ValueInner::Table(_) => "a table".to_string(),
        };
        let span = first_line(self.source, Self::span(value));
        let message = format!("expected {expected}, found {found}");
        self.sink.error(span, message, help);
    }

    /// Reads a number, exact; `"1/3"` too.
    pub(super) fn number(&mut self, value: &Value) -> Option<Rational> {
        self.number_of(
            value,
            "write the number alone, in SI units, or a fraction such as \"1/3\"",
        )
    }

    /// Reads a length, m.
    pub(super) fn length(&mut self, value: &Value) -> Option<Rational> {
        self.number_of(
            value,
            "write metres as a number alone, or a fraction such as \"1/3\"",
        )
    }

    /// Reads a velocity or an acceleration of a joint that turns, called so: a number, and
    /// of an angle the help says which.
    pub(super) fn rate(&mut self, value: &Value, what: &str) -> Option<Rational> {
        let text = value.as_str().unwrap_or_default();
        let a_second = text.trim().trim_end_matches("/s²").trim_end_matches("/s");
        if parse_decimal(a_second).is_err()
            && let Ok(angle) = Angle::parse(a_second)
        {
            let radians = angle.to_f64();
            let unit = match what {
                "acceleration" => "rad/s²",
                _ => "rad/s",
            };
            let help = format!("in {unit}, as a number: write {radians:.4}");
            self.wanted(value, "a number", &help);
            return None;
        }
        self.number(value)
    }

    /// Reads a part of something, without unit.
    pub(super) fn part(&mut self, value: &Value) -> Option<Rational> {
        self.number_of(
            value,
            "write the part as a number, 0.01 for 1%, or a fraction such as \"1/100\"",
        )
    }

    /// Reads a number; `help` is for what is none.
    fn number_of(&mut self, value: &Value, help: &str) -> Option<Rational> {
        let parsed = match value.as_ref() {
            ValueInner::Integer(_) | ValueInner::Float(_) => parse_decimal(self.literal(value)),
            ValueInner::String(text) if text.contains('/') && !text.contains("pi") => {
                parse_fraction(text)
            }
            ValueInner::String(text) if parse_decimal(text.trim()).is_ok() => {
                self.wanted(value, "a number", "write it without quotes");
                return None;
            }
            ValueInner::String(text) if Angle::parse(text).is_ok() => {
                self.wanted(value, "a number", "this value is no angle");
                return None;
            }
            ValueInner::String(text) if foreign::in_text(text).is_some() => {
                let help = foreign::in_text(text).unwrap_or_default();
                self.wanted(value, "a number", &help);
                return None;
            }
            _ => {
                self.wanted(value, "a number", help);
                return None;
            }
        };
        parsed
            .map_err(|error| {
                let text = quote(self.literal(value));
                let message = format!("{text} is {error}");
                self.sink.error(Self::span(value), message, error.help());
            })
            .ok()
    }

    /// Reads an angle: radians as a number, or one of the text forms.
    pub(super) fn angle(&mut self, value: &Value) -> Option<Angle> {
        const FORMS: &str = "radians as a number, \"pi/2\", \"-3*pi/4\" or \"90deg\"";
        let snapped = match value.as_ref() {
            ValueInner::String(text) => match Angle::parse(text) {
                Ok(angle) => Snap::near(angle),
                Err(_) if parse_decimal(text.trim()).is_ok() => {
                    let number = text.trim();
                    let help = format!(
                        "of radians write {number} without quotes, of degrees \"{number}deg\""
                    );
                    self.wanted(value, "an angle", &help);
                    return None;
                }
                Err(_) => {
                    let help = foreign::in_text(text);
                    let help = help.unwrap_or_else(|| format!("write {FORMS}"));
                    self.wanted(value, "an angle", &help);
                    return None;
                }
            },
            ValueInner::Integer(_) | ValueInner::Float(_) => self.snap.apply(self.number(value)?),
            _ => {
                self.wanted(value, "an angle", &format!("write {FORMS}"));
                return None;
            }
        };
        Some(self.snapped(value, snapped))
    }

    /// Says what became of an angle.
    fn snapped(&mut self, value: &Value, snapped: Snapped) -> Angle {
        let span = Self::span(value);
        let text = self.literal(value);
        let written = |multiple: &Angle| match multiple.is_zero() {
            true => "0".to_string(),
            false => format!("\"{multiple}\""),
        };
        match snapped {
            Snapped::Kept(angle) => angle,
            Snapped::Taken(angle) => {
                let message = format!("{text} is read as {angle}");
                let help = format!("write {} to say so", written(&angle));
                self.sink.note(span, message, &help);
                angle
            }
            Snapped::Near {
                angle,
                multiple,
                distance,
            } => {
                let message =
                    format!("{text} is {distance:.1e} from {multiple}; it stays as written");
                let help = format!("write {} if you mean it", written(&multiple));
                let warning = RobotWarning::NearRightAngle;
                self.sink.warning(warning, span, message, &help);
                angle
            }
        }
    }

    /// Reads a text.
    pub(super) fn string(&mut self, value: &Value) -> Option<String> {
        let text = value.as_str().map(ToString::to_string);
        if text.is_none() {
            self.wanted(value, "a string", "write it in quotes");
        }
        text
    }

    /// Reads one of a few words.
    pub(super) fn word<T: Copy>(&mut self, value: &Value, words: &[(&str, T)]) -> Option<T> {
        self.word_or(value, words, "")
    }

    /// Reads one of a few words; `which` says what they mean to whoever wrote none that is
    /// like them.
    pub(super) fn word_or<T: Copy>(
        &mut self,
        value: &Value,
        words: &[(&str, T)],
        which: &str,
    ) -> Option<T> {
        let names: Vec<&str> = words.iter().map(|(name, _)| *name).collect();
        let listed: Vec<String> = names.iter().map(|n| format!("\"{n}\"")).collect();
        let listed = listed.join(" or ");
        let Some(text) = value.as_str() else {
            self.wanted(value, &listed, which);
            return None;
        };
        if let Some((_, meaning)) = words.iter().find(|(name, _)| *name == text) {
            return Some(*meaning);
        }
        let help = match suggest::closest(text, &names) {
            Some(meant) => format!("did you mean \"{meant}\"?"),
            None if text == "fixed" => {
                "a joint that does not move is part of the link before it".to_string()
            }
            None => which.to_string(),
        };
        self.wanted(value, &listed, &help);
        None
    }

    /// Reads a table.
    pub(super) fn table<'v, 'de>(
        &mut self,
        value: &'v Value<'de>,
        help: &str,
    ) -> Option<&'v Table<'de>> {
        let table = value.as_table();
        if table.is_none() {
            self.wanted(value, "a table", help);
        }
        table
    }

    /// `N` values in an array, each read by `item`; all of them are looked at
    /// before it gives up.
    pub(super) fn array<T, const N: usize>(
        &mut self,
        value: &Value,
        help: &str,
        mut item: impl FnMut(&mut Self, &Value) -> Option<T>,
    ) -> Option<[T; N]> {
        let items = value.as_array().filter(|items| items.len() == N);
        let Some(items) = items else {
            let comma = foreign::decimal_comma_in(self.literal(value));
            let comma = comma.filter(|_| value.as_array().is_some());
            let comma = comma.map(|meant| format!("decimals have a point: {meant}"));
            self.wanted(
                value,
                &format!("an array of {N}"),
                comma.as_deref().unwrap_or(help),
            );
            return None;
        };
        let read: Vec<Option<T>> = items.iter().map(|v| item(self, v)).collect();
        let read: Option<Vec<T>> = read.into_iter().collect();
        read?.try_into().ok()
    }

    /// Reads a placement; `what` is the key that has it.
    pub(super) fn placement(&mut self, value: &Value, what: &str) -> Option<Placement> {
        let help = format!("{what} = {{ xyz = [0, 0, 0.1], rpy = [0, \"pi/2\", 0] }}");
        let keys = Keys {
            table: self.table(value, &help)?,
            span: first_line(self.source, Self::span(value)),
            what: what.to_string(),
        };
        keys.reject_unknown(&["xyz", "rpy"], self.sink);
        self.placement_of(&keys)
    }

    /// Reads the placement that the keys of a table say, among others.
    pub(super) fn placement_of(&mut self, keys: &Keys) -> Option<Placement> {
        const XYZ: &str = "xyz = [x, y, z], in m";
        const RPY: &str = "rpy = [roll, pitch, yaw], turns about the fixed axes x, y and z, e.g. [0, \"pi/2\", 0]";
        let mut placement = Placement::default();
        let (xyz, rpy) = (keys.get("xyz"), keys.get("rpy"));
        let xyz = xyz.map(|value| self.array(value, XYZ, Self::length));
        let rpy = rpy.map(|value| self.array(value, RPY, Self::angle));
        if let Some(xyz) = xyz {
            placement.xyz = xyz?;
        }
        if let Some(rpy) = rpy {
            placement.rpy = rpy?;
        }
        Some(placement)
    }

    /// Reads an inertia tensor: six entries or three rows.
    pub(super) fn inertia(&mut self, value: &Value) -> Option<Inertia<Rational>> {
        const HELP: &str =
            "write [Ixx, Iyy, Izz, Ixy, Iyz, Ixz] or three rows of three, about the centre of mass";
        let items = value.as_array().map(Vec::as_slice).unwrap_or_default();
        let rows = items.len() == 3 && items.iter().any(|item| item.as_array().is_some());
        if rows {
            let rows = self.array::<_, 3>(value, HELP, |cx, row| {
                cx.array::<_, 3>(row, HELP, Self::number)
            })?;
            return self.symmetric(value, rows);
        }
        if items.len() != 6 {
            let comma = foreign::decimal_comma_in(self.literal(value));
            let comma = comma.filter(|_| value.as_array().is_some());
            let comma = comma.map(|meant| format!("decimals have a point: {meant}"));
            let help = comma.as_deref().unwrap_or(HELP);
            self.wanted(value, "6 numbers or 3 rows of 3", help);
            return None;
        }
        self.array(value, HELP, Self::number).map(Inertia::of)
    }

    fn symmetric(&mut self, value: &Value, rows: [[Rational; 3]; 3]) -> Option<Inertia<Rational>> {
        for (i, k) in [(0, 1), (0, 2), (1, 2)] {
            if rows[i][k] != rows[k][i] {
                let message = format!(
                    "the tensor is not symmetric: row {}, column {} is not row {}, column {}",
                    i + 1,
                    k + 1,
                    k + 1,
                    i + 1
                );
                let span = first_line(self.source, Self::span(value));
                self.sink
                    .error(span, message, "write the same number in both");
                return None;
            }
        }
        let [[xx, xy, xz], [_, yy, yz], [_, _, zz]] = rows;
        Some(Inertia::of([xx, yy, zz, xy, yz, xz]))
    }
}

/// Returns the part of a span on its first line: what a message points at.
pub(super) fn first_line(source: &str, span: Range<usize>) -> Range<usize> {
    let line = source.get(span.clone()).and_then(|s| s.lines().next());
    span.start..span.start + line.map_or(1, |line| line.trim_end().len().max(1))
}
