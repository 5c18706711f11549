//! The command line: subcommands, what is the same in several of them, and how values are read. A
//! subcommand's own arguments stand beside it.

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

/// Options that say how code is written.
pub const CODE: &str = "How the code is written";

/// Options that say how programs are found.
const SEARCH: &str = "How programs are found";

/// Verified, flat robot dynamics generated for one arm.
///
/// Exit codes: 0 good, 1 a check failed, 2 bad input.
#[derive(Debug, Parser)]
#[command(name = "dalembert", version)]
pub struct Args {
    /// What to do
    #[command(subcommand)]
    pub command: Command,
    /// Print the report as JSON
    #[arg(long, global = true)]
    json: bool,
    /// Write over files that this command did not write
    #[arg(long, global = true)]
    force: bool,
    /// Take warnings for errors: nothing is written, and the exit code is 1
    #[arg(long, global = true)]
    deny_warnings: bool,
}

impl Args {
    /// Returns what every subcommand may be asked for.
    pub fn context(&self) -> Context {
        Context::new(self.json, self.force, self.deny_warnings)
    }
}

/// What to do.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Make a crate with an arm: robot file, generated code, a test of its numbers
    New(NewArgs),
    /// Make a robot file of a chain of a URDF or an MJCF
    Import(ImportArgs),
    /// List the functions: what each takes and returns, with units
    Outputs,
    /// Generate code for a robot, proved before it is written
    Generate(GenerateArgs),
    /// Generate files anew whose robot file or text was edited
    Renew(RenewArgs),
    /// Count the operations of the generated functions
    Count(CountArgs),
    /// Draw the arm in two views, with frames, axes, masses and its table (SVG)
    Show(ShowArgs),
    /// Prove the functions and measure what rounding costs
    Verify(VerifyArgs),
    /// Check generated code by a second program that shares no code with the generator
    Certify(CertifyArgs),
    /// Show how many operations each step of the generator saves
    Explain(ExplainArgs),
    /// Measure what accuracy costs: certified error against operations
    Tradeoff(TradeoffArgs),
    /// Print what a shell completes: dalembert completions bash > ~/.local/share/bash-completion/completions/dalembert
    Completions {
        /// The shell
        shell: Shell,
    },
}

/// A robot and what is asked of it.
#[derive(Debug, clap::Args)]
pub struct TaskArgs {
    /// The robot: a robot file, a URDF or an MJCF
    pub robot: PathBuf,
    #[command(flatten)]
    pub options: Options,
}
