//! Why a certificate is no good.

use std::fmt;

use dalembert_model::scene::Scale;

use super::split::Split;
use crate::certify::definite::Indefinite;
use crate::certify::edits::BadEdit;
use crate::certify::ranges::Finding;
use crate::sincos::proof::Errors;
use crate::verify::exact::Disproof;

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
    /// It claims more of an output than its scene's tolerance allows, or
    /// against another scale.
    Tolerance {
        /// The output's name.
        entry: String,
        /// What the scene allows, and relative to what.
        allowed: (f64, Scale),
        /// What is claimed, and relative to what.
        claimed: (f64, Option<Scale>),
    },
    /// A list has not as many entries as there are outputs or joints.
    Shape,
    /// The exact program is not the formula.
    Exact(Disproof),
    /// Edits cannot be applied.
    Edits(usize, BadEdit),
    /// A stage's edited program is not what follows.
    Step(usize),
    /// The text is not the emitted program.
    Text(String),
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
        claimed: Split,
        /// What was found.
        found: Split,
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
                    "{entry}: claimed {:e} relative to {of}; the scene allows {:e} relative to {}",
                    claimed.0,
                    allowed.0,
                    allowed.1.word()
                )
            }
            Refuted::Shape => f.write_str("a list is not as long as it should be"),
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
            Refuted::Text(why) => write!(f, "the printed text: {why}"),
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
