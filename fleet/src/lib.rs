//! A fleet's logs: residuals of an arm's model and identification of its parameters, as
//! functions of a query engine.
#![forbid(unsafe_code)]

mod arguments;
pub mod dynamics;
mod error;
pub mod functions;
pub mod logs;

pub use dynamics::{Dynamics, Generated, Loaded, States};
pub use error::Error;
pub use functions::{Functions, Residuals, register};
