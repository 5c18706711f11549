//! Which parameters can be arguments, and of what.

use std::fmt;

use dalembert_model::outputs::{PayloadDependence, RuntimeParameter};

use crate::approximate::error::Unbounded;
use crate::function::{Argument, Function};
use crate::language::Language;
use crate::seeds::Start;
use crate::task::Job;

/// Why a parameter cannot be an argument.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ParameterError {
    /// The function depends on more of a payload than joints feel.
    Unregrouped(Function),
    /// A textbook's formulation has no regrouped parameters.
    Formulation(Start),
    /// Batches in Rust have arguments with an entry a joint.
    Batch(RuntimeParameter),
    /// The scene says what gravity is.
    Gravity {
        /// The scene's name.
        scene: String,
    },
    /// The scene has a tolerance, and no box bounds the argument.
    Tolerance(Function, Argument),
    /// No joint feels what the last link carries.
    Unfelt,
}

impl ParameterError {
    /// Returns the function that it is about, if it is about one.
    pub(super) fn function(&self) -> Option<Function> {
        match self {
            ParameterError::Unregrouped(function) | ParameterError::Tolerance(function, _) => {
                Some(*function)
            }
            _ => None,
        }
    }
}

impl fmt::Display for ParameterError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            ParameterError::Unregrouped(function) => write!(
                f,
                "`{function}` depends on parameters of the payload that have no effect on joint torques, \
                 and `load` does not have these: generate `{function}` without `payload`, or give the \
                 payload in a scene"
            ),
            ParameterError::Formulation(start) => write!(
                f,
                "the formulation `{}` has no regrouped parameters, and a payload is an argument \
                 by these: leave `formulation` out, or give the payload in a scene",
                start.name()
            ),
            ParameterError::Batch(parameter) => write!(
                f,
                "batches in Rust take arguments with an entry a joint, and {} is none: leave \
                 `batch` out",
                parameter.name()
            ),
            ParameterError::Gravity { scene } => write!(
                f,
                "the scene `{scene}` says what gravity is, so it is no argument: leave it out of \
                 the scene or of the parameters"
            ),
            ParameterError::Tolerance(function, argument) => {
                write!(f, "`{function}`: {}", Unbounded::Reads(*argument))
            }
            ParameterError::Unfelt => {
                f.write_str("no joint that moves feels a payload: leave it out of the parameters")
            }
        }
    }
}

/// Refuses, before anything is searched for, what cannot be.
pub(super) fn check(job: &Job<'_>) -> Result<(), ParameterError> {
    let Job { setup, request, .. } = *job;
    let Some(&first) = request.parameters.first() else {
        return Ok(());
    };
    let scene = request.scene.as_ref();
    if job.tolerance().is_some() {
        let mut functions = request.functions.iter();
        let taking = functions.find_map(|&function| {
            let mut taken = request.parameters.iter();
            let parameter = taken.find(|&&parameter| function.depends_on(parameter))?;
            Some((function, parameter.argument()))
        });
        if let Some((function, argument)) = taking {
            return Err(ParameterError::Tolerance(function, argument));
        }
    }
    // In other languages a batch has columns of any argument.
    if request.language == Language::Rust && request.batch {
        return Err(ParameterError::Batch(first));
    }
    let given = scene.filter(|scene| scene.gravity.is_some());
    if let (true, Some(scene)) = (setup.has(RuntimeParameter::Gravity), given) {
        let scene = scene.name.clone();
        return Err(ParameterError::Gravity { scene });
    }
    if !setup.has(RuntimeParameter::Payload) {
        return Ok(());
    }
    if request.start != Start::Auto {
        return Err(ParameterError::Formulation(request.start));
    }
    let mut functions = request.functions.iter();
    if let Some(&function) =
        functions.find(|function| function.payload_dependence() == PayloadDependence::Full)
    {
        return Err(ParameterError::Unregrouped(function));
    }
    match setup.load().is_some_and(|load| !load.rows.is_empty()) {
        true => Ok(()),
        false => Err(ParameterError::Unfelt),
    }
}
