//! The first lines of a generated file, and the check that it may be used as it stands.
//!
//! - [`Asked`]: the options that somebody asked for, as one text
//! - [`Stamp`]: the first lines of a file: version, robot file, what was asked, the text's hash
//! - [`Stamp::check`]: why a file may not be used
//! - [`sealed`], [`is_as_written`]: the hash of a text in its first line, which tells edited files
//! - [`refusal`]: why a file may not be replaced; [`write_whole`]: writes one, whole or not at all
//!
//! Macro, build script and command share it. It knows nothing of robots: who takes a file that is
//! there compiles no generator.
#![forbid(unsafe_code)]
#![warn(missing_docs, clippy::missing_errors_doc)]

mod asked;
mod stamp;

pub use asked::{Asked, NotAsked, OPTIONS, beside, items, suffix};
pub use stamp::{
    Comment, Stale, Stamp, hash, is_as_written, refusal, relative, sealed, write_whole,
};
