//! Why a certificate is no good.

use std::fmt;

use dalembert_model::scene::Scale;

use super::work::TooMuch;
use crate::bound::definite::Indefinite;
use crate::bound::ranges::Finding;
use crate::edits::BadEdit;
use crate::language::read::TextError;
use crate::sincos::proof::Errors;
use crate::split::ErrorByCause;
use crate::states::JointState;
use crate::verify::exact::Disproof;

/// Why a program may not read an input.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WrongInput {
    /// The joint does not exist.
    NoJoint,
    /// The position of a joint that turns: only its sine and cosine are values.
    Turns,
    /// The sine or cosine of a joint that slides.
    Slides,
    /// The joint is locked: its entries are not read.
    Locked,
    /// What Coulomb friction reads of speeds, which rounds more than is bounded.
    Friction,
    /// The argument is none of the function's in this scene.
    NoArgument,
}

impl fmt::Display for WrongInput {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            WrongInput::NoJoint => "the robot has no such joint",
            WrongInput::Turns => "the joint turns: only its sine and cosine may be read",
            WrongInput::Slides => "the joint slides: it has no sine or cosine",
            WrongInput::Locked => "the joint is locked: its entries may not be read",
            WrongInput::Friction => "no bound is known of what Coulomb friction reads of speeds",
            WrongInput::NoArgument => "the function has no such argument in this scene",
        })
    }
}

/// Why a certificate is no good.
#[derive(Clone, Debug, PartialEq)]
pub enum Refuted {
    /// It is for another robot.
    Robot,
    /// It is for another scene, or for the scene as it was.
    Scene,
    /// Its box is smaller than the scene's.
    Box,
    /// Its T is larger than what it says that it is.
    Scale {
        /// The output's name.
        entry: String,
    },
    /// It claims more of an output than the tolerance allows, or
    /// against another scale.
    Tolerance {
        /// The output's name.
        entry: String,
        /// What is allowed, and relative to what.
        allowed: (f64, Scale),
        /// What is claimed, and relative to what.
        claimed: (f64, Option<Scale>),
    },
    /// A list has not as many entries as there are outputs or joints, or a
    /// step reads one that is not before it.
    Shape,
    /// It takes more work than a check may.
    Work(TooMuch),
    /// A program is not of the function that the claim is about, as the scene
    /// leaves it.
    Signature {
        /// Which program.
        program: String,
        /// What is not as it should be.
        what: &'static str,
    },
    /// Products are fused that the generator does not fuse, or others than it does.
    Fused,
    /// A program reads what it may not.
    Input {
        /// Which program.
        program: String,
        /// What it reads.
        input: String,
        /// Why it may not.
        why: WrongInput,
    },
    /// The exact program is not the formula.
    Exact(Disproof),
    /// Edits cannot be applied.
    Edits(usize, BadEdit),
    /// A stage's edited program is not what follows.
    Step(usize),
    /// The text is not what is printed of the emitted program and its sines.
    Text {
        /// The first line that differs, from one.
        line: usize,
        /// What should be there; nothing after the end.
        expected: String,
        /// What is there.
        found: String,
    },
    /// The polynomials are not of the angles that the program reads.
    Polynomials {
        /// The angle.
        angle: String,
    },
    /// A polynomial's range is not all that its angle takes in the box.
    SineRange {
        /// The angle.
        angle: String,
    },
    /// A polynomial is further from its sine than is claimed.
    Sine {
        /// The angle.
        angle: String,
        /// What is claimed.
        claimed: Errors,
        /// What can be shown, if anything can.
        found: Option<Errors>,
    },
    /// The scalar cannot hold a value.
    Range(Finding),
    /// A claim is smaller than what can be shown.
    Bound {
        /// The output's name.
        entry: String,
        /// What is claimed.
        claimed: ErrorByCause,
        /// What was found.
        found: ErrorByCause,
    },
    /// The text is as printed, but cannot be read: a defect of this library.
    Unreadable(Box<TextError>),
    /// Where the text was run, it errs more than is claimed.
    Ran {
        /// The output's name.
        entry: String,
        /// How far it is off, in its unit.
        error: f64,
        /// E·T.
        bound: f64,
        /// Where.
        state: Box<JointState>,
    },
    /// D cannot be shown to be positive definite.
    Indefinite(Indefinite),
    /// The least eigenvalue is claimed to be larger than what can be shown,
    /// or not claimed at all.
    Eigenvalue {
        /// What is claimed; zero if nothing.
        claimed: f64,
        /// What was found.
        found: f64,
    },
}

