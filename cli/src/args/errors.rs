//! Arguments of the commands that measure and bound errors.

use std::path::PathBuf;

use dalembert_codegen::{Effort, Function};

use super::Options;
use super::values::{
    certified_parser, count_parser, function_parser, positive_parser, states_parser,
    tolerance_parser, word_parser,
};

/// Arguments of `verify`.
#[derive(Debug, clap::Args)]
pub struct VerifyArgs {
    /// The robot file
    pub robot: PathBuf,
    /// Compare with these states too: JSON with a list `states` of objects
    /// with q, qd, qdd and any of tau, D, h, c
    #[arg(long, value_name = "FILE.json", conflicts_with = "scene")]
    pub given: Option<PathBuf>,
    /// Measure the torques also where robots are not: huge angles and speeds, other masses and
    /// lengths; and what divides where D is nearest to singular
    #[arg(long, conflicts_with = "scene")]
    pub extremes: bool,
    /// States of each row
    #[arg(
        long,
        value_name = "N",
        allow_negative_numbers = true,
        value_parser = states_parser(),
        default_value_t = 50
    )]
    pub states: usize,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
    #[command(flatten)]
    pub options: Options,
}

/// Arguments of `certify`.
#[derive(Debug, clap::Args)]
pub struct CertifyArgs {
    /// The certificate (JSON), or a generated file (.rs, .h) of which every function is checked
    #[arg(value_parser = certified_parser())]
    pub certificate: PathBuf,
    /// The robot file that it is for
    #[arg(long, value_name = "FILE")]
    pub robot: PathBuf,
    /// The scene of the robot file that it is for [default: the one it names]
    #[arg(long, value_name = "NAME")]
    pub scene: Option<String>,
    /// The largest error relative to T to accept, instead of the scene's tolerance;
    /// for certificates that `tradeoff` wrote for other tolerances
    #[arg(long, value_name = "E", value_parser = positive_parser())]
    pub tolerance: Option<f64>,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

/// Arguments of `tradeoff`.
#[derive(Debug, clap::Args)]
pub struct TradeoffArgs {
    /// The robot file; the box is its limits of motion, unless a scene has one
    pub robot: PathBuf,
    /// Only what this scene of the robot file needs; its tolerance gives way
    /// to the list of tolerances
    #[arg(long, value_name = "NAME")]
    pub scene: Option<String>,
    /// The function [default: the scene's first, or inverse_dynamics]
    #[arg(long, value_name = "NAME", value_parser = function_parser())]
    pub function: Option<Function>,
    /// What errors are relative to: `actuator`, the joints' torque limits, or `range`,
    /// the largest torque that was found for the model in the box
    /// [default: the scene's, or actuator]
    #[arg(long, value_name = "SCALE", value_parser = ["actuator", "range"])]
    pub relative_to: Option<String>,
    /// Tolerances, separated by commas [default: 1e-12 to 1e-1]
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = tolerance_parser(), allow_hyphen_values = true)]
    pub tolerances: Vec<f64>,
    /// Write table, chart and certificates to this folder
    #[arg(short, long, value_name = "DIR")]
    pub output: Option<PathBuf>,
    /// States at which each variant is run; with 0 nothing is observed
    #[arg(
        long,
        value_name = "N",
        allow_negative_numbers = true,
        value_parser = count_parser(),
        default_value_t = 10_000
    )]
    pub samples: usize,
    /// Climbs from there to the largest error of each output
    #[arg(
        long,
        value_name = "N",
        allow_negative_numbers = true,
        value_parser = count_parser(),
        default_value_t = 4
    )]
    pub climbs: usize,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
    /// How long to search for fewer operations
    #[arg(long, value_name = "EFFORT", default_value = "quick", value_parser = word_parser::<Effort>())]
    pub effort: Effort,
}
