//! The command line.
//!
//! - this file: the commands
//! - `choice`: which functions to generate, and from what
//! - `files`: arguments of the commands that make and look at robot files
//! - `code`: of those that generate functions, count and explain their operations
//! - `errors`: of those that measure and bound errors
//! - `values`: how values are read

mod choice;
mod code;
mod errors;
mod files;
mod values;

use clap::{Parser, Subcommand};

pub use choice::Choice;
pub use code::{CountArgs, ExplainArgs, GenerateArgs, Table3Args};
pub use errors::{CertifyArgs, StressArgs, TradeoffArgs, VerifyArgs};
pub use files::{ChainArgs, CouplingsArgs, ImportArgs, NewArgs, ShowArgs};

/// Verified, flat robot dynamics generated for one arm.
///
/// Exit codes: 0 good, 1 a check failed, 2 bad input.
#[derive(Debug, Parser)]
#[command(name = "dalembert", version)]
pub struct Args {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

/// What to do.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Generate Rust source for a robot, proved before it is printed
    Generate(GenerateArgs),
    /// Make a crate with an arm: robot file, macro, a test against the runtime
    New(NewArgs),
    /// Make a robot file of a chain of a URDF
    Import(ImportArgs),
    /// Draw the arm in two views, with frames, axes, masses and its table (SVG)
    Show(ShowArgs),
    /// Count the operations of the generated functions
    Count(CountArgs),
    /// Prove the functions and measure what rounding costs
    Verify(VerifyArgs),
    /// Say which coefficients of the dynamics vanish or repeat, and why
    Couplings(CouplingsArgs),
    /// Show how many operations each step of the generator saves, and for what reason
    Explain(ExplainArgs),
    /// Measure rounding errors in extreme cases: huge angles and speeds, odd masses
    Stress(StressArgs),
    /// Check a certificate again: proof, edits, text and every bound
    Certify(CertifyArgs),
    /// Measure what accuracy costs: certified error against operations
    Tradeoff(TradeoffArgs),
    /// Compare with Table 3: the paper's counts, the formulas', the generator's
    Table3(Table3Args),
}
