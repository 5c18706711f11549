//! The reasons why a robot has no formulas.

use std::error::Error;
use std::fmt;

use crate::ring::{MAX_JOINTS, MAX_LENGTHS, MAX_TERMS};

/// The reason why formulas of a robot cannot be written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum FormulaError {
    /// Its base floats.
    Floating,
    /// So many joints move.
    ManyJoints(usize),
    /// So many lengths are not zero, where lengths are symbols.
    ManyLengths(usize),
    /// Joints that follow this one, counted from zero, turn too often for a turn of it.
    FarFollower(usize),
    /// A number's denominator is divisible by 2⁶¹ − 1.
    Unfit,
    /// A coefficient has too many terms.
    Large,
    /// Torques or an energy are asked for, and the scene's results are not over all joints that move.
    Rows,
    /// No joint moves.
    Nothing,
    /// The scene is not one of the robot.
    Scene(String),
}

impl fmt::Display for FormulaError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            FormulaError::Floating => f.write_str(
                "formulas are written for a robot that stands on its base, and this base floats\n  \
                 = help: import it without --floating, or hold the base in a scene: lock = { base = \"level\" }",
            ),
            FormulaError::ManyJoints(joints) => write!(
                f,
                "formulas are written for at most {MAX_JOINTS} joints, and {joints} move\n  = help: \
                 import one limb (--tip), or lock joints in a scene"
            ),
            FormulaError::ManyLengths(lengths) => write!(
                f,
                "{lengths} lengths are not zero, and at most {MAX_LENGTHS} can be symbols\n  = help: \
                 --with numbers"
            ),
            FormulaError::FarFollower(joint) => write!(
                f,
                "the joints that follow joint {} turn more than 6 times as far: their sines are of a \
                 degree that formulas do not hold",
                joint + 1
            ),
            FormulaError::Unfit => f.write_str(
                "a number's denominator is divisible by 2^61 - 1, modulo which zeros are found\n  = \
                 help: change its last digit",
            ),
            FormulaError::Large => write!(
                f,
                "a coefficient has more than {MAX_TERMS} products of sines and cosines: each joint of a limb, and each \
                 odd angle between two, multiplies them\n  = help: lock joints in a scene, or import fewer of them; \
                 write angles that are multiples of pi/2 as such"
            ),
            FormulaError::Rows => f.write_str(
                "`tau` and `T` have terms of all joints that move, and the scene's `joints` are others\n  = help: \
                 leave `joints` out of the scene",
            ),
            FormulaError::Nothing => f.write_str("no joint moves: there are no formulas"),
            FormulaError::Scene(why) => f.write_str(why),
        }
    }
}

impl Error for FormulaError {}
