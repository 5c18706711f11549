//! Values of the file: numbers, angles, words, vectors, tensors, placements.
//!
//! Every reader returns `None` after it reported an error, and its caller goes on with the file.

use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use core::ops::Range;

use num_traits::Zero;
use toml_span::value::ValueInner;
use toml_span::{Span, Value};

use super::report::{Sink, quote};
use super::table::Table;
use super::{Diagnostic, RobotWarning, Severity, foreign};
use crate::diagnostic::closest;
use crate::number::parse::{parse_decimal, parse_fraction};
use crate::number::{Angle, Rational, SnappedAngle};
use crate::outputs::Function;
use crate::placed::Body;
use crate::robot::{BodyRange, Inertia, JointKind, Placement, Position, values};

pub(super) struct Context {
    pub(super) sink: Sink,
    /// Places of values that are missing or unreadable: nothing is reported of their stand-ins.
    pub(super) unread: Vec<String>,
}

/// The parser leaves the quotes of a string out, and for an empty one points at the quote alone.
pub(super) fn bytes_of(span: Span) -> Range<usize> {
    span.start..span.end.max(span.start)
}

pub(super) fn first_line(source: &str, span: Range<usize>) -> Range<usize> {
    let line = source.get(span.clone()).and_then(|s| s.lines().next());
    span.start..span.start + line.map_or(1, |line| line.trim_end().len().max(1))
}

pub(super) fn placement(
    cx: &mut Context,
    keys: &mut Table,
    key: &'static str,
) -> Option<Placement> {
    let help = format!("{key} = {{ xyz = [0, 0, 0.1], rpy = [0, \"pi/2\", 0] }}");
    keys.table(cx, key, &help, Context::placement)
}

/// Reads the body of a link or a base: one without mass has no centre, and no inertia unless the
/// file says so. Zeros stand in for values that cannot be read, which are reported.
pub(super) fn body(cx: &mut Context, keys: &mut Table, of: &str, mass: &str, frame: &str) -> Body {
    let others = format!("only a {of} with mass = 0 may leave it out");
    let mass_help = format!("mass = {mass}, in kg; a {of} without mass has mass = 0");
    let com_help = format!("com = [x, y, z]: the centre of mass in the {frame}, in m; {others}");
    let inertia_help = format!(
        "inertia = [Ixx, Iyy, Izz, Ixy, Iyz, Ixz] about the centre of mass, in kg·m²; {others}"
    );
    let mass = keys.required(cx, "mass", &mass_help, Context::number);
    let is_massless = mass.as_ref().is_some_and(Zero::is_zero);
    let com = match keys.get("com") {
        None if is_massless => None,
        _ => keys.required(cx, "com", &com_help, |cx, value| {
            cx.array(value, &com_help, Context::number)
        }),
    };
    let inertia = match keys.get("inertia") {
        None if is_massless => None,
        _ => keys.required(cx, "inertia", &inertia_help, Context::inertia),
    };
    Body {
        mass: mass.unwrap_or_default(),
        com: com.unwrap_or_default(),
        inertia: inertia.unwrap_or_default(),
    }
}

pub(super) fn bodies(cx: &mut Context, keys: &mut Table, key: &'static str) -> Option<BodyRange> {
    let help = format!("{key} = {{ mass = [0, 2], radius = 0.1 }}: kg, and m around its frame");
    keys.table(cx, key, &help, |cx, keys| {
        let mass = keys.required(cx, "mass", &help, |cx, value| {
            cx.array(value, &help, Context::number)
        });
        let radius = keys.required(cx, "radius", &help, Context::number);
        let (mass, radius) = (mass?, radius?);
        Some(BodyRange { mass, radius })
    })
}

impl Context {
    pub(super) fn is_unread(&self, place: &str) -> bool {
        let is_of = |unread: &String| match place.strip_prefix(unread.as_str()) {
            Some(rest) => rest.is_empty() || rest.starts_with('/'),
            None => false,
        };
        self.unread.iter().any(is_of)
    }

