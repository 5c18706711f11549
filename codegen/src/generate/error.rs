//! Why nothing was generated.

use std::fmt;

use super::parameters::ParameterError;
use super::reason::NoSines;
use crate::approximate::error::ToleranceError;
use crate::certificate::Refuted;
use crate::function::{Argument, Function};
use crate::generate::language::Lacks;
use crate::language::Language;
use crate::program::ScalarType;
use crate::setup::SceneError;
use crate::setup::base::NoBase;
use crate::verify::exact::Disproof;

/// Why nothing was generated.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum GenerateError {
    /// The request names no function or no scalar.
    Empty,
    /// These are not the same, and would have one name or one struct.
    Namesakes(Function, Function),
    /// There is nothing to explain of a function that regrouping does not reach.
    Unexplained(Function),
    /// The plan is for another robot, or for this one before an edit.
    StalePlan {
        /// The robot that the plan names.
        robot: String,
    },
    /// The plan's program is for the scene before an edit. A plan keeps the
    /// scene's hash alone, so what was edited is not known.
    StaleScene {
        /// The scene.
        scene: String,
    },
    /// The robot has no frame of this name.
    Frame {
        /// Which function is at it.
        function: Function,
        /// The name.
        frame: &'static str,
        /// The likely fix.
        fix: String,
    },
    /// It has something of each link, and joints of the robot follow others.
    Follows(Function),
    /// The scene is none of this robot.
    Scene(SceneError),
    /// A constant is beyond the scalar's range, or rounds to zero.
    Constant {
        /// The function that needs it.
        function: Function,
        /// The scalar that cannot hold it.
        scalar: ScalarType,
        /// Its value, roughly.
        value: String,
    },
    /// No polynomial gives a sine as exactly as was wanted.
    SinCos(Function, NoSines),
    /// A function would be too large to compile.
    TooLarge {
        /// Which function.
        function: Function,
        /// How many numbers it returns.
        outputs: usize,
    },
    /// D has no inverse in any state.
    Singular {
        /// Which function needs one.
        function: Function,
        /// The joint that moves no inertia, as messages name it.
        joint: String,
    },
    /// The program is not the formula: a defect of this library, a plan's
    /// program of something else, or parameters that cannot be proved with.
    Disproved(Function, Disproof),
    /// The program is not the formula, because the search took a constant for
    /// zero that is none.
    Vanishing(Function, String),
    /// A defect of this library, in the scalar where there is one: the printed text is not the
    /// program, what was left out within a tolerance is not what the edits say, or code that was
    /// proved is wrong at a state where it was run, by which somebody may have aimed at a proof.
    Defect(Function, Option<ScalarType>, String),
    /// The base parameters cannot be written down.
    Base(Function, NoBase),
    /// A parameter cannot be an argument.
    Parameter(ParameterError),
    /// The language has no such thing, or no such name.
    Language(Language, Lacks),
    /// No variant meets the scene's tolerance.
    Tolerance(Function, ToleranceError),
    /// The plan's variant is none of the plan's program.
    Variant(Function, Refuted),
}

impl GenerateError {
    /// Returns the function that it is about, if it is about one.
    pub fn function(&self) -> Option<Function> {
        match self {
            GenerateError::Empty
            | GenerateError::Unexplained(_)
            | GenerateError::StalePlan { .. }
            | GenerateError::StaleScene { .. }
            | GenerateError::Language(..)
            | GenerateError::Scene(_) => None,
            GenerateError::Parameter(why) => why.function(),
            GenerateError::Constant { function, .. }
            | GenerateError::Frame { function, .. }
            | GenerateError::Singular { function, .. }
            | GenerateError::TooLarge { function, .. }
            | GenerateError::Base(function, _)
            | GenerateError::Follows(function)
            | GenerateError::Defect(function, ..)
            | GenerateError::SinCos(function, _)
            | GenerateError::Disproved(function, _)
            | GenerateError::Tolerance(function, _)
            | GenerateError::Variant(function, _)
            | GenerateError::Namesakes(_, function)
            | GenerateError::Vanishing(function, _) => Some(*function),
        }
    }
}

