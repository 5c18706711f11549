//! Reasons why a plan's variant is none.

use std::fmt;

use super::work::TooMuch;

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

/// A reason why a plan's variant is none.
#[derive(Clone, Debug, PartialEq)]
pub enum Refuted {
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
    /// A program reads what it may not.
    Input {
        /// Which program.
        program: String,
        /// What it reads.
        input: String,
        /// Why it may not.
        why: WrongInput,
    },
}

impl fmt::Display for Refuted {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Refuted::Shape => f.write_str(
                "the variant is malformed: a list has the wrong length, or a step reads a step that does \
                 not come before it",
            ),
            Refuted::Work(much) => much.fmt(f),
            Refuted::Signature { program, what } => {
                write!(
                    f,
                    "the {what} of {program} is not that of the function in this scene"
                )
            }
            Refuted::Input {
                program,
                input,
                why,
            } => write!(f, "{program} reads `{input}`: {why}"),
        }
    }
}

impl std::error::Error for Refuted {}
