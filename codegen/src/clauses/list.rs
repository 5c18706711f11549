//! Lists of words, and of outputs, where one at a frame and a bundle are items too:
//! `gravity, jacobian @ camera : local, servo = inverse_dynamics + jacobian`.

use proc_macro2::{Delimiter, Ident, TokenStream, TokenTree};
use quote::ToTokens;

use dalembert_model::read::for_bundle;

use super::errors::Errors;
use super::messages as m;
use super::statement::{self, is_punct, trees};
use crate::function::{BundleError, Function};
use crate::task::Request;
use crate::task::options::WordOption;
use crate::words::{self, UnknownWord, Word};

/// Reads words with commas between, in brackets as a scene has them or without.
pub(super) fn words<W: Word>(value: &[TokenTree], errors: &mut Errors) -> Vec<(W, TokenStream)> {
    read(W::WHAT, W::known, value, errors, |item, _, errors| {
        word(item, errors, words::parse)
    })
}

/// Sets an option by one word.
pub(super) fn set(
    option: &WordOption,
    request: &mut Request,
    value: &[TokenTree],
    errors: &mut Errors,
) {
    let mut set = |text: &str| (option.set)(request, text);
    let one = |item: &[TokenTree], before: &[((), TokenStream)], errors: &mut Errors| match before {
        [] => word(item, errors, &mut set),
        _ => {
            errors.push(tokens(item), &m::ONE_WORD);
            None
        }
    };
    read(option.what, option.known, value, errors, one);
}

/// Outputs with commas between, as [`words`]; some may be bundles of others.
pub(super) fn outputs(value: &[TokenTree], errors: &mut Errors) -> Vec<(Function, TokenStream)> {
    let sign = |tree: &TokenTree| is_punct(tree, '=') || is_punct(tree, '+');
    let one =
        |item: &[TokenTree], before: &[(Function, TokenStream)], errors: &mut Errors| match item
            .iter()
            .any(sign)
        {
            true => bundle(item, before, errors),
            false => output(item, errors),
        };
    read(Function::WHAT, Function::known, value, errors, one)
}

/// Returns every word that there is of a kind.
pub(super) fn known(words: &[&str]) -> String {
    format!("known: {}", words.join(", "))
}

/// Reads the items of a list of words of a kind, each with those before it.
fn read<T>(
    what: &str,
    words: fn() -> Vec<&'static str>,
    value: &[TokenTree],
    errors: &mut Errors,
    mut one: impl FnMut(&[TokenTree], &[(T, TokenStream)], &mut Errors) -> Option<T>,
) -> Vec<(T, TokenStream)> {
    let mut read = Vec::new();
    let list = match value {
        [tree] => statement::group(tree, Delimiter::Bracket),
        _ => None,
    };
    let inner = list.map(|list| trees(list.stream()));
    if let (Some(list), Some([])) = (list, inner.as_deref()) {
        errors.say(list, m::NO_VALUE.text, &known(&words()));
    }
    let value = inner.as_deref().unwrap_or(value);
    // The comma that an item ends before.
    let mut comma = 0;
    for item in statement::items(value) {
        let before = comma + item.len();
        comma = before + 1;
        if item.is_empty() {
            let text = format!("expected the word for the {what} before this comma");
            errors.say(value.get(before), &text, "one comma between two words");
            continue;
        }
        let found = one(item, &read, errors);
        read.extend(found.map(|found| (found, tokens(item))));
    }
    read
}

/// Returns the value of a word.
fn word<T>(
    item: &[TokenTree],
    errors: &mut Errors,
    parse: impl FnOnce(&str) -> Result<T, UnknownWord>,
) -> Option<T> {
    match item {
        [TokenTree::Ident(ident)] => match parse(&ident.to_string()) {
            Ok(value) => Some(value),
            Err(error) => {
                errors.say(ident, &error.message(), &error.help());
                None
            }
        },
        [TokenTree::Ident(_), next, ..] => {
            errors.push(next, &m::NO_COMMA);
            None
        }
        _ => {
            errors.push(tokens(item), &m::NO_WORD);
            None
        }
    }
}

