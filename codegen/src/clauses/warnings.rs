//! What is odd about a robot, as warnings of the compiler.
//!
//! On a stable compiler a macro can only say what is an error. So each warning
//! is a constant that is deprecated with the warning as its note, and used at
//! the tokens that it is about. Both stand in the generated module: whoever
//! knows better writes `#[allow(deprecated)]` above the module.

use proc_macro2::{Ident, Span, TokenStream, TokenTree};
use quote::{quote, quote_spanned};

/// Something odd, at the tokens that it is about.
#[derive(Clone)]
pub(super) struct Warning {
    pub(super) at: TokenStream,
    pub(super) text: String,
    pub(super) help: Option<String>,
}

impl Warning {
    /// Returns a line of the module's documentation.
    pub(super) fn documentation(&self) -> String {
        format!("Warning: {}.", self.text)
    }

    /// Returns its constant and the use of that.
    fn tokens(&self, number: usize) -> TokenStream {
        let note = match &self.help {
            Some(help) => format!("{}\n  = help: {help}", self.text),
            None => self.text.clone(),
        };
        let span = span(&self.at);
        let name = Ident::new(&format!("ROBOT_WARNING_{number}"), span);
        let constant = quote! {
            #[doc(hidden)]
            #[deprecated(note = #note)]
            const #name: () = ();
        };
        // The compiler warns at the tokens of the use.
        let used = quote_spanned!(span => const _: () = #name;);
        quote!(#constant #used)
    }
}

/// Returns the tokens that stand in each module for the warnings.
pub(super) fn tokens(warnings: &[Warning]) -> TokenStream {
    let numbered = (1..).zip(warnings);
    numbered
        .map(|(number, warning)| warning.tokens(number))
        .collect()
}

/// Returns the first of the tokens: a stable compiler joins no spans.
fn span(tokens: &TokenStream) -> Span {
    let first = tokens.clone().into_iter().next();
    first.as_ref().map_or_else(Span::call_site, TokenTree::span)
}
