//! Clauses: `key: value` pairs, each with a semicolon behind it.
//!
//! An error of one pair is reported, and the next is read all the same.

use proc_macro2::{Delimiter, Group, Ident, Spacing, TokenStream, TokenTree};

use super::errors::Errors;
use super::messages as m;

/// A key and what stands behind its colon; nothing, after an error.
pub(super) struct Pair {
    pub(super) key: Ident,
    pub(super) value: Vec<TokenTree>,
}

/// Reads pairs; `may_stand` says what may stand behind a key. A key that is there twice counts
/// the first time.
pub(super) fn pairs(
    trees: &[TokenTree],
    may_stand: impl Fn(&str) -> String,
    errors: &mut Errors,
) -> Vec<Pair> {
    let mut pairs: Vec<Pair> = Vec::new();
    let mut rest = trees;
    while let Some((first, after)) = rest.split_first() {
        if is_separator(first) {
            if !is_punct(first, ';') {
                wanted(first, errors);
            }
            rest = after;
            continue;
        }
        let TokenTree::Ident(key) = first else {
            errors.push(first, &m::NO_KEY);
            rest = &rest[length(rest)..];
            continue;
        };
        let after = colon(key, after, errors);
        let (value, next) = after.split_at(length(after));
        if value.is_empty() {
            errors.say(key, m::NO_VALUE.text, &may_stand(&key.to_string()));
        }
        if let Some(TokenTree::Ident(next)) = next.first() {
            wanted(next, errors);
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

fn wanted(at: impl quote::ToTokens, errors: &mut Errors) {
    errors.say(at, "expected `;` before the next clause", "");
}

/// Skips the colon. `crate = path` is written as in attributes.
fn colon<'t>(key: &Ident, after: &'t [TokenTree], errors: &mut Errors) -> &'t [TokenTree] {
    match after.split_first() {
        Some((first, rest)) if is_punct(first, ':') => rest,
        Some((first, rest)) if is_punct(first, '=') => {
            if key != "crate" {
                errors.push(first, &m::NO_COLON);
            }
            rest
        }
        Some((first, _)) => {
            errors.push(first, &m::NO_COLON);
            after
        }
        None => after,
    }
}

/// Returns the number of trees of a value: up to a semicolon, or to the next key where the
/// semicolon was forgotten.
fn length(trees: &[TokenTree]) -> usize {
    let ends = |index: &usize| {
        let (tree, next) = (&trees[*index], trees.get(index + 1));
        let colon = |tree: &TokenTree| matches!(tree, TokenTree::Punct(p) if p.as_char() == ':' && p.spacing() == Spacing::Alone);
        let key = *index > 0 && matches!(tree, TokenTree::Ident(_)) && next.is_some_and(colon);
        // The second half of `::` is no colon of a key.
        let path = *index > 0 && is_punct(&trees[index - 1], ':');
        is_punct(tree, ';') || (key && !path)
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
