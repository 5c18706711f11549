//! Which functions to generate, and from what.

use dalembert_codegen::workspace::function::{Function, RuntimeParameter};
use dalembert_codegen::workspace::program::ScalarType;
use dalembert_codegen::workspace::sincos::SinCos;
use dalembert_codegen::workspace::task::Request;

use super::options::Options;
use super::values::{error_parser, function_parser, word_parser};
use super::{CODE, SEARCH};

/// Which functions, and from what.
#[derive(Clone, Debug, clap::Args)]
pub struct Choice {
    /// The functions, separated by commas [default: the robot file's, or the seven that a
    /// controller calls]; NAME=A+B is one that returns what A and B do, and shares their work
    #[arg(long, value_name = "NAMES", value_delimiter = ',', value_parser = function_parser())]
    pub outputs: Vec<Function>,
    /// The scalar [default: both]
    #[arg(long, value_name = "TYPE", value_parser = word_parser::<ScalarType>())]
    pub scalar: Option<ScalarType>,
    /// Only what this scene of the robot file needs; its outputs and scalar
    /// are the defaults
    #[arg(long, value_name = "NAME")]
    pub scene: Option<String>,
    /// How it is searched for, and computed.
    #[command(flatten)]
    pub options: Options<false>,
    /// Parameters that become arguments of the functions instead of constants: `gravity`,
    /// and `payload`, which a function `load` turns once into the argument `load` of
    /// the others
    #[arg(long, value_name = "WHICH", value_delimiter = ',', value_parser = word_parser::<RuntimeParameter>(), help_heading = CODE)]
    pub parameters: Vec<RuntimeParameter>,
    /// Search anew even if a plan is kept beside the robot file
    #[arg(long, help_heading = SEARCH)]
    pub no_plan: bool,
    /// The largest error of each sine and cosine by polynomials [default: 1e-6,
    /// or what a scene's tolerance admits]
    #[arg(long, value_name = "ERROR", value_parser = error_parser(), allow_hyphen_values = true, help_heading = CODE)]
    pub sincos_error: Option<f64>,
}

impl Choice {
    /// Makes the request.
    pub fn request(&self) -> Request {
        let mut request = Request {
            parameters: self.parameters.clone(),
            ..Request::default()
        };
        self.options.set(&mut request);
        if let SinCos::Polynomial { error } = &mut request.sincos {
            *error = self.sincos_error;
        }
        request
    }
}