    fn literal(&self, value: &Value) -> String {
        let literal = self.sink.source.get(bytes_of(value.span));
        literal.unwrap_or_default().to_string()
    }

    pub(super) fn refuse<T>(
        &mut self,
        value: &Value,
        message: impl Into<String>,
        help: &str,
    ) -> Option<T> {
        let span = first_line(&self.sink.source, bytes_of(value.span));
        self.sink.error(span, message.into(), help);
        None
    }

    pub(super) fn wanted<T>(&mut self, value: &Value, expected: &str, help: &str) -> Option<T> {
        let found = match value.as_ref() {
            ValueInner::String(text) => format!("the string {}", quote(text)),
            ValueInner::Integer(_) | ValueInner::Float(_) => {
                format!("the number {}", quote(&self.literal(value)))
            }
            ValueInner::Boolean(flag) => format!("`{flag}`"),
            ValueInner::Array(items) => format!("an array of {}", items.len()),
            ValueInner::Table(_) => "a table".to_string(),
        };
        self.refuse(value, format!("expected {expected}, found {found}"), help)
    }

    pub(super) fn number(&mut self, value: &Value) -> Option<Rational> {
        let help = "write the number alone, in SI units, or a fraction such as \"1/3\"";
        self.number_or(value, help)
    }

    pub(super) fn length(&mut self, value: &Value) -> Option<Rational> {
        let help = "write metres as a number alone, or a fraction such as \"1/3\"";
        self.number_or(value, help)
    }

    pub(super) fn rate(&mut self, value: &Value, turns: bool, unit: &str) -> Option<Rational> {
        let text = value.as_str().unwrap_or_default();
        let a_second = text.trim().trim_end_matches("/s²").trim_end_matches("/s");
        match Angle::parse(a_second) {
            Ok(angle) if turns && parse_decimal(a_second).is_err() => {
                let radians = angle.to_f64();
                let help = format!("in {unit}, as a number: write {radians:.4}");
                self.wanted(value, "a number", &help)
            }
            _ => self.number(value),
        }
    }

    pub(super) fn part(&mut self, value: &Value) -> Option<Rational> {
        let help = "write the part as a number, 0.01 for 1%, or a fraction such as \"1/100\"";
        self.number_or(value, help)
    }

    fn number_or(&mut self, value: &Value, help: &str) -> Option<Rational> {
        let parsed = match value.as_ref() {
            ValueInner::Integer(_) | ValueInner::Float(_) => parse_decimal(&self.literal(value)),
            ValueInner::String(text) if text.contains('/') && !text.contains("pi") => {
                parse_fraction(text)
            }
            _ => {
                let text = value.as_str().unwrap_or_default();
                let foreign = foreign::in_text(text);
                let help = match foreign.as_deref() {
                    _ if parse_decimal(text.trim()).is_ok() => "write it without quotes",
                    _ if Angle::parse(text).is_ok() => {
                        "not an angle: write a number without a unit"
                    }
                    meant => meant.unwrap_or(help),
                };
                return self.wanted(value, "a number", help);
            }
        };
        match parsed {
            Ok(number) => Some(number),
            Err(error) => {
                let message = format!("{} is {error}", quote(&self.literal(value)));
                self.refuse(value, message, error.help())
            }
        }
    }

    pub(super) fn angle(&mut self, value: &Value) -> Option<Angle> {
        let snapped = self.snapped(value)?;
        // A point of the circle is meant as it is written.
        if let SnappedAngle::Near {
            angle: Angle::PiTimes(_) | Angle::Radians(_),
            multiple,
            distance,
        } = &snapped
        {
            let text = self.literal(value);
            let message = format!("{text} is {distance:.1e} from {multiple}; it stays as written");
            let help = format!("write {} if you mean it", values::angle(multiple));
            let near = RobotWarning::NearRightAngle;
            let warning = Diagnostic::robot_warning(near, message).with_help(help);
            self.sink.place(warning, bytes_of(value.span));
        }
        Some(snapped.angle())
    }

