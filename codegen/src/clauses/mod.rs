//! The ways in: the words of a request, the robot file, and `dynamics!` as a whole.
//!
//! - [`words`]: outputs, scalars, formulations, efforts, preferences, sources of sines
//! - [`robot_file`]: a robot file from a path, with errors fit to show
//! - [`expand`]: the tokens of `dynamics!` to the tokens of its modules, by
//!   way of `invocation` (the grammar), `list` (words and bundles) and `module` (the generated
//!   text as tokens)
//! - `warnings`: warnings about a robot, as warnings of the compiler
//! - `messages`, `errors`: the table of errors of an invocation, and the list of those found
//!
//! The command and the build script's builder use the first two.

mod errors;
mod expand;
mod invocation;
mod list;
mod messages;
mod module;
pub(crate) mod robot_file;
mod statement;
mod warnings;

pub use expand::{expand, expand_from};
pub use robot_file::{RobotFile, RobotFileError};
