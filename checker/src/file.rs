//! A generated file as a whole: its modules and the functions that rustc would call.
//!
//! Nothing is skipped. Every line is a line of documentation, an attribute of a list, or
//! code without quotes, comments and macros, so that braces can be counted; items are of
//! the kinds that the generator prints, and none of their names can stand for a crate that
//! a function calls. So the function of a name and module is the one that is found here.

use crate::claim::whole;
use crate::fault::Fault;
use crate::read::{has_only, is_letter};

/// The longest file.
pub const MOST_BYTES: usize = 32 << 20;

/// A function of a file.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Found<'t> {
    /// The module that it is in; empty where the file is the module.
    pub module: &'t str,
    /// The beginnings of the macros of a header in C.
    pub header: &'t str,
    /// Its name; empty of what is no function.
    pub name: &'t str,
    /// The line of its head, from one.
    pub line: usize,
    /// Its text, from `pub fn` to its last brace.
    pub text: String,
}

/// Attributes, and how those begin that list names.
const ATTRIBUTES: [&str; 7] = [
    "#[repr(transparent)]",
    "#[must_use]",
    "#[inline]",
    "#[inline(always)]",
    "#[inline(never)]",
    "#[rustfmt::skip]",
    "#![cfg_attr(rustfmt, rustfmt_skip)]",
];
const LISTS: [&str; 3] = ["#[derive(", "#[allow(", "#![allow("];
/// Words that begin an item, and no other part of a line.
const ITEMS: [&str; 5] = ["const", "struct", "type", "fn", "impl"];
/// Words that could give another meaning to what is read.
const FORBIDDEN: [&str; 12] = [
    "mod", "use", "extern", "macro", "trait", "static", "unsafe", "union", "enum", "super",
    "crate", "return",
];

/// Lines of code that are still to be read, with their numbers.
pub(crate) type Lines<'l, 't> = &'l [(usize, &'t str)];

/// Reads items up to where all is closed that the last one opens, without a name so far; which
/// the last one is, its first line says.
pub(crate) fn item<'t>(
    lines: &mut Lines<'_, 't>,
    mut is_last: impl FnMut(&'t str) -> bool,
) -> Option<Found<'t>> {
    let (mut found, mut depth, mut ends) = (Found::default(), 0usize, 0);
    let (first, mut head) = *lines.first()?;
    found.line = first;
    loop {
        let (&(number, line), behind) = lines.split_first()?;
        let count = |brackets: [char; 3]| line.matches(brackets).count();
        // As many lines as in the file.
        found.text += &"\n".repeat(number - found.line - ends);
        found.text += &format!("{line}\n");
        ends = number - found.line + 1;
        *lines = behind;
        depth = (depth + count(['{', '[', '('])).checked_sub(count(['}', ']', ')']))?;
        if depth == 0 && line.ends_with(['}', ';']) {
            if is_last(head) {
                return Some(found);
            }
            let mut behind = lines.iter().map(|own| own.1);
            head = behind.find(|line| !line.starts_with(['#', '_']))?;
        }
    }
}

/// Reads a file.
///
/// # Errors
/// The first line that the generator would not print.
pub fn functions(source: &str) -> Result<Vec<Found<'_>>, Fault> {
    let lines = (1..).zip(source.split('\n'));
    let lines = without_types(lines.filter(|line| !is_plain(*line)).collect());
    let is_known =
        |line: &str| is_code(line.trim_start_matches(' ')) || module_head(line).is_some();
    if let Some(line) = lines.iter().find(|(_, line)| !is_known(line)) {
        return Err(fault(*line));
    }
    let (mut lines, mut all) = (lines.as_slice(), Vec::new());
    let (mut module, mut has_items) = (None, false);
    while let Some(&first) = lines.first() {
        let words = first.1.trim_start_matches(' ');
        // At the top stand modules, or the items of a file that is one.
        let head = module_head(first.1).filter(|_| module.is_none() && !has_items);
        if head.is_some() || module.is_some() && words == "}" {
            (module, lines) = (head, &lines[1..]);
            continue;
        }
        let found = item(&mut lines, |_| true).filter(|_| is_item(words));
        let mut found = found.ok_or_else(|| fault(first))?;
        has_items |= module.is_none();
        if let Some(name) = words.strip_prefix("pub fn ") {
            let end = name.find(|c: char| !is_letter(c)).unwrap_or(0);
            found.name = &name[..end];
        }
        found.module = module.unwrap_or("");
        all.push(found);
    }
    let end = source.lines().count();
    match module {
        None => Ok(all),
        Some(_) => Err(Fault::Text(end, "a brace is not closed".into())),
    }
}

