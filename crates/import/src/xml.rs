//! XML as elements that know their places, within limits that keep hostile files cheap.
//!
//! The parser compares every attribute of an element with those before it: the limits keep that
//! linear in the size of the file. Prefixes need no declaration: robots have `drake:` and
//! `sensor:` without one, which other readers accept.

use std::ops::Range;

use roxmltree::{Document, Error, Node};

use crate::problems::Problems;
use crate::text::{MAX_BYTES, MAX_MIB, Span, Text};

/// The most attributes of one element: a URDF has six, an actuator of MJCF thirty.
const MAX_ATTRIBUTES: usize = 64;
const MAX_DEPTH: usize = 256;
const EXPRESSIONS: [&str; 2] = ["${", "$("];

#[derive(Clone, Debug, Default)]
pub(crate) struct Element {
    /// With its prefix: `drake:joint`.
    pub(crate) tag: String,
    /// The first line of the start tag.
    pub(crate) at: Span,
    pub(crate) attributes: Vec<Attribute>,
    pub(crate) inside: Vec<Element>,
    /// The text inside, without spaces around it.
    pub(crate) text: Option<Attribute>,
}

#[derive(Clone, Debug)]
pub(crate) struct Attribute {
    /// With its prefix: `drake:acceleration`.
    pub(crate) key: String,
    pub(crate) value: String,
    pub(crate) at: Span,
}

impl Element {
    pub(crate) fn all<'e>(&'e self, tag: &'e str) -> impl Iterator<Item = &'e Element> {
        self.inside.iter().filter(move |inside| inside.tag == tag)
    }

    pub(crate) fn first(&self, tag: &str) -> Option<&Element> {
        self.inside.iter().find(|inside| inside.tag == tag)
    }

    pub(crate) fn get(&self, key: &str) -> Option<&Attribute> {
        #[cfg(test)]
        tests::ASKED.with_borrow_mut(|asked| asked.insert([self.tag.clone(), key.to_owned()]));
        let mut attributes = self.attributes.iter();
        attributes.find(|attribute| attribute.key == key)
    }

    pub(crate) fn value(&self, key: &str) -> Option<&str> {
        self.get(key).map(|attribute| attribute.value.as_str())
    }

    /// Returns a word for the element, with its name if it has one.
    pub(crate) fn named(&self, word: &str) -> String {
        match self.value("name") {
            Some(name) => format!("{word} `{name}`"),
            None => word.to_owned(),
        }
    }

    /// Returns the `value`, or the text inside.
    pub(crate) fn content(&self) -> Option<&Attribute> {
        let mut attributes = self.attributes.iter();
        let value = attributes.find(|attribute| attribute.key == "value");
        value.or(self.text.as_ref())
    }

    /// Returns all elements of a tag inside, in the order of the file.
    pub(crate) fn all_inside(&self, tag: &str) -> Vec<&Element> {
        let mut elements = Vec::new();
        let mut open: Vec<&Element> = self.inside.iter().rev().collect();
        while let Some(element) = open.pop() {
            elements.extend((element.tag == tag).then_some(element));
            open.extend(element.inside.iter().rev());
        }
        elements
    }
}

/// Parses one file of a text, whose root lies `depth` elements deep.
pub(crate) fn parse(
    text: &Text,
    file: usize,
    depth: usize,
    problems: &mut Problems,
) -> Option<Element> {
    let (_, source, start) = text.file(file);
    let readable = admitted(source, start, depth, problems)?;
    // Nodes: more than any robot has, fewer than fill a memory.
    let options = roxmltree::ParsingOptions {
        allow_dtd: false,
        nodes_limit: 1 << 20,
        ..Default::default()
    };
    let error = match Document::parse_with_options(&readable, options) {
        Ok(document) => return Some(element(document.root_element(), source, start)),
        Err(error) => error,
    };
    if let Error::UnexpectedEndOfStream | Error::UnclosedRootNode = error {
        let end = start + source.trim_end().len();
        return problems.refuse("cut_off", &(end.saturating_sub(1)..end), &[]);
    }
    let at = error.pos();
    let mut lines = source.split_inclusive('\n');
    let before = lines.by_ref().take(at.row.saturating_sub(1) as usize);
    let line: usize = before.map(str::len).sum();
    let mut bytes = lines.next().unwrap_or_default().char_indices();
    let column = bytes.nth(at.col.saturating_sub(1) as usize);
    let at = start + line + column.map_or(0, |(byte, _)| byte);
    let help = match source.trim_start().starts_with('<') {
        true => "",
        false => "a URDF is XML: <robot name=\"arm\"> …; so is MJCF: <mujoco> …",
    };
    problems.refuse("not_xml", &(at..at + 1), &[&error, &help])
}

