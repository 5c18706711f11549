//! Code that is generated while compiling.

use std::path::Path;

use dalembert_codegen::{Language, Place, RobotFile, ask};
use proc_macro2::TokenStream;
use quote::{format_ident, quote, quote_spanned};

use crate::invocation::{Errors, Invocation};

pub(crate) fn texts(
    invocation: &Invocation,
    robot: Option<&Path>,
    errors: &mut Errors,
) -> (Vec<String>, TokenStream) {
    let shown = invocation.shown();
    let file = match robot {
        Some(path) => RobotFile::read_as(path, &shown),
        None => RobotFile::parse(&invocation.robot.value(), &shown),
    };
    let file = match file {
        Ok(file) => file,
        Err(diagnostics) => {
            for error in &diagnostics.0 {
                errors.say(&invocation.robot, error.render_plain().trim_end(), "");
            }
            return Default::default();
        }
    };
    match ask(&file, &invocation.asked, Language::Rust, &shown) {
        Ok(made) => {
            let numbered = (1..).zip(&made.warnings);
            let warnings = numbered.map(|(number, said)| warning(invocation, number, said));
            (made.generated.texts, warnings.collect())
        }
        Err(problems) => {
            for problem in problems.0 {
                let at = match &problem.place {
                    Place::Option(option, item) => invocation.word(option, item, &problem.message),
                    _ => quote::ToTokens::to_token_stream(&invocation.robot),
                };
                let help = problem.help.as_deref().unwrap_or_default();
                errors.say(at, &problem.message, help);
            }
            Default::default()
        }
    }
}

/// Returns a deprecated constant and its use at the robot's tokens: on a stable compiler a macro can
/// only report errors. An `#[allow(deprecated)]` above the module silences the warning.
fn warning(invocation: &Invocation, number: usize, said: &str) -> TokenStream {
    let span = invocation.robot.span();
    let name = format_ident!("ROBOT_WARNING_{number}", span = span);
    let constant = quote! {
        #[doc(hidden)]
        #[deprecated(note = #said)]
        const #name: () = ();
    };
    let used = quote_spanned!(span => const _: () = #name;);
    quote!(#constant #used)
}
