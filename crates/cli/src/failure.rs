//! Why a run failed.

use dalembert_codegen::GenerateError;
use dalembert_codegen::workspace::Disproof;

use crate::args::as_flags;

/// The failure of a run, with its text for standard error.
#[derive(Debug)]
pub enum Failure {
    /// A check failed: exit code 1.
    Check(String),
    /// The input cannot be used: exit code 2.
    Input(String),
}

impl From<GenerateError> for Failure {
    fn from(error: GenerateError) -> Self {
        let text = as_flags(&format!("error: {error}"));
        match error {
            // Failed proofs, runs and text checks are failed checks; all other errors come
            // from the robot or the request.
            GenerateError::Disproved(_, Disproof::Unfit | Disproof::Large) => Failure::Input(text),
            GenerateError::Disproved(..) | GenerateError::Defect(..) => Failure::Check(text),
            _ => Failure::Input(text),
        }
    }
}
