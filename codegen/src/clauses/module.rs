//! The generated text as tokens, with the user's name, visibility and
//! attributes.
//!
//! The compiler's own lexer reads the text; nothing parses it again, since
//! bodies are as long as the dynamics are.

use proc_macro2::{Delimiter, Group, Ident, LexError, Span, TokenStream, TokenTree};
use quote::{ToTokens, quote};
use syn::Attribute;

use super::invocation::Invocation;
use super::warnings::{self, Warning};
/// Dresses every module of the text; the warnings end its documentation, and
/// the compiler gives those of the first module.
pub(super) fn assemble(
    text: &str,
    invocation: &Invocation,
    warnings: &[Warning],
) -> Result<TokenStream, LexError> {
    let Invocation {
        attributes,
        visibility,
        facade,
        ..
    } = invocation;
    let import = quote! {
        #[allow(unused_imports)]
        use #facade::__private::{dalembert_sines, libm};
    };
    let batches = invocation.request.batch.then(|| {
        quote! {
            #[allow(unused_imports)]
            use #facade::batch as dalembert_batch;
        }
    });
    let is_doc = |attribute: &Attribute| attribute.path().is_ident("doc");
    let gap = attributes.iter().any(is_doc).then(|| quote!(#[doc = ""]));
    let notes = warnings.iter().map(Warning::documentation);
    let notes: TokenStream = notes
        .map(|note| quote!(#[doc = ""] #[doc = #note]))
        .collect();
    let mut warnings = warnings::tokens(warnings);

    let mut tokens = TokenStream::new();
    let mut start = true;
    let text: TokenStream = with_attributes(text).parse()?;
    for tree in located(text, invocation) {
        if start {
            tokens.extend(quote!(#(#attributes)* #gap));
            start = false;
        }
        match tree {
            TokenTree::Ident(word) if word == "pub" => {
                tokens.extend(quote!(#notes #visibility));
            }
            TokenTree::Ident(word) if word != "mod" => {
                name(&word, invocation).to_tokens(&mut tokens);
            }
            TokenTree::Group(body) if body.delimiter() == Delimiter::Brace => {
                let inner = body.stream();
                let warnings = std::mem::take(&mut warnings);
                let whole = Group::new(
                    Delimiter::Brace,
                    quote!(#import #batches #warnings #inner),
                );
                whole.to_tokens(&mut tokens);
                start = true;
            }
            tree => tree.to_tokens(&mut tokens),
        }
    }
    Ok(tokens)
}

/// Returns the module's name as the user wrote it, so that tools find their way.
fn name(word: &Ident, invocation: &Invocation) -> Ident {
    if *word == invocation.name {
        return invocation.name.clone();
    }
    Ident::new(&word.to_string(), invocation.name.span())
}

/// Returns the text with its comments of documentation as the attributes that they stand for:
/// an editor that reads tokens itself takes a third slash for a part of the comment.
fn with_attributes(text: &str) -> String {
    let mut attributes = String::with_capacity(text.len());
    for line in text.lines() {
        match line.trim_start().strip_prefix("///") {
            Some(said) => attributes += &format!("#[doc = {said:?}]"),
            None => attributes += line,
        }
        attributes.push('\n');
    }
    attributes
}

/// Returns the tokens where they are to be found: a function at its output's name in the macro,
/// as far as that was written, all else at the macro as a whole. Places in the generated
/// text would be places in no file.
fn located(tokens: TokenStream, invocation: &Invocation) -> TokenStream {
    let mut is_name = false;
    let located = tokens.into_iter().map(|tree| {
        let was_fn = std::mem::replace(
            &mut is_name,
            matches!(&tree, TokenTree::Ident(word) if word == "fn"),
        );
        match tree {
            TokenTree::Group(group) => {
                let mut whole = Group::new(group.delimiter(), located(group.stream(), invocation));
                whole.set_span(Span::call_site());
                TokenTree::Group(whole)
            }
            TokenTree::Ident(mut word) if was_fn => {
                word.set_span(place(&word, invocation));
                TokenTree::Ident(word)
            }
            mut tree => {
                tree.set_span(Span::call_site());
                tree
            }
        }
    });
    located.collect()
}

/// Returns where the output of a function is asked for: the longest name that the function's
/// begins with, since what follows says how it is called.
fn place(function: &Ident, invocation: &Invocation) -> Span {
    let function = function.to_string();
    let asked = invocation.outputs.iter().flatten();
    let own = asked.filter(|(output, _)| {
        let rest = function.strip_prefix(output.name());
        rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('_'))
    });
    let longest = own.max_by_key(|(output, _)| output.name().len());
    let first = longest.and_then(|(_, tokens)| tokens.clone().into_iter().next());
    first.map_or_else(Span::call_site, |token| token.span())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The compiler's lexer and others agree: documentation comes as attributes, with
    /// what would end a string escaped.
    #[test]
    fn documentation_is_attributes() {
        let text = "/// τ in \"N·m\" \\ n\nmod arm {\n    ///\n    pub fn f() {}\n}\n";
        let found = with_attributes(text);
        assert!(!found.contains("///"), "{found}");
        let [one, other] = [text, &found].map(|text| text.parse::<TokenStream>().unwrap());
        let file = |tokens| syn::parse2::<syn::File>(tokens).unwrap().items;
        assert_eq!(file(one), file(other));
    }
}
