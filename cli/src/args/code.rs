//! Arguments of the commands that generate functions, count and explain their operations.

use std::path::PathBuf;

use dalembert_codegen::workspace::WaySource;
use dalembert_codegen::{Effort, Function, Language};

use super::values::{function_parser, states_parser, word_parser};
use super::{CODE, MORE, Options};

/// Arguments of `generate`.
#[derive(Debug, clap::Args)]
pub struct GenerateArgs {
    /// The robot file
    pub robot: PathBuf,
    /// Write the code to this file [default: standard output, `-`], the second of two
    /// scalars in Rust beside it; its ending chooses the language (.rs, .h, .cuh). A link is
    /// followed, a device or pipe written into
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Write over files that this command did not write
    #[arg(long, requires = "output")]
    pub force: bool,
    /// The language of the code [default: that of the ending of -o, or rust]
    #[arg(long, value_name = "WORD", value_parser = word_parser::<Language>(), help_heading = CODE)]
    pub language: Option<Language>,
    /// Print rounding errors, the counts after each stage and the proofs as well
    #[arg(short, long)]
    pub verbose: bool,
    /// With a scene that has a tolerance: write its certificates (JSON) to this
    /// file [default: beside the output, as NAME.certificate.json, unless that
    /// is a device or pipe]
    #[arg(long, value_name = "FILE", help_heading = MORE)]
    pub certificate: Option<PathBuf>,
    /// Search anew and keep the programs in a plan beside the robot file:
    /// every later run, macro and build script replays them. After a search
    /// that was ended early, a kept program stays unless that found a cheaper
    /// one
    #[arg(long, conflicts_with = "plan")]
    pub save_plan: bool,
    /// Measure errors at this many states inside the robot's limits [default:
    /// 100, fewer above 10 joints; 10000 with --effort thorough]
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = states_parser(), help_heading = MORE)]
    pub states: Option<usize>,
    /// Print the reports as JSON; the code goes to -o
    #[arg(long, requires = "output", help_heading = MORE)]
    pub json: bool,
    #[command(flatten)]
    pub options: Options,
}

/// Arguments of `renew`.
#[derive(Debug, clap::Args)]
pub struct RenewArgs {
    /// The generated files [default: all in this folder and below it]
    pub files: Vec<PathBuf>,
    /// Write nothing, and exit with 1 if a file is not what would be generated
    #[arg(long)]
    pub check: bool,
    /// Print the files and what became of each as JSON
    #[arg(long)]
    pub json: bool,
}

/// Arguments of `count`.
#[derive(Debug, clap::Args)]
pub struct CountArgs {
    /// The robot file
    pub robot: PathBuf,
    /// Print also the longest chain of operations of each program, the calls of its code,
    /// the formulation that it was found from, and how sure its proof is
    #[arg(short, long)]
    pub verbose: bool,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
    #[command(flatten)]
    pub options: Options,
}

/// Arguments of `explain`.
#[derive(Debug, clap::Args)]
pub struct ExplainArgs {
    /// The robot file
    pub robot: PathBuf,
    /// The functions, separated by commas [default: the scene's, or
    /// inverse_dynamics]
    #[arg(long, value_name = "NAMES", value_delimiter = ',', value_parser = function_parser())]
    pub outputs: Vec<Function>,
    /// Only what this scene of the robot file needs
    #[arg(long, value_name = "NAME")]
    pub scene: Option<String>,
    /// States that errors are measured in
    #[arg(long, value_name = "N", allow_negative_numbers = true, default_value_t = 1000, value_parser = states_parser())]
    pub states: usize,
    /// How long to search for fewer operations
    #[arg(long, value_name = "EFFORT", default_value = "quick", value_parser = word_parser::<Effort>())]
    pub effort: Effort,
    /// List every coefficient: D_ik, h_ikm, c_i, and which vanish or repeat another
    #[arg(long, conflicts_with = "scene")]
    pub coefficients: bool,
    /// Show also what the search finds without each of these sources of ways
    #[arg(long, hide = true, value_name = "SOURCES", value_delimiter = ',', value_parser = word_parser::<WaySource>())]
    pub without: Vec<WaySource>,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}
