//! Which functions to generate, and from what.

use dalembert_codegen::workspace::function::Function;
use dalembert_codegen::workspace::generate::{Fma, Prefer, Request};
use dalembert_codegen::workspace::language::MathPath;
use dalembert_codegen::workspace::portfolio::Start;
use dalembert_codegen::workspace::program::{Library, ScalarType};
use dalembert_codegen::workspace::simplify::Effort;
use dalembert_codegen::workspace::sincos::SinCos;
use dalembert_model::outputs::RuntimeParameter;

use super::values::{
    effort_parser, error_parser, function_parser, parameter_parser, prefer_parser, scalar_parser,
    sincos_parser, start_parser,
};
use super::{CODE, SEARCH};

/// Which functions, and from what.
#[derive(Clone, Debug, clap::Args)]
pub struct Choice {
    /// The functions, separated by commas [default: the robot file's, or the seven that a
    /// controller calls]; NAME=A+B is one that returns what A and B do, and shares their work
    #[arg(long, value_name = "NAMES", value_delimiter = ',', value_parser = function_parser())]
    pub outputs: Vec<Function>,
    /// The formulation to start from; `auto` takes the cheapest
    #[arg(long, value_name = "NAME", default_value = "auto", value_parser = start_parser(), help_heading = SEARCH)]
    pub formulation: Start,
    /// The scalar [default: both]
    #[arg(long, value_name = "TYPE", value_parser = scalar_parser())]
    pub scalar: Option<ScalarType>,
    /// How long to search for fewer operations. Ctrl-C ends a thorough search
    /// early (not with --check) and takes the best program so far, or the quick
    /// search's if that is cheaper; a second Ctrl-C quits without a result
    #[arg(long, value_name = "EFFORT", default_value = "quick", value_parser = effort_parser(), help_heading = SEARCH)]
    pub effort: Effort,
    /// `operations` takes the cheapest program even if it costs digits; `latency` takes
    /// sums and products in the order in which the longest chain of operations is shortest
    #[arg(long, value_name = "WHAT", default_value = "accuracy", value_parser = prefer_parser(), help_heading = SEARCH)]
    pub prefer: Prefer,
    /// Make one operation, `mul_add`, of a product and the sum that alone reads it:
    /// rounded once. The code needs std, and a build for a processor that has it
    /// (-C target-cpu=native); any other calls a slow function for each
    #[arg(long, help_heading = CODE)]
    pub fma: bool,
    /// Only what this scene of the robot file needs; its outputs and scalar
    /// are the defaults
    #[arg(long, value_name = "NAME")]
    pub scene: Option<String>,
    /// Parameters that become arguments of the functions instead of constants: `gravity`,
    /// and `payload`, which a function `load` turns once into the argument `load` of
    /// the others
    #[arg(long, value_name = "WHICH", value_delimiter = ',', value_parser = parameter_parser(), help_heading = CODE)]
    pub parameters: Vec<RuntimeParameter>,
    /// Search anew even if a plan is kept beside the robot file
    #[arg(long, help_heading = SEARCH)]
    pub no_plan: bool,
    /// How sines and cosines are computed: `libm`, one call for each angle;
    /// `together`, one call of the crate dalembert-sines for all angles of a
    /// function, in a third of libm's time; `polynomial`, polynomials that
    /// hold inside the joints' limits only; `auto`, polynomials where a
    /// scene's tolerance admits them, else libm
    #[arg(long, value_name = "HOW", default_value = "auto", value_parser = sincos_parser(), help_heading = CODE)]
    pub sincos: SinCos,
    /// The largest error of each sine and cosine by polynomials [default: 1e-6,
    /// or what a scene's tolerance admits]
    #[arg(long, value_name = "ERROR", value_parser = error_parser(), allow_hyphen_values = true, help_heading = CODE)]
    pub sincos_error: Option<f64>,
}

impl Choice {
    /// The request that it makes.
    pub fn request(&self) -> Request {
        let mut request = Request {
            start: self.formulation,
            effort: self.effort,
            prefer: self.prefer,
            fma: match self.fma {
                true => Fma::On,
                false => Fma::Off,
            },
            parameters: self.parameters.clone(),
            ..Request::default()
        };
        request.sincos = match self.sincos {
            SinCos::Polynomial { .. } => SinCos::Polynomial {
                error: self.sincos_error,
            },
            other => other,
        };
        request.math = MathPath::of(self.sincos.library(Library::Libm));
        request
    }
}
