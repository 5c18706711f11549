//! How a run ends: 0 good, 1 a check failed, 2 bad input.

use dalembert_codegen::GenerateError;
use dalembert_codegen::workspace::Disproof;

/// Why a run does not end well; the text is for standard error.
#[derive(Debug)]
pub enum Failure {
    /// A check failed: exit code 1.
    Check(String),
    /// The input cannot be used: exit code 2.
    Input(String),
}

/// The result of a subcommand.
pub type Outcome = Result<(), Failure>;

impl From<GenerateError> for Failure {
    fn from(error: GenerateError) -> Self {
        let text = format!("error: {error}");
        match error {
            // A proof, a run or a text check that fails is a failed check; all else
            // is something that the robot or the request asks for.
            GenerateError::Disproved(_, Disproof::Unfit | Disproof::Large) => Failure::Input(text),
            GenerateError::Disproved(..) | GenerateError::Defect(..) => Failure::Check(text),
            _ => Failure::Input(text),
        }
    }
}
