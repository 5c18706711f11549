//! `key: value` pairs with separators between them: the one form that
//! clauses, a robot's keys and a joint's keys have.
//!
//! What is wrong with one pair is reported, and the next is read all the
//! same.

use proc_macro2::{Delimiter, Group, Ident, Spacing, TokenStream, TokenTree};

use super::errors::Errors;
use super::messages as m;

/// A key and what stands behind its colon; nothing, after an error.
pub(super) struct Pair {
    pub(super) key: Ident,
    pub(super) value: Vec<TokenTree>,
}

/// Reads pairs. A key that is there twice counts the first time.
pub(super) fn pairs(trees: &[TokenTree], separator: char, errors: &mut Errors) -> Vec<Pair> {
    pairs_of(trees, separator, |_| String::new(), errors)
}

/// Reads the pairs where somebody knows what may stand behind a key.
pub(super) fn pairs_of(
    trees: &[TokenTree],
    separator: char,
    may_stand: impl Fn(&str) -> String,
    errors: &mut Errors,
) -> Vec<Pair> {
    let mut pairs: Vec<Pair> = Vec::new();
    let mut rest = trees;
    while let Some((first, after)) = rest.split_first() {
        if is_separator(first) {
            if !is_punct(first, separator) {
                wanted(first, separator, errors);
            }
            rest = after;
            continue;
        }
        let TokenTree::Ident(key) = first else {
            errors.push(first, &m::NO_KEY);
            rest = &rest[length(rest, separator)..];
            continue;
        };
        let after = colon(key, after, separator, errors);
        let (value, next) = after.split_at(length(after, separator));
        if value.is_empty() {
            errors.say(key, m::NO_VALUE.text, &may_stand(&key.to_string()));
        }
        if let Some(TokenTree::Ident(next)) = next.first() {
            wanted(next, separator, errors);
        }
        rest = next;
        if pairs.iter().any(|pair| pair.key == *key) {
            errors.twice(key);
            continue;
        }
        pairs.push(Pair {
            key: key.clone(),
            value: value.to_vec(),
        });
    }
    pairs
}

fn wanted(at: impl quote::ToTokens, separator: char, errors: &mut Errors) {
    let place = if separator == ';' { "clause" } else { "key" };
    let text = format!("expected `{separator}` before the next {place}");
    errors.say(at, &text, "");
}

/// Skips the colon. `crate = path` is written as in attributes.
fn colon<'t>(
    key: &Ident,
    after: &'t [TokenTree],
    separator: char,
    errors: &mut Errors,
) -> &'t [TokenTree] {
    let message = match separator {
        ';' => &m::NO_COLON,
        _ => &m::NO_KEY_COLON,
    };
    match after.split_first() {
        Some((first, rest)) if is_punct(first, ':') => rest,
        Some((first, rest)) if is_punct(first, '=') => {
            if key != "crate" {
                errors.push(first, message);
            }
            rest
        }
        Some((first, _)) => {
            errors.push(first, message);
            after
        }
        None => after,
    }
}

/// Returns how many trees belong to a value: up to a separator, or to the next key
/// where the separator was forgotten.
fn length(trees: &[TokenTree], separator: char) -> usize {
    let ends = |index: &usize| {
        let (tree, next) = (&trees[*index], trees.get(index + 1));
        // A list of words has commas of its own.
        let separates = is_separator(tree) && !(separator == ';' && is_punct(tree, ','));
        let colon = |tree: &TokenTree| matches!(tree, TokenTree::Punct(p) if p.as_char() == ':' && p.spacing() == Spacing::Alone);
        let key = *index > 0 && matches!(tree, TokenTree::Ident(_)) && next.is_some_and(colon);
        // The second half of `::` is no colon of a key.
        let path = *index > 0 && is_punct(&trees[index - 1], ':');
        separates || (key && !path)
    };
    (0..trees.len()).find(ends).unwrap_or(trees.len())
}

fn is_separator(tree: &TokenTree) -> bool {
    is_punct(tree, ';') || is_punct(tree, ',')
}

/// Returns whether a tree is this punctuation.
pub(super) fn is_punct(tree: &TokenTree, c: char) -> bool {
    matches!(tree, TokenTree::Punct(punct) if punct.as_char() == c)
}

/// Returns the items of a list; a comma at its end is fine.
pub(super) fn items(trees: &[TokenTree]) -> Vec<&[TokenTree]> {
    let mut items: Vec<&[TokenTree]> = trees.split(|tree| is_punct(tree, ',')).collect();
    if items.last().is_some_and(|last| last.is_empty()) {
        items.pop();
    }
    items
}

/// Returns the trees without the invisible groups around what another macro put in.
pub(super) fn trees(tokens: TokenStream) -> Vec<TokenTree> {
    let mut trees = Vec::new();
    for tree in tokens {
        match tree {
            TokenTree::Group(group) if group.delimiter() == Delimiter::None => {
                trees.extend(self::trees(group.stream()));
            }
            tree => trees.push(tree),
        }
    }
    trees
}

/// Returns the contents of a group in these delimiters.
pub(super) fn group(tree: &TokenTree, delimiter: Delimiter) -> Option<&Group> {
    match tree {
        TokenTree::Group(group) if group.delimiter() == delimiter => Some(group),
        _ => None,
    }
}