    fn snapped(&mut self, value: &Value) -> Option<SnappedAngle> {
        let snapped = match value.as_ref() {
            ValueInner::Integer(_) | ValueInner::Float(_) => {
                SnappedAngle::of_radians(self.number(value)?)
            }
            ValueInner::String(text) if Angle::parse(text).is_ok() => {
                SnappedAngle::near(Angle::parse(text).unwrap_or_default())
            }
            _ => {
                let text = value.as_str().unwrap_or_default().trim();
                let help = match (parse_decimal(text), foreign::in_text(text)) {
                    (Ok(_), _) => {
                        format!("of radians write {text} without quotes, of degrees \"{text}deg\"")
                    }
                    (Err(_), Some(meant)) => meant,
                    _ => "write radians as a number, \"pi/2\", \"-3*pi/4\" or \"90deg\"".into(),
                };
                return self.wanted(value, "an angle", &help);
            }
        };
        if let SnappedAngle::Taken(angle) = &snapped {
            let message = format!("{} is read as {angle}", self.literal(value));
            let help = format!("write {} to say so", values::angle(angle));
            let note = Diagnostic::new(Severity::Note, message).with_help(help);
            self.sink.place(note, bytes_of(value.span));
        }
        Some(snapped)
    }

    pub(super) fn position(&mut self, value: &Value, kind: Option<JointKind>) -> Option<Position> {
        match kind {
            Some(JointKind::Prismatic) => self.length(value).map(Position::Length),
            _ => self.angle(value).map(Position::Angle),
        }
    }

    /// Near a right angle they are no slips: no equation has them.
    pub(super) fn range(
        &mut self,
        value: &Value,
        kind: Option<JointKind>,
        help: &str,
    ) -> Option<[Position; 2]> {
        self.array(value, help, |cx, end| match kind {
            Some(JointKind::Prismatic) => cx.length(end).map(Position::Length),
            _ => Some(Position::Angle(cx.snapped(end)?.angle())),
        })
    }

    pub(super) fn placement(&mut self, table: &mut Table) -> Option<Placement> {
        const XYZ: &str = "xyz = [x, y, z], in m";
        const RPY: &str = "rpy = [roll, pitch, yaw], turns about the fixed axes x, y and z, e.g. [0, \"pi/2\", 0]";
        let xyz = match table.get("xyz") {
            None => Some(Placement::default().xyz),
            Some(value) => self.array(value, XYZ, Self::length),
        };
        let rpy = match table.get("rpy") {
            None => Some(Placement::default().rpy),
            Some(value) => self.array(value, RPY, Self::angle),
        };
        let (xyz, rpy) = (xyz?, rpy?);
        Some(Placement { xyz, rpy })
    }

    pub(super) fn string(&mut self, value: &Value) -> Option<String> {
        match value.as_str() {
            Some(text) => Some(text.to_string()),
            None => self.wanted(value, "a string", "write it in quotes"),
        }
    }

    pub(super) fn word<T: Copy>(
        &mut self,
        value: &Value,
        words: &[(&str, T)],
        help: &str,
    ) -> Option<T> {
        let text = value.as_str();
        if let Some((_, meaning)) = words.iter().find(|(word, _)| Some(*word) == text) {
            return Some(*meaning);
        }
        let names: Vec<&str> = words.iter().map(|(name, _)| *name).collect();
        let help = match text.map(|text| closest(text, &names)) {
            Some(Some(meant)) => format!("did you mean \"{meant}\"?"),
            Some(None) if text == Some("fixed") => {
                "a joint that does not move is part of the link before it".to_string()
            }
            _ => help.to_string(),
        };
        self.wanted(value, &format!("\"{}\"", names.join("\" or \"")), &help)
    }