/// The type of an argument that is no list of joints; and what a payload has besides.
const TYPE: &str = "pub struct NAME(pub [REAL; COUNT]);
impl ::core::ops::Deref for NAME {
type Target = [REAL; COUNT];
fn deref(&self) -> &[REAL; COUNT] {
&self.0
}
}";
const NEW: &str = "impl Payload {
pub const NONE: Payload = Payload([0.0; 10]);
pub const fn new(mass: REAL, com: [REAL; 3], inertia: [REAL; 6]) -> Payload {
let ([x, y, z], [xx, yy, zz, xy, yz, xz]) = (com, inertia);
Payload([mass, x, y, z, xx, yy, zz, xy, yz, xz])
}
}";

/// Returns the lines without the types of arguments, each of which has to be as it is printed.
fn without_types(lines: Vec<(usize, &str)>) -> Vec<(usize, &str)> {
    let (mut left, mut rest) = (Vec::new(), lines.as_slice());
    while let Some(&first) = rest.first() {
        let count = argument_type(rest);
        if count.is_none() {
            left.push(first);
        }
        rest = &rest[count.unwrap_or(1)..];
    }
    left
}

/// Returns how many lines the type of an argument has that stands there; none if there is none, or
/// another one than is printed.
fn argument_type(lines: Lines) -> Option<usize> {
    let head = lines.first()?.1.trim_start_matches(' ');
    let text = if head == "impl Payload {" {
        let is_single = lines.get(2)?.1.contains(": f32");
        NEW.replace("REAL", if is_single { "f32" } else { "f64" })
    } else {
        let (name, kind) = between(head, "pub struct ", "]);")?.split_once("(pub [")?;
        let (real, count) = kind.split_once("; ")?;
        let is_known = ["Gravity", "Load", "Payload"].contains(&name)
            && ["f32", "f64"].contains(&real)
            && whole(count).is_some();
        is_known.then_some(())?;
        let text = TYPE.replace("NAME", name).replace("REAL", real);
        text.replace("COUNT", count)
    };
    let mut own = lines.iter().map(|own| own.1.trim_start_matches(' '));
    let is_printed = text.lines().all(|line| own.next() == Some(line));
    is_printed.then(|| text.lines().count())
}

/// Returns a line that the generator would not print.
pub(crate) fn fault((number, line): (usize, &str)) -> Fault {
    Fault::Text(number, format!("nothing that is generated: `{line}`"))
}

/// Returns what is in a text between its beginning and its end.
pub(crate) fn between<'t>(text: &'t str, before: &str, behind: &str) -> Option<&'t str> {
    text.strip_prefix(before)?.strip_suffix(behind)
}

/// The lines of the stamp that a file begins with: how they begin.
const STAMP: [&str; 4] = [
    "// Generated by ",
    "// robot = ",
    "// asked = ",
    "// text = ",
];

/// Returns `true` for an empty line, an attribute or a comment: documentation, or a file's stamp.
fn is_plain((number, line): (usize, &str)) -> bool {
    let words = line.trim_start_matches(' ');
    let own = STAMP.get(number - 1);
    let is_stamp = own.is_some_and(|start| line.starts_with(start));
    let is_comment = is_stamp || words.starts_with("///") || words.starts_with("//!");
    words.is_empty() || is_comment && !words.contains('\r') || is_attribute(words)
}

fn is_attribute(words: &str) -> bool {
    let mut lists = LISTS.iter().filter_map(|head| between(words, head, ")]"));
    ATTRIBUTES.contains(&words) || lists.any(|list| has_only(list, ":, "))
}

/// Returns the name of a module that begins.
fn module_head(line: &str) -> Option<&str> {
    between(line, "pub mod ", " {").filter(|name| has_only(name, ""))
}

/// Returns whether a line begins an item of a known kind. Types begin with a capital letter: in
/// Rust a type's name may stand where a crate's stands.
fn is_item(words: &str) -> bool {
    let is_type = |name: &str| name.starts_with(|c: char| c.is_ascii_uppercase());
    let is_function = |name: &str| name.starts_with(|c: char| c.is_ascii_lowercase());
    let mut kinds = ["pub const ", "pub struct ", "pub type "].iter();
    let implemented = words.strip_prefix("impl ");
    let implemented = implemented.and_then(|rest| rest.split_once(" for "));
    kinds.any(|kind| words.strip_prefix(kind).is_some_and(is_type))
        || words.strip_prefix("pub fn ").is_some_and(is_function)
        || implemented.is_some_and(|(_, name)| is_type(name))
}

/// Returns whether a line has no quotes, comments, macros or attributes, at most one item, and
/// that at its beginning.
fn is_code(words: &str) -> bool {
    let bare = words.strip_prefix("pub ").unwrap_or(words);
    let first = bare.split(' ').next().unwrap_or("");
    let behind = &bare[first.len()..];
    // The one parameter that functions have.
    let behind = behind.replacen("<const L: usize>", "", 1);
    let none = |text: &str, listed: &[&str]| {
        let mut words = text.split(|c: char| !is_letter(c));
        !words.any(|word| listed.contains(&word))
    };
    has_only(words, " .,;:()[]{}<>&+-*/=")
        && none(words, &FORBIDDEN)
        && none(&behind, &ITEMS)
        && none(&behind, &["pub"])
}
