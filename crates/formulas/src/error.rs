//! The reasons why a robot has no formulas.

use dalembert_codegen::Diagnostic;

use crate::ring::{MAX_JOINTS, MAX_LENGTHS, MAX_TERMS};

pub(crate) fn floating() -> Diagnostic {
    Diagnostic::error("formulas need a robot with a fixed base, and this base floats").with_help(
        "import it without --floating, or hold the base in a scene: lock = { base = \"level\" }",
    )
}

pub(crate) fn many_joints(joints: usize) -> Diagnostic {
    Diagnostic::error(format!(
        "formulas are written for at most {MAX_JOINTS} joints, and {joints} move"
    ))
    .with_help("import one limb (--tip), or lock joints in a scene")
}

pub(crate) fn many_lengths(lengths: usize) -> Diagnostic {
    Diagnostic::error(format!(
        "{lengths} lengths are not zero, and at most {MAX_LENGTHS} can be symbols"
    ))
    .with_help("--with numbers")
}

/// `joint` counts from zero.
pub(crate) fn far_follower(joint: usize) -> Diagnostic {
    Diagnostic::error(format!(
        "the joints that follow joint {} turn more than 6 times as far: their sines are of a \
         degree that formulas do not support",
        joint + 1
    ))
}

pub(crate) fn unfit() -> Diagnostic {
    Diagnostic::error(
        "a number's denominator is divisible by 2^61 - 1, modulo which zeros are found",
    )
    .with_help("change its last digit")
}

pub(crate) fn large() -> Diagnostic {
    Diagnostic::error(format!(
        "a coefficient has more than {MAX_TERMS} products of sines and cosines: each joint of a \
         limb, and each odd angle between two, multiplies them"
    ))
    .with_help(
        "lock joints in a scene, or import fewer of them; write angles that are multiples of pi/2 \
         as such",
    )
}

pub(crate) fn rows() -> Diagnostic {
    Diagnostic::error(
        "`tau` and `T` have terms of all joints that move, and the scene's `joints` are others",
    )
    .with_help("leave `joints` out of the scene")
}

pub(crate) fn nothing() -> Diagnostic {
    Diagnostic::error("no joint moves: there are no formulas")
}