    pub(super) fn outputs(&mut self, value: &Value, whose: &str) -> Option<Vec<Function>> {
        let items = self.list(value, "a list", "outputs = [\"inverse_dynamics\"]")?;
        if items.is_empty() {
            let message = format!("{whose} needs at least one output");
            return self.refuse(value, message, "leave `outputs` out for the request's");
        }
        let words = Function::ALL.map(|function| (function.name(), function));
        let mut outputs: Vec<Function> = Vec::new();
        self.each(items, |cx, _, item| {
            let is_bundle = |text: &&str| text.contains(['=', '+', '@', ':']);
            let text = item.as_str().filter(is_bundle);
            let output = match text.map(|text| Function::parse_among(text, &outputs)) {
                None => cx.word(item, &words, "")?,
                Some(Ok(bundle)) => bundle,
                Some(Err(error)) => {
                    let help = error.help.unwrap_or_default();
                    return cx.refuse(item, error.message, &help);
                }
            };
            if outputs.iter().any(|other| output.is_namesake(*other)) {
                let message = format!("`{}` is in the list already", output.name());
                return cx.refuse(item, message, "once is enough");
            }
            outputs.push(output);
            Some(())
        })?;
        Some(outputs)
    }

    pub(super) fn list<'v>(
        &mut self,
        value: &'v Value<'v>,
        expected: &str,
        help: &str,
    ) -> Option<&'v [Value<'v>]> {
        match value.as_array() {
            Some(items) => Some(items),
            None => self.wanted(value, expected, help),
        }
    }

    /// Reads all of them before it gives up.
    pub(super) fn each<'v, T>(
        &mut self,
        items: &'v [Value<'v>],
        mut read: impl FnMut(&mut Self, usize, &'v Value<'v>) -> Option<T>,
    ) -> Option<Vec<T>> {
        let items = items.iter().enumerate();
        let read: Vec<Option<T>> = items.map(|(i, item)| read(self, i, item)).collect();
        read.into_iter().collect()
    }

    pub(super) fn array<T, const N: usize>(
        &mut self,
        value: &Value,
        help: &str,
        mut item: impl FnMut(&mut Self, &Value) -> Option<T>,
    ) -> Option<[T; N]> {
        let items = self.items(value, N, &format!("an array of {N}"), help)?;
        let read = self.each(items, |cx, _, value| item(cx, value))?;
        read.try_into().ok()
    }

    fn items<'v>(
        &mut self,
        value: &'v Value<'v>,
        length: usize,
        expected: &str,
        help: &str,
    ) -> Option<&'v [Value<'v>]> {
        let items = self.list(value, expected, help)?;
        if items.len() == length {
            return Some(items);
        }
        let comma = foreign::decimal_comma_in(&self.literal(value));
        let decimals = comma.map(|meant| format!("decimals have a point: {meant}"));
        self.wanted(value, expected, decimals.as_deref().unwrap_or(help))
    }

    pub(super) fn inertia(&mut self, value: &Value) -> Option<Inertia<Rational>> {
        const HELP: &str =
            "write [Ixx, Iyy, Izz, Ixy, Iyz, Ixz] or three rows of three, about the centre of mass";
        let items = value.as_array().map(Vec::as_slice).unwrap_or_default();
        if items.len() != 3 || items.iter().all(|item| item.as_array().is_none()) {
            self.items(value, 6, "6 numbers or 3 rows of 3", HELP)?;
            return self.array(value, HELP, Self::number).map(Inertia::of);
        }
        let rows: [[Rational; 3]; 3] =
            self.array(value, HELP, |cx, row| cx.array(row, HELP, Self::number))?;
        for (i, k) in [(0, 1), (0, 2), (1, 2)] {
            if rows[i][k] != rows[k][i] {
                let (row, column) = (i + 1, k + 1);
                let message = format!(
                    "the tensor is not symmetric: row {row}, column {column} is not row {column}, column {row}"
                );
                return self.refuse(value, message, "write the same number in both");
            }
        }
        Some(Inertia::symmetric(|i, k| rows[i][k].clone()))
    }
}
