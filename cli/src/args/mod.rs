//! The command line.
//!
//! - this file: the commands
//! - `files`: arguments of the commands that make and look at robot files
//! - `code`: of those that generate functions, count and explain their operations
//! - `errors`: of those that measure and bound errors
//! - `options`: the options of a request, from the table
//! - `values`: how values are read

mod code;
mod errors;
mod files;
mod options;
mod values;

use clap::{Parser, Subcommand};
use clap_complete::Shell;

pub use code::{CountArgs, ExplainArgs, GenerateArgs, RenewArgs};
pub use errors::{CertifyArgs, TradeoffArgs, VerifyArgs};
pub use files::{ChainArgs, ImportArgs, NewArgs, ShowArgs};
pub use options::Options;

/// Options that say how code is written.
const CODE: &str = "How the code is written";

/// Options that say how programs are found.
const SEARCH: &str = "How programs are found";

/// Options that few need.
const MORE: &str = "More";

/// Verified, flat robot dynamics generated for one arm.
///
/// Exit codes: 0 good, 1 a check failed, 2 bad input.
#[derive(Debug, Parser)]
#[command(name = "dalembert", version)]
pub struct Args {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
    /// Take warnings of robot files and models for errors: nothing is written, and the exit code is 1
    #[arg(long, global = true)]
    pub deny_warnings: bool,
}

/// What to do.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Make a crate with an arm: robot file, generated code, a test of its numbers
    New(NewArgs),
    /// Make a robot file of a chain of a URDF
    Import(ImportArgs),
    /// Generate Rust source for a robot, proved before it is printed
    Generate(GenerateArgs),
    /// Generate files anew whose robot file or text was edited, each from its own first lines
    Renew(RenewArgs),
    /// Count the operations of the generated functions
    Count(CountArgs),
    /// Draw the arm in two views, with frames, axes, masses and its table (SVG)
    Show(ShowArgs),
    /// Prove the functions and measure what rounding costs
    Verify(VerifyArgs),
    /// Check a certificate again: proof, edits, text and every bound
    Certify(CertifyArgs),
    /// Show how many operations each step of the generator saves, and for what reason
    Explain(ExplainArgs),
    /// Measure what accuracy costs: certified error against operations
    Tradeoff(TradeoffArgs),
    /// Print what a shell completes: dalembert completions bash > ~/.local/share/bash-completion/completions/dalembert
    Completions {
        /// The shell
        shell: Shell,
    },
}
