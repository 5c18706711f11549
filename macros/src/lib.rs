//! `dynamics!`: takes the generated file beside a robot file into a module, if it is of this robot
//! and holds what is asked. With the feature `search` the module is generated where there is none.
#![forbid(unsafe_code)]
#![warn(missing_docs, clippy::missing_errors_doc)]

mod invocation;
mod module;
#[cfg(feature = "search")]
mod search;
#[cfg(test)]
mod tests;

use std::path::{Path, PathBuf};

use proc_macro::TokenStream;

/// Takes the generated dynamics of a robot into a module: see the crate `dalembert`, which
/// re-exports this, for the robot and the clauses.
#[proc_macro]
pub fn dynamics(input: TokenStream) -> TokenStream {
    // Cargo sets it; without it, paths are relative to where the compiler runs.
    let base = std::env::var_os("CARGO_MANIFEST_DIR").unwrap_or_default();
    // The folder of the file with the macro, where that is a file; absolute, as other
    // macros take relative paths for relative to that file.
    let file = proc_macro::Span::call_site().local_file();
    let file = file.and_then(|file| std::path::absolute(file).ok());
    let beside = file.as_deref().and_then(Path::parent).map(Path::to_owned);
    let folders: Vec<PathBuf> = std::iter::once(base.into()).chain(beside).collect();
    module::expand(input.into(), &folders).into()
}
