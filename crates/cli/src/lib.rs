//! The `dalembert` command: a subcommand takes arguments and a `Context`, and returns a report and
//! files; [`run`] prints and writes them, and returns the exit code.
//!
//! - `args`: the command line; `source`: robots and requests; `progress`: searches in the bar, and Ctrl-C
//! - `report`: facts and tables, as text and as JSON; `terminal`: prints, beside the bar, and fails
//! - `files`: writes all or none; `output`: what a subcommand takes and returns
//! - `generate`, `renew`, `count`; `code`: the report of generated code
//! - `import`, `new`, `show`, `outputs`, `pose`; [`drawing`]: the arm in two views, as SVG
//! - `verify`; [`measure`]: rounding errors against 256-bit arithmetic; [`extremes`]: the same in
//!   extreme cases; [`given`]: states and results from another program
//! - `certify`: checks by the independent checker
//! - [`explain`]; [`steps`]: the operations that each step saves; `formulas`: closed forms to read;
//!   `couplings`: why coefficients vanish; `robot_report`: a page with all of them; [`table3`]: the paper's counts beside the formulas'
//! - `tradeoff`; `ladder`: its variants, tolerance by tolerance; `chart`: its picture
#![forbid(unsafe_code)]
#![warn(missing_docs, clippy::missing_errors_doc)]

mod args;
mod certify;
mod chart;
mod code;
mod count;
mod couplings;
pub mod drawing;
pub mod explain;
pub mod extremes;
mod files;
mod formulas;
mod generate;
pub mod given;
mod import;
mod ladder;
pub mod measure;
mod new;
mod output;
mod outputs;
mod pose;
mod progress;
mod renew;
mod report;
mod robot_report;
mod show;
mod source;
pub mod steps;
pub mod table3;
mod terminal;
mod tradeoff;
mod verify;

use std::cell::Cell;
use std::ffi::OsString;

use clap::{CommandFactory, Parser, Subcommand};
use clap_complete::Shell;

use output::{Context, Done, Failure};
use terminal::note;

/// Verified, flat robot dynamics generated for one arm.
///
/// Exit codes: 0 good, 1 a check failed, 2 bad input.
#[derive(Debug, Parser)]
#[command(name = "dalembert", version)]
struct Args {
    /// The subcommand
    #[command(subcommand)]
    command: Command,
    /// Print the report as JSON
    #[arg(long, global = true)]
    json: bool,
    /// Overwrite files that dalembert did not write, or that were edited since
    #[arg(long, global = true)]
    force: bool,
    /// Treat warnings as errors: nothing is written, and the exit code is 1
    #[arg(long, global = true)]
    deny_warnings: bool,
}

/// The subcommands.
#[derive(Debug, Subcommand)]
enum Command {
    /// Make a crate for an arm: robot file, generated code and a test of its torques
    New(new::NewArgs),
    /// Make a robot file from a chain of a URDF or an MJCF
    Import(import::ImportArgs),
    /// List the functions: what each takes and returns, with units
    Outputs,
    /// Generate code for a robot and prove it before it is written
    Generate(generate::GenerateArgs),
    /// Regenerate files after an edit of the robot file; with --force also those whose text was edited
    Renew(renew::RenewArgs),
    /// Count the operations of the generated functions
    Count(count::CountArgs),
    /// Draw the arm in two views, with frames, axes, masses and its table (SVG)
    Show(show::ShowArgs),
    /// Prove the functions and measure their rounding errors
    Verify(verify::VerifyArgs),
    /// Check generated code with a second program, which has equations of its own
    Certify(certify::CertifyArgs),
    /// Write a robot's equations, say why coefficients vanish, or show what each step of the generator saves
    Explain(explain::ExplainArgs),
    /// Measure the cost of accuracy: bounds of the error against numbers of operations
    Tradeoff(tradeoff::TradeoffArgs),
    /// Write helpers for the pose of a base that floats: gravity in its axes, steps and differences
    Pose(pose::PoseArgs),
    /// Print shell completions: dalembert completions bash > ~/.local/share/bash-completion/completions/dalembert
    Completions {
        /// The shell
        shell: Shell,
    },
}

/// Runs the command with its arguments, the first of which is its name, and returns the exit
/// code of the process. Wrong arguments and `--help` end the process.
pub fn run(args: impl IntoIterator<Item = OsString>) -> u8 {
    let args = Args::parse_from(args);
    let context = Context {
        json: args.json,
        force: args.force,
        denies_warnings: args.deny_warnings,
        warned: Cell::new(false),
    };
    let bar = terminal::begin();
    let outcome = match &args.command {
        Command::New(args) => new::run(args, &context),
        Command::Import(args) => import::run(args, &context),
        Command::Outputs => outputs::run(),
        Command::Generate(args) => generate::run(args, &context),
        Command::Renew(args) => renew::run(args, &context),
        Command::Count(args) => count::run(args, &context),
        Command::Show(args) => show::run(args, &context),
        Command::Verify(args) => verify::run(args, &context),
        Command::Certify(args) => certify::run(args, &context),
        Command::Explain(args) => explain::run(args, &context),
        Command::Tradeoff(args) => tradeoff::run(args, &context),
        Command::Pose(args) => pose::run(args, &context),
        Command::Completions { shell } => {
            let mut script = Vec::new();
            clap_complete::generate(*shell, &mut Args::command(), "dalembert", &mut script);
            terminal::print(&String::from_utf8_lossy(&script)).map(|()| Done::default())
        }
    };
    drop(bar);
    let (why, code) = match outcome.and_then(|done| context.finish(done)) {
        Ok(()) => return 0,
        Err(Failure::Check(why)) => (why, 1),
        Err(Failure::Input(why)) => (why, 2),
    };
    note(&why);
    code
}
