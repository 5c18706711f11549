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
const MAX_NAMESPACES: usize = 64;
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
        self.attributes
            .iter()
            .find(|attribute| attribute.key == key)
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
        let inside = self.inside.iter().flat_map(|inside| {
            let own = (inside.tag == tag).then_some(inside);
            own.into_iter().chain(inside.all_inside(tag))
        });
        inside.collect()
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
    let before = source.lines().take(at.row.saturating_sub(1) as usize);
    let line: usize = before.map(|line| line.len() + 1).sum();
    let at = start + line + at.col.saturating_sub(1) as usize;
    let help = match source.trim_start().starts_with('<') {
        true => "",
        false => "a URDF is XML: <robot name=\"arm\"> …; so is MJCF: <mujoco> …",
    };
    problems.refuse("not_xml", &(at..at + 1), &[&error, &help])
}

/// Returns the text with `.` for the colons in names, and without XML declarations: a late one is
/// an error for the parser, and none for other readers. Its bytes stay where they are.
fn admitted(source: &str, start: usize, above: usize, problems: &mut Problems) -> Option<String> {
    if source.len() > MAX_BYTES {
        return problems.refuse("too_long", &(0..0), &[&MAX_MIB]);
    }
    let mut readable = source.as_bytes().to_vec();
    let (mut namespaces, mut depth) = (0, above);
    for (is_tag, span) in pieces(source) {
        let text = &source[span.clone()];
        if text.starts_with("<?xml ") {
            readable[span].fill(b' ');
            continue;
        }
        let expression = EXPRESSIONS.iter().filter_map(|begin| text.find(begin));
        let is_xacro = is_tag && text.starts_with("<xacro:");
        if let Some(at) = expression.min().or(is_xacro.then_some(0)) {
            let word = text[at..].split([' ', '"', '\'', '>', '\n', '\t', '\r', '/']);
            let word: String = word.take(1).flat_map(str::chars).take(40).collect();
            let at = start + span.start + at;
            return problems.refuse("not_expanded", &(at..at + word.len()), &[&word]);
        }
        if !is_tag {
            continue;
        }
        namespaces += text.matches("xmlns=").count();
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
            _ if namespaces > MAX_NAMESPACES => {
                format!("the file has more than {MAX_NAMESPACES} namespaces")
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

/// Returns tags and XML declarations (`true`) and the text between them. Comments, instructions
/// and CDATA are left out, and so is all that follows a mistake.
fn pieces(source: &str) -> impl Iterator<Item = (bool, Range<usize>)> {
    let mut at = 0;
    std::iter::from_fn(move || {
        loop {
            let rest = &source[at..];
            let start = at;
            if !rest.starts_with('<') {
                at += rest.find('<').unwrap_or(rest.len());
                return (start < at).then_some((false, start..at));
            }
            let skipped = [("<!--", "-->"), ("<![CDATA[", "]]>"), ("<?", "?>")];
            let skipped = skipped.iter().find(|(begin, _)| rest.starts_with(begin));
            if let Some((begin, end)) = skipped {
                let inside = &rest[begin.len()..];
                at += begin.len() + inside.find(end)? + end.len();
                if rest.starts_with("<?xml ") {
                    return Some((true, start..at));
                }
                continue;
            }
            at += outside_of_quotes(rest).find(|(_, byte)| *byte == b'>')?.0 + 1;
            return Some((true, start..at));
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
        let found = source.get(from..from + name.len());
        found.unwrap_or(name).to_owned()
    };
    let line = source[range.clone()].lines().next().unwrap_or_default();
    let end = line.find('>').map_or(line.len(), |end| end + 1);
    let attributes = node.attributes().map(|attribute| Attribute {
        key: name(attribute.range().start, attribute.name()),
        value: attribute.value().to_owned(),
        at: shift(attribute.range_value()),
    });
    let text = node.children().find(Node::is_text).and_then(|inside| {
        let value = inside.text()?.trim();
        let at = shift(inside.range());
        (!value.is_empty()).then(|| Attribute {
            key: String::new(),
            value: value.to_owned(),
            at,
        })
    });
    let inside = node.children().filter(Node::is_element);
    Element {
        tag: name(range.start + 1, node.tag_name().name()),
        at: shift(range.start..range.start + end),
        attributes: attributes.collect(),
        inside: inside
            .map(|inside| element(inside, source, start))
            .collect(),
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
