//! The generated text as tokens, with the user's name, visibility and
//! attributes.
//!
//! The compiler's own lexer reads the text; nothing parses it again, since
//! bodies are as long as the dynamics are.

use proc_macro2::{Delimiter, Group, Ident, LexError, TokenStream, TokenTree};
use quote::{ToTokens, quote};
use syn::Attribute;

use super::invocation::Invocation;
use super::warnings::{self, Warning};
use crate::backend::{Entries, MathPath};
use crate::emit::Interface;
use crate::program::Library;
use crate::sincos::SinCos;

/// Where the bodies find sine and cosine: an import of the module, so that a
/// wrong path to the facade is one error and not one a call.
const MATH: &str = "__math";

/// Where the robot's type finds its traits.
pub(super) const TRAITS: &str = "__traits";

/// Where batches find the crate that runs them.
pub(super) const BATCH: &str = "__batch";

/// Whose sines the bodies call: by default those of all angles together, which
/// the facade has with it.
pub(super) fn math(sincos: SinCos) -> MathPath {
    match sincos.library(Library::Together) {
        Library::Together => MathPath::together(format!("{MATH}::together")),
        Library::Libm => MathPath::libm(MATH),
    }
}

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
    let math = Ident::new(MATH, proc_macro2::Span::call_site());
    let import = quote! {
        #[allow(unused_imports)]
        use #facade::__private::math as #math;
    };
    let batches = (invocation.entries == Entries::Batch).then(|| {
        let batch = Ident::new(BATCH, proc_macro2::Span::call_site());
        quote! {
            #[allow(unused_imports)]
            use #facade::batch as #batch;
        }
    });
    let traits = (invocation.interface == Interface::Traits).then(|| {
        let traits = Ident::new(TRAITS, proc_macro2::Span::call_site());
        quote! {
            #[allow(unused_imports)]
            use #facade::interface as #traits;
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
    for tree in text.parse::<TokenStream>()? {
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
                    quote!(#import #batches #traits #warnings #inner),
                );
                whole.to_tokens(&mut tokens);
                start = true;
            }
            tree => tree.to_tokens(&mut tokens),
        }
    }
    Ok(tokens)
}

/// The module's name as the user wrote it, so that tools find their way.
fn name(word: &Ident, invocation: &Invocation) -> Ident {
    if *word == invocation.name {
        return invocation.name.clone();
    }
    Ident::new(&word.to_string(), invocation.name.span())
}
