//! A generated file as a whole: its modules and their items.
//!
//! Nothing is skipped but the stamp, lines of documentation and attributes of a list. Every other
//! line is without quotes and comments, so that braces can be counted; and every item is read as a
//! function or compared line by line with the one that it has to be. No module stands there twice,
//! and, as `certify` sees, no item twice in one. So the function of a name and module is the one that is found here.

use std::collections::HashSet;

use crate::fault::Fault;
use crate::read::{self, Symbols, has_only, is_letter};

const MOST_LETTERS: usize = 1 << 7;
/// The most lines before a function's head that are looked past: directives and attributes.
const MOST_AHEAD: usize = 8;
/// The longest file.
pub const MOST_BYTES: usize = 32 << 20;

/// An item of a file: a function, or what stands beside functions.
#[derive(Clone, Debug, Default)]
pub struct Item<'t> {
    /// The module that it is in; empty where the file is the module.
    pub module: &'t str,
    /// Its names in a header.
    pub symbols: Symbols,
    /// Its name; empty of what is no function.
    pub name: &'t str,
    /// The line of its head, from one.
    pub line: usize,
    /// Its text, from `pub fn`, in C from its struct, to its last brace.
    pub text: String,
}

/// Attributes, and how those begin that list names.
const ATTRIBUTES: [&str; 9] = [
    "#[derive(Clone, Copy, Debug)]",
    "#[derive(Clone, Copy, Debug, PartialEq)]",
    "#[repr(transparent)]",
    "#[must_use]",
    "#[inline]",
    "#[inline(always)]",
    "#[inline(never)]",
    "#[rustfmt::skip]",
    "#![cfg_attr(rustfmt, rustfmt_skip)]",
];
const LISTS: [&str; 2] = ["#[allow(", "#![allow("];

pub(crate) type Lines<'l, 't> = &'l [(usize, &'t str)];

/// Reads up to where all is closed that the last item opens.
pub(crate) fn item<'t>(
    lines: &mut Lines<'_, 't>,
    mut is_last: impl FnMut(&'t str) -> bool,
) -> Option<Item<'t>> {
    let (mut item, mut depth, mut ends) = (Item::default(), 0usize, 0);
    let (first, mut head) = *lines.first()?;
    item.line = first;
    loop {
        let (&(number, line), behind) = lines.split_first()?;
        let count = |brackets: [char; 3]| line.matches(brackets).count();
        // As many lines as in the file.
        item.text += &"\n".repeat(number - item.line - ends);
        item.text += &format!("{line}\n");
        ends = number - item.line + 1;
        *lines = behind;
        depth = (depth + count(['{', '[', '('])).checked_sub(count(['}', ']', ')']))?;
        if depth == 0 && line.ends_with(['}', ';']) {
            if is_last(head) {
                return Some(item);
            }
            let mut behind = lines.iter().map(|pair| pair.1).take(MOST_AHEAD);
            head = behind.find(|line| !line.starts_with(['#', '_']))?;
        }
    }
}

/// Reads a file.
///
/// # Errors
/// The first line that the generator would not print.
pub fn functions(source: &str) -> Result<Vec<Item<'_>>, Fault> {
    let mut lines = read::lines(source, false)?;
    lines.retain(|line| !is_attribute(line.1));
    let (mut lines, mut items) = (lines.as_slice(), Vec::new());
    let (mut module, mut has_items, mut modules) = (None, false, HashSet::new());
    while let Some(&first) = lines.first() {
        let words = first.1;
        // At the top stand modules, or the items of a file that is one.
        let head = module_head(words).filter(|_| module.is_none() && !has_items);
        if head.is_some() || module.is_some() && words == "}" {
            (module, lines) = (head, &lines[1..]);
            if !head.is_none_or(|head| modules.insert(head)) {
                return Err(fault(first));
            }
            continue;
        }
        let is_item = words.starts_with("pub ") || words.starts_with("impl ");
        let is_item = is_item && (module.is_some() || modules.is_empty());
        let mut item = item(&mut lines, |_| true)
            .filter(|_| is_item)
            .ok_or_else(|| fault(first))?;
        has_items |= module.is_none();
        let name = words.strip_prefix("pub fn ");
        let name = name.filter(|name| name.starts_with(|c: char| c.is_ascii_lowercase()));
        let name = name.and_then(|name| name.split(|c: char| !is_letter(c)).next());
        item.name = name.unwrap_or("");
        item.module = module.unwrap_or("");
        items.push(item);
    }
    let end = source.lines().count();
    match module {
        None => Ok(items),
        Some(_) => Err(Fault::Text(end, "a brace is not closed".into())),
    }
}

pub(crate) fn fault((number, line): (usize, &str)) -> Fault {
    Fault::Text(number, format!("not generated code: `{line}`"))
}

pub(crate) fn between<'t>(text: &'t str, before: &str, behind: &str) -> Option<&'t str> {
    text.strip_prefix(before)?.strip_suffix(behind)
}

fn is_attribute(words: &str) -> bool {
    let mut lists = LISTS.iter().filter_map(|head| between(words, head, ")]"));
    ATTRIBUTES.contains(&words) || lists.any(|list| has_only(list, ":, "))
}

fn module_head(line: &str) -> Option<&str> {
    let name = between(line, "pub mod ", " {");
    name.filter(|name| has_only(name, "") && name.len() <= MOST_LETTERS)
}