/// Returns the text with `.` for the colons in names, and without comments, instructions and
/// document types, in which other readers accept more than the parser: `--`, or a late XML
/// declaration. Its bytes stay where they are.
fn admitted(source: &str, start: usize, above: usize, problems: &mut Problems) -> Option<String> {
    if source.len() > MAX_BYTES {
        return problems.refuse("too_long", &(0..0), &[&MAX_MIB]);
    }
    let mut readable = source.as_bytes().to_vec();
    let mut depth = above;
    for (piece, span) in pieces(source) {
        let text = &source[span.clone()];
        if piece == Piece::Skipped {
            let bytes = readable[span].iter_mut().filter(|byte| **byte != b'\n');
            bytes.for_each(|byte| *byte = b' ');
            continue;
        }
        let expression = EXPRESSIONS.iter().filter_map(|begin| text.find(begin));
        let is_xacro = piece == Piece::Tag && text.starts_with("<xacro:");
        if let Some(at) = expression.min().or(is_xacro.then_some(0)) {
            let mut words = text[at..].split([' ', '"', '\'', '>', '\n', '\t', '\r', '/']);
            let word: String = words.next().unwrap_or_default().chars().take(40).collect();
            let at = start + span.start + at;
            return problems.refuse("not_expanded", &(at..at + word.len()), &[&word]);
        }
        if piece == Piece::Text {
            continue;
        }
        depth = match (text.starts_with("</"), text.ends_with("/>")) {
            (true, _) => depth.saturating_sub(1),
            (false, true) => depth,
            (false, false) => depth + 1,
        };
        let mut attributes = 0;
        for (at, byte) in outside_of_quotes(text) {
            attributes += usize::from(byte == b'=');
            if byte == b':' {
                readable[span.start + at] = b'.';
            }
        }
        let message = match attributes {
            count if count > MAX_ATTRIBUTES => {
                format!("an element with {count} attributes, more than {MAX_ATTRIBUTES}")
            }
            _ if depth > MAX_DEPTH => {
                format!("more than {MAX_DEPTH} elements are inside each other")
            }
            _ => continue,
        };
        let line = text.lines().next().map_or(1, str::len);
        let at = start + span.start;
        return problems.refuse("too_complex", &(at..at + line), &[&message]);
    }
    String::from_utf8(readable).ok()
}

#[derive(Clone, Copy, PartialEq)]
enum Piece {
    Tag,
    Text,
    /// A comment, an instruction or a document type without declarations of its own.
    Skipped,
}

/// Returns the pieces of a file, without CDATA and all that follows a mistake.
fn pieces(source: &str) -> impl Iterator<Item = (Piece, Range<usize>)> {
    const SKIPPED: [(&str, &str); 4] = [
        ("<!--", "-->"),
        ("<![CDATA[", "]]>"),
        ("<?", "?>"),
        ("<!DOCTYPE", ">"),
    ];
    let mut at = 0;
    std::iter::from_fn(move || {
        loop {
            let rest = &source[at..];
            let start = at;
            if !rest.starts_with('<') {
                at += rest.find('<').unwrap_or(rest.len());
                return (start < at).then_some((Piece::Text, start..at));
            }
            let Some((begin, end)) = SKIPPED.iter().find(|(begin, _)| rest.starts_with(begin))
            else {
                at += outside_of_quotes(rest).find(|(_, byte)| *byte == b'>')?.0 + 1;
                return Some((Piece::Tag, start..at));
            };
            let inside = &rest[begin.len()..];
            let length = inside.find(end)?;
            at += begin.len() + length + end.len();
            // Entities are refused by the parser.
            let has_entities = begin.ends_with('E') && inside[..length].contains('[');
            if *begin != "<![CDATA[" && !has_entities {
                return Some((Piece::Skipped, start..at));
            }
        }
    })
}

fn outside_of_quotes(tag: &str) -> impl Iterator<Item = (usize, u8)> {
    let mut quote = None;
    tag.bytes().enumerate().filter(move |(_, byte)| {
        match quote {
            Some(open) if open == *byte => quote = None,
            None if matches!(byte, b'"' | b'\'') => quote = Some(*byte),
            _ => return quote.is_none(),
        }
        false
    })
}

fn element(node: Node, source: &str, start: usize) -> Element {
    let range = node.range();
    let shift = |range: Range<usize>| start + range.start..start + range.end;
    // The parser saw names with `.` for `:`.
    let name = |from: usize, name: &str| {
        let source_name = source.get(from..from + name.len());
        source_name.unwrap_or(name).to_owned()
    };
    let line = source[range.clone()].lines().next().unwrap_or_default();
    let end = line.find('>').map_or(line.len(), |end| end + 1);
    let attributes = node.attributes().map(|attribute| Attribute {
        key: name(attribute.range().start, attribute.name()),
        value: attribute.value().to_owned(),
        at: shift(attribute.range_value()),
    });
    let texts = node.children().filter(Node::is_text);
    let value: String = texts.clone().filter_map(|text| text.text()).collect();
    let place = texts.clone().next().map_or(0..0, |text| text.range());
    let text = (!value.trim().is_empty()).then(|| Attribute {
        key: String::new(),
        value: value.trim().to_owned(),
        at: shift(place),
    });
    let elements = node.children().filter(Node::is_element);
    let inside = elements.map(|inside| element(inside, source, start));
    Element {
        tag: name(range.start + 1, node.tag_name().name()),
        at: shift(range.start..range.start + end),
        attributes: attributes.collect(),
        inside: inside.collect(),
        text,
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use std::cell::RefCell;
    use std::collections::BTreeSet;

    thread_local! {
        /// The elements and attributes that readers looked for.
        pub(crate) static ASKED: RefCell<BTreeSet<[String; 2]>> = RefCell::default();
    }
}
