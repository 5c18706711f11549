//! What Coulomb friction reads of speeds, after the sines: one over the smoothed
//! speed of a joint.
//!
//! ```text
//! let r2 = 1.0 / libm::sqrt(qd[1] * qd[1] + 0.0001);
//! ```

use std::fmt::Write;

use crate::backend::MathPath;
use crate::program::text::input_name;
use crate::program::{Input, Program, ScalarType};

/// Prints those that are read. Roots are correctly rounded, whoever computes them.
pub(super) fn write(text: &mut String, program: &Program, scalar: ScalarType, math: &MathPath) {
    let (path, suffix) = (&math.path, scalar.math_suffix());
    for own in &program.speeds {
        let (name, joint) = (input_name(Input::PerSpeed(own.joint)), own.joint);
        let square = scalar.literal(&own.square);
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "    let {name} = 1.0 / {path}::sqrt{suffix}(qd[{joint}] * qd[{joint}] + {square});"
        );
    }
}
