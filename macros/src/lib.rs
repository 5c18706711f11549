//! `dynamics!`: tokens to `dalembert-codegen`, tokens back.
#![forbid(unsafe_code)]
#![warn(missing_docs, clippy::missing_errors_doc)]

use proc_macro::TokenStream;

/// Generates verified dynamics of one robot: see the crate `dalembert`, which
/// re-exports this, for the robot, the clauses (`outputs`, `scalar`,
/// `formulation`, `effort`, `prefer`, `fma`, `sincos`, `sincos_error`, `batch`,
/// `parameters`, `scene`, `crate`) and the keys of a scene.
#[proc_macro]
pub fn dynamics(input: TokenStream) -> TokenStream {
    // Cargo sets it; without it, paths are relative to where the compiler runs.
    let base = std::env::var_os("CARGO_MANIFEST_DIR").unwrap_or_default();
    // The folder of the file with the macro, where that is a file; absolute, as other
    // macros take relative paths for relative to that file.
    let file = proc_macro::Span::call_site().local_file();
    let file = file.and_then(|file| std::path::absolute(file).ok());
    let beside = file.as_deref().and_then(std::path::Path::parent);
    let folders: Vec<&std::path::Path> = std::iter::once(base.as_ref()).chain(beside).collect();
    dalembert_codegen::workspace::clauses::expand_from(
        input.into(),
        &folders,
        cfg!(feature = "batch"),
    )
    .into()
}
