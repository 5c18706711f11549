//! Numbers of attributes, exact, with their digits and their place.

use std::ops::Range;

use dalembert_model::number::parse::parse_decimal;
use dalembert_model::number::{Angle, Rational};
use dalembert_model::robot::Placement;
use num_traits::Signed;
use roxmltree::Node;

use super::start_tag;
use crate::problems::Problems;

#[derive(Clone, Debug, Default)]
pub(crate) struct Value<T> {
    pub(crate) value: T,
    /// As it stands in the file.
    pub(crate) text: String,
    pub(crate) span: Range<usize>,
}

pub(crate) type Number = Value<Rational>;

/// Returns a limit that is one.
pub(crate) fn positive(limit: &Option<Number>) -> Option<&Number> {
    limit.as_ref().filter(|limit| limit.value.is_positive())
}

impl<T> Value<T> {
    pub(crate) fn new(value: T, text: impl Into<String>, span: &Range<usize>) -> Value<T> {
        let (text, span) = (text.into(), span.clone());
        Value { value, text, span }
    }

    pub(crate) fn map<U>(self, f: impl FnOnce(T) -> U) -> Value<U> {
        Value::new(f(self.value), self.text, &self.span)
    }
}

/// Where a frame is in another, `rpy` about fixed axes.
#[derive(Clone, Debug, Default)]
pub(crate) struct Origin {
    pub(crate) xyz: [Number; 3],
    pub(crate) rpy: [Value<Angle>; 3],
    /// What digits that are no angles, as a quaternion's, were meant to place.
    pub(crate) meant: Option<Placement>,
}

impl Origin {
    pub(crate) fn placement(&self) -> Placement {
        Placement {
            xyz: self.xyz.each_ref().map(|x| x.value.clone()),
            rpy: self.rpy.each_ref().map(|x| x.value.clone()),
        }
    }
}

impl Problems<'_> {
    pub(crate) fn origin(&mut self, node: Node) -> Option<Origin> {
        let origin = super::child(node, "origin");
        let at = origin.unwrap_or(node);
        let [xyz, rpy] = ["xyz", "rpy"].map(|key| match origin {
            Some(origin) if origin.has_attribute(key) => self.triple(origin, key),
            _ => Some(constant(at, ["0", "0", "0"])),
        });
        let radians = |number: Number| number.map(|value| Angle::Radians(value).canonical());
        Some(Origin {
            xyz: xyz?,
            rpy: rpy?.map(radians),
            meant: None,
        })
    }

    pub(crate) fn triple(&mut self, node: Node, key: &str) -> Option<[Number; 3]> {
        let (text, span) = self.attribute(node, key)?;
        self.list(key, text, span)
    }

    pub(crate) fn list<const N: usize>(
        &mut self,
        key: &str,
        text: &str,
        span: Range<usize>,
    ) -> Option<[Number; N]> {
        let mut words = Vec::new();
        let mut at = 0;
        for word in text.split_ascii_whitespace() {
            // Where entities were written out, places are only the attribute's.
            let start = text[at..].find(word).map_or(at, |start| at + start);
            at = start + word.len();
            let word_span = span.start + start..span.start + at;
            let inside = self.source.get(word_span.clone()) == Some(word);
            words.push((word, if inside { word_span } else { span.clone() }));
        }
        if words.len() != N {
            let message = format!("`{key}` has {} numbers, not {N}", words.len());
            let names = &["x", "y", "z", "u", "v", "w"][..N.min(6)];
            let help = format!("{key}=\"{}\", with spaces between", names.join(" "));
            return self.refuse(&span, message, &help);
        }
        // All of them are read, so that each mistake is named.
        let words = words.into_iter();
        let numbers: Vec<_> = words.map(|(word, span)| self.parse(word, span)).collect();
        let numbers: Option<Vec<Number>> = numbers.into_iter().collect();
        numbers?.try_into().ok()
    }

    pub(crate) fn number(&mut self, node: Node, key: &str) -> Option<Number> {
        node.attribute(key)?;
        self.required(node, key)
    }

    pub(crate) fn required(&mut self, node: Node, key: &str) -> Option<Number> {
        let (text, span) = self.attribute(node, key)?;
        self.parse(text.trim(), span)
    }

    pub(crate) fn attribute<'a>(
        &mut self,
        node: Node<'a, '_>,
        key: &str,
    ) -> Option<(&'a str, Range<usize>)> {
        let attribute = node.attribute_node(key);
        if attribute.is_none() {
            let name = node.tag_name().name();
            let message = format!("<{name}> has no `{key}`");
            let span = start_tag(node);
            self.error(&span, message, &format!("<{name} {key}=\"…\">"));
        }
        attribute.map(|attribute| (attribute.value(), attribute.range_value()))
    }

    pub(crate) fn parse(&mut self, text: &str, span: Range<usize>) -> Option<Number> {
        match parse_decimal(&spelled_out(text)) {
            Ok(value) => Some(Value::new(value, text, &span)),
            Err(error) => self.refuse(&span, format!("`{text}` is {error}"), error.help()),
        }
    }
}

pub(crate) fn constant<const N: usize>(node: Node, texts: [&str; N]) -> [Number; N] {
    let span = start_tag(node);
    texts.map(|text| Value::new(parse_decimal(text).unwrap_or_default(), text, &span))
}

/// Returns `.5` and `5.` as 0.5 and 5, which other readers take too.
fn spelled_out(text: &str) -> String {
    let (mantissa, exponent) = match text.find(['e', 'E']) {
        Some(at) => text.split_at(at),
        None => (text, ""),
    };
    let mantissa = mantissa.strip_suffix('.').unwrap_or(mantissa);
    let (sign, digits) = match mantissa.strip_prefix(['-', '+']) {
        Some(digits) => (&mantissa[..1], digits),
        None => ("", mantissa),
    };
    let zero = if digits.starts_with('.') { "0" } else { "" };
    format!("{sign}{zero}{digits}{exponent}")
}
