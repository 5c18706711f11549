//! All tests, in one program: the engine is linked once.

mod bad;
#[cfg(feature = "cluster")]
mod cluster;

mod commands;
mod formats;
mod functions;
mod resources;
mod ros;
mod support;