impl fmt::Display for Refuted {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Refuted::Robot => f.write_str("the certificate is for another robot"),
            Refuted::Scene => f.write_str(
                "the certificate is for another scene, or for the scene before it was edited",
            ),
            Refuted::Box => f.write_str("the box is smaller than the scene's"),
            Refuted::Scale { entry } => {
                write!(f, "T of {entry} is larger than what it is said to be")
            }
            Refuted::Tolerance {
                entry,
                allowed,
                claimed,
            } => {
                let of = claimed.1.map_or("scales of its own", |scale| scale.word());
                write!(
                    f,
                    "{entry}: claimed {:e} relative to {of}; {:e} relative to {} is allowed",
                    claimed.0,
                    allowed.0,
                    allowed.1.word()
                )
            }
            Refuted::Shape => f.write_str(
                "the certificate is malformed: a list has the wrong length, or a step reads a step that does \
                 not come before it",
            ),
            Refuted::Work(much) => much.fmt(f),
            Refuted::Signature { program, what } => {
                write!(
                    f,
                    "the {what} of {program} is not that of the function in this scene"
                )
            }
            Refuted::Fused => f.write_str(
                "the fused products are not those of the emitted program by the generator's rule",
            ),
            Refuted::Input {
                program,
                input,
                why,
            } => write!(f, "{program} reads `{input}`: {why}"),
            Refuted::Exact(disproof) => write!(f, "the exact program: {disproof}"),
            Refuted::Edits(stage, bad) => write!(f, "stage {}: {bad}", stage + 1),
            Refuted::Step(stage) => write!(
                f,
                "stage {}: the edited program is not the one that follows",
                stage + 1
            ),
            Refuted::Indefinite(why) => why.fmt(f),
            Refuted::Eigenvalue { claimed, found } => write!(
                f,
                "lambda_min: claimed {claimed:e}; what can be shown is {found:e}"
            ),
            Refuted::Text {
                line,
                expected,
                found,
            } => write!(
                f,
                "line {line} of the printed text is `{found}`; \
                 of the emitted program it would be `{expected}`"
            ),
            Refuted::Polynomials { angle } => write!(
                f,
                "the polynomials of {angle} are not those of one angle that the program reads"
            ),
            Refuted::SineRange { angle } => write!(
                f,
                "the polynomials of {angle} are not for all values that it takes in the box"
            ),
            Refuted::Sine {
                angle,
                claimed,
                found: None,
            } => write!(
                f,
                "the sine and cosine of {angle}: claimed {:e} and {:e}; nothing can be shown",
                claimed.sin, claimed.cos
            ),
            Refuted::Sine {
                angle,
                claimed,
                found: Some(found),
            } => write!(
                f,
                "the sine and cosine of {angle}: claimed {:e} and {:e}; \
                 what can be shown is {:e} and {:e}",
                claimed.sin, claimed.cos, found.sin, found.cos
            ),
            Refuted::Unreadable(why) => write!(f, "the printed text cannot be read: {why}"),
            Refuted::Ran {
                entry,
                error,
                bound,
                state,
            } => write!(
                f,
                "{entry} is {error:.3e} off where it was run, and E allows {bound:.3e}: \
                 q = {:?}, qd = {:?}, qdd = {:?}",
                state.q, state.qd, state.qdd
            ),
            Refuted::Range(finding) => write!(f, "{finding}"),
            Refuted::Bound {
                entry,
                claimed,
                found,
            } => write!(
                f,
                "{entry}: claimed model {:e}, sincos {:e}, rounding {:e}; \
                 what can be shown is {:e}, {:e}, {:e}",
                claimed.model,
                claimed.sincos,
                claimed.rounding,
                found.model,
                found.sincos,
                found.rounding
            ),
        }
    }
}

impl std::error::Error for Refuted {}
