//! The command line: subcommands, shared arguments, and parsers of values. A subcommand's own
//! arguments stand beside its code.

mod options;
pub mod values;

use std::path::PathBuf;

use clap::{Parser, Subcommand};
use clap_complete::Shell;

pub use options::Options;

use crate::output::Context;
use crate::{
    certify::CertifyArgs, count::CountArgs, explain::ExplainArgs, generate::GenerateArgs,
    import::ImportArgs, new::NewArgs, renew::RenewArgs, show::ShowArgs, tradeoff::TradeoffArgs,
    verify::VerifyArgs,
};

/// The help heading of the options for the code.
pub const CODE: &str = "Code options";

/// The help heading of the options for the search.
const SEARCH: &str = "Search options";

/// Verified, flat robot dynamics generated for one arm.
///
/// Exit codes: 0 good, 1 a check failed, 2 bad input.
#[derive(Debug, Parser)]
#[command(name = "dalembert", version)]
pub struct Args {
    /// The subcommand
    #[command(subcommand)]
    pub command: Command,
    /// Print the report as JSON
    #[arg(long, global = true)]
    json: bool,
    /// Overwrite files that this command did not write
    #[arg(long, global = true)]
    force: bool,
    /// Treat warnings as errors: nothing is written, and the exit code is 1
    #[arg(long, global = true)]
    deny_warnings: bool,
}

impl Args {
    /// Returns the options that all subcommands share.
    pub fn context(&self) -> Context {
        Context::new(self.json, self.force, self.deny_warnings)
    }
}

/// The subcommands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Make a crate for an arm: robot file, generated code and a test of its torques
    New(NewArgs),
    /// Make a robot file from a chain of a URDF or an MJCF
    Import(ImportArgs),
    /// List the functions: what each takes and returns, with units
    Outputs,
    /// Generate code for a robot and prove it before it is written
    Generate(GenerateArgs),
    /// Regenerate files after an edit of the robot file or of their text
    Renew(RenewArgs),
    /// Count the operations of the generated functions
    Count(CountArgs),
    /// Draw the arm in two views, with frames, axes, masses and its table (SVG)
    Show(ShowArgs),
    /// Prove the functions and measure their rounding errors
    Verify(VerifyArgs),
    /// Check generated code with a second program that shares no code with the generator
    Certify(CertifyArgs),
    /// Show how many operations each step of the generator saves
    Explain(ExplainArgs),
    /// Measure the cost of accuracy: certified error against number of operations
    Tradeoff(TradeoffArgs),
    /// Print shell completions: dalembert completions bash > ~/.local/share/bash-completion/completions/dalembert
    Completions {
        /// The shell
        shell: Shell,
    },
}

/// A robot and the options of a request.
#[derive(Debug, clap::Args)]
pub struct TaskArgs {
    /// The robot: a robot file, a URDF or an MJCF
    pub robot: PathBuf,
    #[command(flatten)]
    pub options: Options,
}
