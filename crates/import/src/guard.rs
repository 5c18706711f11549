//! The XML: limits of the text, and whether it is a xacro, before the parser sees it.
//!
//! The parser compares every attribute of an element with those before it, and every
//! namespace with those of the elements around: the limits keep both linear in the
//! size of the file.

use std::ops::Range;

use roxmltree::{Document, Error};

use crate::problems::Problems;
use crate::{MAX_BYTES, MAX_MIB};

/// The most attributes of one element: a URDF has six, an actuator of MJCF thirty.
pub(crate) const MAX_ATTRIBUTES: usize = 64;
const MAX_NAMESPACES: usize = 64;
const EXPRESSIONS: [&str; 2] = ["${", "$("];

const MAX_DEPTH: usize = 256;

pub(crate) fn parse<'s>(source: &'s str, problems: &mut Problems) -> Option<Document<'s>> {
    if !admits(source, problems) {
        return None;
    }
    // Nodes: more than any robot has, fewer than fill a memory.
    let options = roxmltree::ParsingOptions {
        allow_dtd: false,
        nodes_limit: 1 << 20,
        ..Default::default()
    };
    let error = match Document::parse_with_options(source, options) {
        Ok(document) => return Some(document),
        Err(error) => error,
    };
    if let Error::UnexpectedEndOfStream | Error::UnclosedRootNode = error {
        let end = source.trim_end().len();
        let message = "the file ends before its XML does";
        let help = "it was probably cut off: get the whole file; a URDF ends in </robot>, an MJCF in </mujoco>";
        return problems.refuse(&(end.saturating_sub(1)..end), message, help);
    }
    let at = error.pos();
    let before = source.lines().take(at.row.saturating_sub(1) as usize);
    let start: usize = before.map(|line| line.len() + 1).sum();
    let at = start + at.col.saturating_sub(1) as usize;
    let help = match source.trim_start().starts_with('<') {
        true => "",
        false => "a URDF is XML: <robot name=\"arm\"> …; so is MJCF: <mujoco> …",
    };
    problems.refuse(&(at..at + 1), format!("no XML: {error}"), help)
}

fn admits(source: &str, problems: &mut Problems) -> bool {
    if source.len() > MAX_BYTES {
        let message = format!("the file is too long: a model of a robot has at most {MAX_MIB} MiB");
        problems.error(&(0..0), message, "is this the right file?");
        return false;
    }
    let (mut namespaces, mut depth) = (0, 0usize);
    for (is_tag, span) in pieces(source) {
        let text = &source[span.clone()];
        let expression = EXPRESSIONS.iter().filter_map(|begin| text.find(begin));
        let is_xacro = is_tag && text.starts_with("<xacro:");
        if let Some(at) = expression.min().or(is_xacro.then_some(0)) {
            let word = text[at..].split([' ', '"', '\'', '>', '\n', '\t', '\r', '/']);
            let word: String = word.take(1).flat_map(str::chars).take(40).collect();
            let start = span.start + at;
            let message = format!("`{word}` is not expanded");
            let help = "this is a xacro: run `xacro arm.urdf.xacro > arm.urdf` first";
            problems.error(&(start..start + word.len()), message, help);
            return false;
        }
        if !is_tag {
            continue;
        }
        namespaces += text.matches("xmlns").count();
        depth = match (text.starts_with("</"), text.ends_with("/>")) {
            (true, _) => depth.saturating_sub(1),
            (false, true) => depth,
            (false, false) => depth + 1,
        };
        let attributes = outside_of_quotes(text).filter(|(_, byte)| *byte == b'=');
        let problem = match attributes.count() {
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
        let span = span.start..span.start + text.lines().next().map_or(1, str::len);
        problems.error(&span, problem, "is this a model of a robot?");
        return false;
    }
    true
}

/// Comments, instructions and CDATA are left out, and so is all that follows a mistake.
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