/// Returns an output by its word, or one at a frame.
fn output(item: &[TokenTree], errors: &mut Errors) -> Option<Function> {
    let sign = |tree: &TokenTree| is_punct(tree, '@') || is_punct(tree, ':');
    if !item.iter().any(sign) {
        return word(item, errors, words::parse);
    }
    let text: String = item.iter().map(TokenTree::to_string).collect();
    match Function::parse(&text) {
        Ok(output) => Some(output),
        Err(error) => {
            errors.say(tokens(item), &error.message(), &for_bundle(&error));
            None
        }
    }
}

/// Returns `name = output + output`
fn bundle(
    item: &[TokenTree],
    before: &[(Function, TokenStream)],
    errors: &mut Errors,
) -> Option<Function> {
    let (name, parts) = match item {
        [TokenTree::Ident(name), equals, parts @ ..] if is_punct(equals, '=') => (name, parts),
        _ => {
            let text: String = item.iter().map(TokenTree::to_string).collect();
            let error = match is_punct(&item[0], '=') || !is_sum(item) {
                true => BundleError::Few(None),
                false => BundleError::Nameless(text),
            };
            errors.say(tokens(item), &error.message(), &error.help());
            return None;
        }
    };
    let said = errors.len();
    let before: Vec<Function> = before.iter().map(|(output, _)| *output).collect();
    let mut read = Vec::new();
    for part in parts.split(|tree| is_punct(tree, '+')) {
        match part {
            [TokenTree::Ident(word)] if nested(word, &before).is_some() => {
                if let Some(error) = nested(word, &before) {
                    errors.say(word, &error.message(), &error.help());
                }
            }
            [TokenTree::Ident(_)] => {
                read.extend(word(part, errors, words::parse).map(|output| (output, part)))
            }
            [TokenTree::Ident(_), at, ..] if is_punct(at, '@') || is_punct(at, ':') => {
                read.extend(output(part, errors).map(|output| (output, part)));
            }
            [TokenTree::Ident(_), next, ..] => errors.push(next, &m::NO_PLUS),
            [] => errors.push(tokens(item), &m::NO_PART),
            _ => errors.push(tokens(part), &m::NO_PART),
        }
    }
    let made = Function::bundle(&name.to_string(), read.iter().map(|(output, _)| *output));
    match made {
        Ok(bundle) => Some(bundle),
        // What is missing from the bundle was said already.
        Err(BundleError::Few(_)) if errors.len() > said => None,
        Err(error) => {
            let of = |wrong: &Function| {
                let mut parts = read.iter().rev();
                parts.find(|(output, _)| output == wrong)
            };
            let at = match &error {
                BundleError::Twice(_, [_, other]) | BundleError::SameField(_, [_, other]) => {
                    of(other).map(|(_, part)| tokens(part))
                }
                BundleError::Few(_) => Some(tokens(item)),
                _ => None,
            };
            let at = at.unwrap_or_else(|| name.to_token_stream());
            errors.say(at, &error.message(), &for_bundle(&error));
            None
        }
    }
}

/// Returns why a word is no part: it is a bundle before this one.
fn nested(word: &Ident, before: &[Function]) -> Option<BundleError> {
    let error = BundleError::Unknown(word.to_string()).among(before);
    matches!(error, BundleError::Nested(_)).then_some(error)
}

/// Returns whether words are added in it, and nothing else.
fn is_sum(item: &[TokenTree]) -> bool {
    let word = |tree: &TokenTree| matches!(tree, TokenTree::Ident(_)) || is_punct(tree, '+');
    item.iter().all(word)
}

fn tokens(item: &[TokenTree]) -> TokenStream {
    item.iter().cloned().collect()
}
