//! The `dalembert` command: a subcommand takes arguments and a `Context`, and returns a report and
//! files; [`run`] prints and writes them, and returns the exit code.
//!
//! - `args`: the command line; `source`: robots and requests; `progress`: progress bar and Ctrl-C
//! - `report`: facts and tables, as text and as JSON; `output`: prints; `files`: writes all or none
//! - `generate`, `renew`, `count`; `code`: the report of generated code
//! - `import`, `new`, `show`, `outputs`; [`drawing`]: the arm in two views, as SVG
//! - `verify`; [`measure`]: rounding errors against 256-bit arithmetic; [`extremes`]: the same in
//!   extreme cases; [`given`]: states and results from another program
//! - `certify`: checks by the independent checker
//! - [`explain`]; [`steps`]: the operations that each step saves; [`couplings`]: coefficients that
//!   vanish or repeat; [`table3`]: the paper's counts beside the formulas'
//! - `tradeoff`; `ladder`: its variants, tolerance by tolerance; `chart`: its picture
#![forbid(unsafe_code)]
#![warn(missing_docs, clippy::missing_errors_doc)]

mod args;
mod certify;
mod chart;
mod code;
mod count;
pub mod couplings;
pub mod drawing;
pub mod explain;
pub mod extremes;
mod files;
mod generate;
pub mod given;
mod import;
mod ladder;
pub mod measure;
mod new;
mod output;
mod outputs;
mod progress;
mod renew;
mod report;
mod show;
mod source;
pub mod steps;
pub mod table3;
mod tradeoff;
mod verify;

use std::ffi::OsString;

use clap::{CommandFactory, Parser};

use args::{Args, Command};
use output::{Done, Failure, note};

/// Runs the command with its arguments, the first of which is its name, and returns the exit
/// code of the process. Wrong arguments and `--help` end the process.
pub fn run(args: impl IntoIterator<Item = OsString>) -> u8 {
    let args = Args::parse_from(args);
    let context = args.context();
    let bar = progress::begin();
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
        Command::Completions { shell } => {
            let mut script = Vec::new();
            clap_complete::generate(*shell, &mut Args::command(), "dalembert", &mut script);
            output::print(&String::from_utf8_lossy(&script)).map(|()| Done::default())
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