impl fmt::Display for GenerateError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            GenerateError::Empty => f.write_str("nothing to generate: name an output and a scalar"),
            GenerateError::Namesakes(one, other) => write!(
                f,
                "`{}` and `{}` would have one name or one struct in a module: call one of them \
                 otherwise",
                one.text(),
                other.text()
            ),
            GenerateError::Frame {
                function,
                frame,
                fix,
            } => write!(
                f,
                "`{}`: the robot has no frame `{frame}`: {fix}",
                function.text()
            ),
            GenerateError::Follows(function)
                if function.arguments().contains(&Argument::Multiplier) =>
            {
                write!(
                    f,
                    "`{function}` is not there where joints follow others (`mimic`): first \
                     derivatives are"
                )
            }
            GenerateError::Follows(function) => write!(
                f,
                "`{function}` has entries of each link, and where joints follow others (`mimic`) \
                 there are more links than coordinates: ask for `forward_kinematics@FRAME` of \
                 frames on links, or `regressor` in place of `full_regressor`"
            ),
            GenerateError::Unexplained(function) => write!(
                f,
                "`{function}` has no steps to explain: none of its results comes from regrouped \
                 parameters; `count` gives its operations"
            ),
            GenerateError::StalePlan { robot } => write!(
                f,
                "the plan beside the robot file no longer fits `{robot}`: a parameter, a limit or a \
                 name was changed since; make it anew with `dalembert generate ROBOT --save-plan` \
                 and the effort that it was made with, or delete it"
            ),
            GenerateError::StaleScene { scene } => write!(
                f,
                "the plan no longer fits the scene `{scene}`: the scene was edited, the robot was \
                 not; make its program anew with `dalembert generate ROBOT --scene {scene} \
                 --save-plan` and the effort that it was made with, or delete the plan"
            ),
            GenerateError::Scene(error) => error.fmt(f),
            GenerateError::Constant {
                function,
                scalar,
                value,
            } => write!(
                f,
                "`{function}` needs the constant {value}, which {scalar} cannot hold: \
                 choose other units{}",
                match scalar {
                    ScalarType::F32 => " or a wider scalar",
                    ScalarType::F64 => "",
                }
            ),
            GenerateError::SinCos(function, why) => write!(f, "`{function}`: {why}"),
            GenerateError::TooLarge { function, outputs } => write!(
                f,
                "`{function}` would return {outputs} numbers: ask for `inverse_dynamics`, \
                 `inertia`, `coriolis` or `gravity` instead"
            ),
            GenerateError::Singular { function, joint } => write!(
                f,
                "`{function}`: D is singular in every state, since {joint} moves no inertia while \
                 the joints after it are free: give what it moves mass or inertia, or the joint \
                 an `armature`, or lock it in a scene"
            ),
            GenerateError::Disproved(function, disproof) => write!(f, "`{function}`: {disproof}"),
            GenerateError::Vanishing(function, value) => write!(
                f,
                "`{function}`: the constant {value} is divisible by 2^61 - 1 or 2^61 - 45, modulo \
                 which search and proof tell values apart: change its last digit"
            ),
            GenerateError::Defect(function, scalar, why) => {
                let scalar = scalar.map_or(String::new(), |scalar| format!(" in {scalar}"));
                write!(
                    f,
                    "`{function}`{scalar}: {why}; please report this defect of dalembert"
                )
            }
            GenerateError::Base(function, why) => write!(f, "`{function}`: {why}"),
            GenerateError::Parameter(why) => why.fmt(f),
            GenerateError::Language(language, why) => write!(f, "`{}`: {why}", language.name()),
            GenerateError::Tolerance(function, why) => write!(f, "`{function}`: {why}"),
            GenerateError::Variant(function, why) => {
                write!(
                    f,
                    "the plan's variant of `{function}`: {why}; make the plan anew with `dalembert \
                     generate ROBOT --scene SCENE --save-plan` and the effort that it was made with, \
                     or delete it"
                )
            }
        }
    }
}

impl std::error::Error for GenerateError {}
