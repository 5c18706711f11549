//! How a run ends: 0 good, 1 a check failed, 2 bad input.

use std::process::ExitCode;

use dalembert_codegen::generate::GenerateError;
use dalembert_codegen::verify::exact::Disproof;

use crate::output;

/// Why a run does not end well; the text is for standard error.
#[derive(Debug)]
pub enum Failure {
    /// A check failed: exit code 1.
    Check(String),
    /// The input cannot be used: exit code 2.
    Input(String),
}

/// What a subcommand returns.
pub type Outcome = Result<(), Failure>;

/// Says what failed and gives the exit code.
pub fn exit(outcome: Outcome) -> ExitCode {
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(Failure::Check(why)) => {
            output::note(&why);
            ExitCode::from(1)
        }
        Err(Failure::Input(why)) => {
            output::note(&why);
            ExitCode::from(2)
        }
    }
}

impl From<GenerateError> for Failure {
    fn from(error: GenerateError) -> Self {
        let text = format!("error: {error}");
        match error {
            // A proof or a text check that fails is a failed check; all else
            // is something that the robot or the request asks for.
            GenerateError::Disproved(_, Disproof::Denominator) => Failure::Input(text),
            GenerateError::Disproved(..) | GenerateError::Text(..) => Failure::Check(text),
            _ => Failure::Input(text),
        }
    }
}
