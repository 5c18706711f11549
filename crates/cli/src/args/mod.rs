//! Arguments of several subcommands, and how values are read. A subcommand's own arguments stand beside
//! its code.

mod options;
pub mod values;

use std::path::PathBuf;

use dalembert_import::ChainArgs;

pub use options::{Options, as_flags};

/// The help heading of the options for the code.
pub const CODE: &str = "Code options";

const SEARCH: &str = "Search options";

/// A robot and the options of a request.
#[derive(Debug, clap::Args)]
pub struct TaskArgs {
    /// The robot: a robot file, a URDF or an MJCF
    pub robot: PathBuf,
    #[command(flatten)]
    pub options: Options,
    #[command(flatten)]
    pub chain: ChainArgs,
}
