//! What Coulomb friction reads of speeds, after the sines: one over the smoothed
//! speed of a joint.
//!
//! ```text
//! let r2 = 1.0 / libm::sqrt(qd[1] * qd[1] + 0.0001);
//! ```

use std::fmt::Write;

use crate::program::text::input_name;
use crate::program::{Input, Lowered};

/// Prints those that are read. Roots are correctly rounded, whoever computes them.
pub(super) fn write(text: &mut String, code: &Lowered, path: &str) {
    let (scalar, suffix) = (code.scalar, code.scalar.math_suffix());
    for own in &code.speeds {
        let (name, joint) = (input_name(Input::PerSpeed(own.joint)), own.joint);
        let square = own.square.text(scalar);
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "    let {name} = 1.0 / {path}::sqrt{suffix}(qd[{joint}] * qd[{joint}] + {square});"
        );
    }
}
