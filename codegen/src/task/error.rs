//! The reasons for which nothing is generated.

use std::fmt;

use crate::function::{Argument, Function};
use crate::program::ScalarType;
use crate::verify::exact::Disproof;
use dalembert_model::diagnostic::Diagnostic;
use dalembert_model::scene::Scene;

/// The reasons for which nothing is generated.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum GenerateError {
    /// The request cannot be met; the function that it is about, if it is about one.
    Refused(Option<Function>, Diagnostic),
    /// A parameter cannot be an argument, of a function if it is about one.
    Parameter(Option<Function>, Diagnostic),
    /// The plan is for another robot, or for this robot or scene, which is named, before an edit. It
    /// keeps hashes alone, so what was edited is not known.
    Stale(Box<str>, Diagnostic),
    /// A constant is beyond the scalar's range, or rounds to zero.
    Constant(Function, Diagnostic),
    /// No polynomial gives a sine as exactly as was wanted.
    SinCos(Function, Diagnostic),
    /// D has no inverse in any state.
    Singular(Function, Diagnostic),
    /// The program is not the formula: a defect of this library, a plan's
    /// program of something else, or parameters that cannot be proved with.
    Disproved(Function, Disproof),
    /// A defect of this library, in the scalar where there is one: the printed text is not the
    /// program, what was left out within a tolerance is not what the edits say, or code that was
    /// proved is wrong at a state where it was run: it may have been made to deceive the proof.
    Defect(Function, Option<ScalarType>, String),
    /// The base parameters cannot be written down.
    Base(Function, Diagnostic),
    /// No variant meets the scene's tolerance.
    Tolerance(Function, Miss, Diagnostic),
    /// The plan's variant does not belong to the plan's program.
    Variant(Function, Diagnostic),
}

/// The reasons for which no variant meets a tolerance.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Miss {
    /// Errors of such a function have no bound, a limit that it needs is missing, or the actuators
    /// are no measure of its outputs; or it would take more work than may be done.
    Refused,
    /// The full model's D cannot be shown to be positive definite.
    Indefinite,
    /// A value inside the box may be more than the scalar holds.
    Overflow,
    /// The errors of rounding and of the sines alone are not shown to be within the tolerance.
    Above,
}

impl GenerateError {
    /// Refuses what cannot be had, with the likely fix.
    pub fn refused(
        function: impl Into<Option<Function>>,
        message: impl Into<String>,
        help: impl Into<String>,
    ) -> GenerateError {
        GenerateError::Refused(function.into(), Diagnostic::error(message).with_help(help))
    }

    /// Refuses a request for nothing.
    pub fn empty() -> GenerateError {
        GenerateError::refused(None, "nothing to generate", "name an output and a scalar")
    }

    pub(crate) fn stale_plan(robot: &str) -> GenerateError {
        let message = format!(
            "the plan beside the robot file no longer fits `{robot}`: a parameter, a limit or a name \
             was changed since; make it anew with `dalembert generate ROBOT --save-plan` and the \
             effort that it was made with, or delete it"
        );
        GenerateError::Stale(format!("`{robot}`").into(), Diagnostic::error(message))
    }

    pub(crate) fn stale_scene(scene: &str) -> GenerateError {
        let message = format!(
            "the plan no longer fits the scene `{scene}`: the scene was edited, the robot was not; \
             make its program anew with `dalembert generate ROBOT --scene {scene} --save-plan` and \
             the effort that it was made with, or delete the plan"
        );
        let shown = format!("the scene `{scene}`");
        GenerateError::Stale(shown.into(), Diagnostic::error(message))
    }

    pub(crate) fn follows(function: Function) -> GenerateError {
        let takes_slopes = function.arguments().contains(&Argument::Multiplier);
        let (message, help) = match takes_slopes {
            true => (
                format!("`{function}` is not available where joints follow others (`mimic`)"),
                "first derivatives are",
            ),
            false => (
                format!(
                    "`{function}` has entries of each link, and where joints follow others (`mimic`) \
                     there are more links than coordinates"
                ),
                "ask for `forward_kinematics@FRAME` of frames on links, or `regressor` in place of \
                 `full_regressor`",
            ),
        };
        GenerateError::refused(function, message, help)
    }

    pub(crate) fn floats(function: Function) -> GenerateError {
        let takes_slopes = function.arguments().contains(&Argument::Multiplier);
        let (why, help) = match takes_slopes {
            true => (
                "second derivatives by the turns of a base do not commute",
                "first derivatives are available",
            ),
            false => (
                "its symbols are of joints' own rates, and the velocity of a base is not one",
                "`coriolis_matrix` is available: C q̇ = h, and Ḋ - 2C is skew",
            ),
        };
        let message = format!("`{function}` is not available where the base floats: {why}");
        GenerateError::refused(function, message, help)
    }

    pub(crate) fn is_fixed(function: Function, scene: Option<&Scene>) -> GenerateError {
        let message =
            format!("`{function}` is not available where the base is fixed: something holds it");
        let help = match scene {
            Some(scene) if scene.lock_base => format!("scene `{}` locks the base", scene.name),
            _ => {
                "a base floats if the first `[[joint]]` is of kind `floating`; `import --floating`"
                    .to_owned()
            }
        };
        GenerateError::refused(function, message, help)
    }

    /// Returns the function that it is about, if it is about one.
    pub fn function(&self) -> Option<Function> {
        match self {
            GenerateError::Stale(..) => None,
            GenerateError::Refused(function, _) | GenerateError::Parameter(function, _) => {
                *function
            }
            GenerateError::Constant(function, _)
            | GenerateError::Singular(function, _)
            | GenerateError::Base(function, _)
            | GenerateError::Defect(function, ..)
            | GenerateError::SinCos(function, _)
            | GenerateError::Disproved(function, _)
            | GenerateError::Tolerance(function, ..)
            | GenerateError::Variant(function, _) => Some(*function),
        }
    }
}

impl From<Diagnostic> for GenerateError {
    fn from(error: Diagnostic) -> GenerateError {
        GenerateError::Refused(None, error)
    }
}

impl fmt::Display for GenerateError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            GenerateError::Refused(_, why)
            | GenerateError::Parameter(_, why)
            | GenerateError::Stale(_, why)
            | GenerateError::Constant(_, why) => why.fmt(f),
            GenerateError::Disproved(function, disproof) => write!(f, "`{function}`: {disproof}"),
            GenerateError::Defect(function, scalar, why) => {
                let scalar = scalar.map_or(String::new(), |scalar| format!(" in {scalar}"));
                let report = "please report this defect of dalembert";
                write!(f, "`{function}`{scalar}: {why}; {report}")
            }
            GenerateError::SinCos(function, why)
            | GenerateError::Base(function, why)
            | GenerateError::Singular(function, why) => write!(f, "`{function}`: {why}"),
            GenerateError::Tolerance(function, _, why) => write!(f, "`{function}`: {why}"),
            GenerateError::Variant(function, why) => write!(
                f,
                "the plan's variant of `{function}`: {why}; make the plan anew with `dalembert \
                 generate ROBOT --scene SCENE --save-plan` and the effort that it was made with, \
                 or delete it"
            ),
        }
    }
}

impl std::error::Error for GenerateError {}
