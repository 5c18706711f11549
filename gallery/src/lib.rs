//! Arms of many makers: robot files, pictures and operation counts, all of them made
//! from what others published, by one command:
//!
//! ```sh
//! cargo run --release -p dalembert-gallery
//! ```
//!
//! - [`arms`]: which arms, where from, and under which licence
//! - [`made`]: what the command makes of one of them
//! - [`page`]: the table of all of them, `gallery/README.md`
#![forbid(unsafe_code)]
#![warn(missing_docs, clippy::missing_errors_doc)]

pub mod arms;
pub mod made;
pub mod page;

use std::path::Path;

/// Returns the folder of the gallery in this checkout.
pub fn folder() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}
