//! The list of what is wrong with an invocation.

use proc_macro2::TokenStream;
use quote::ToTokens;

use super::messages::Message;

/// Collects errors, each at the tokens that it is about, so that all of them
/// are reported at once.
#[derive(Default)]
pub(super) struct Errors(Vec<syn::Error>);

impl Errors {
    /// Adds a message of the table.
    pub(super) fn push(&mut self, at: impl ToTokens, message: &Message) {
        self.say(at, message.text, message.help);
    }

    /// Adds a message that was put together.
    pub(super) fn say(&mut self, at: impl ToTokens, text: &str, help: &str) {
        let help = match help {
            "" => String::new(),
            help => format!("\n  = help: {help}"),
        };
        self.0
            .push(syn::Error::new_spanned(at, format!("{text}{help}")));
    }

    /// Reports a name that is there already.
    pub(super) fn twice(&mut self, name: impl ToTokens) {
        let text = format!("`{}` is given twice", name.to_token_stream());
        self.say(name, &text, "");
    }

    /// Adds the message of the parser of the grammar's head.
    pub(super) fn syntax(&mut self, error: syn::Error) {
        self.0.push(error);
    }

    pub(super) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    pub(super) fn len(&self) -> usize {
        self.0.len()
    }

    /// Returns one `compile_error!` each.
    pub(super) fn into_tokens(self) -> TokenStream {
        self.0.iter().map(syn::Error::to_compile_error).collect()
    }
}
