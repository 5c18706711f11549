//! `dynamics!`: tokens to `dalembert-codegen`, tokens back.
#![forbid(unsafe_code)]

use proc_macro::TokenStream;

/// Generates verified dynamics of one robot: see the crate `dalembert`, which
/// re-exports this, for the robot, the clauses (`outputs`, `scalar`,
/// `formulation`, `effort`, `prefer`, `fma`, `sincos`, `sincos_error`, `entries`, `interface`,
/// `parameters`, `scene`, `crate`) and the keys of a scene.
#[proc_macro]
pub fn dynamics(input: TokenStream) -> TokenStream {
    // Cargo sets it; without it, paths are relative to where the compiler runs.
    let base = std::env::var_os("CARGO_MANIFEST_DIR").unwrap_or_default();
    dalembert_codegen::clauses::expand(input.into(), base.as_ref()).into()
}
