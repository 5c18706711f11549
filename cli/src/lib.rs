//! The `dalembert` command: verified flat robot dynamics from a robot file.
//!
//! - `args`: the command line
//! - `generate`: code, written or printed
//! - `renew`: generated files made new, or compared with what would be generated
//! - `import`: a robot file of a URDF
//! - `show`: the arm in two views
//! - `new`: a crate to begin with
//! - `count`: operation counts
//! - `verify`: the exact proof and what rounding costs
//! - `explain`: what each step brought, which coefficients vanish or repeat, and why
//! - `certify`: a certificate checked again
//! - `tradeoff`: certified error against operations
//! - `plot`: charts as SVG
//! - `input`: robot and state files
//! - `model`: a URDF or an MJCF
//! - `progress`: a long search watched, and ended early
//! - `files`: files that are written: checked first, all or none
//! - `output`: standard output, tables
//! - `outcome`: how a run ends
//!
//! What is reported, which other crates and tests use:
//!
//! - [`couplings`]: the coefficients that vanish or repeat
//! - [`measure`]: rounding, against 256-bit arithmetic
//! - [`extremes`]: rounding where robots are not, and next to a singular D
//! - [`explained`]: what each step brought, and why
//! - [`drawing`]: the arm in two views, as SVG
//! - [`states`]: given states compared with the code
//! - [`table3`]: the paper's counts beside the formulas'
//! - [`sweep`]: certified error against operations, tolerance by tolerance
#![forbid(unsafe_code)]

pub mod couplings;
pub mod drawing;
pub mod explained;
pub mod extremes;
pub mod measure;
pub mod states;
pub mod sweep;
pub mod table3;

mod args;
mod bar;
mod certify;
mod count;
mod explain;
mod files;
mod generate;
mod import;
mod input;
mod model;
mod new;
mod outcome;
mod output;
mod plot;
mod progress;
mod renew;
mod show;
mod sines;
mod tradeoff;
mod verify;

use std::ffi::OsString;

use clap::{CommandFactory, Parser};
use clap_complete::Shell;

use args::{Args, Command};
use outcome::{Failure, Outcome};

/// Runs the command with its arguments, the first of which is its name, and returns the exit
/// code of the process. Wrong arguments and `--help` end the process.
pub fn run(args: impl IntoIterator<Item = OsString>) -> u8 {
    let args = Args::parse_from(args);
    output::begin(args.deny_warnings);
    let waiting = bar::begin();
    let outcome = match args.command {
        Command::Generate(args) => generate::run(&args),
        Command::Renew(args) => renew::run(&args),
        Command::Import(args) => import::run(&args),
        Command::New(args) => new::run(&args),
        Command::Show(args) => show::run(&args),
        Command::Count(args) => count::run(&args),
        Command::Verify(args) => verify::run(&args),
        Command::Explain(args) => explain::run(&args),
        Command::Certify(args) => certify::run(&args),
        Command::Tradeoff(args) => tradeoff::run(&args),
        Command::Completions { shell } => completions(shell),
    };
    drop(waiting);
    let outcome = outcome.and_then(|()| output::undenied());
    let (why, code) = match outcome {
        Ok(()) => return 0,
        Err(Failure::Check(why)) => (why, 1),
        Err(Failure::Input(why)) => (why, 2),
    };
    output::note(&why);
    code
}

/// Prints the completions of a shell.
fn completions(shell: Shell) -> Outcome {
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut Args::command(), "dalembert", &mut script);
    output::print(&String::from_utf8_lossy(&script))
}
