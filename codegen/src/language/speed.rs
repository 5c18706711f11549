//! What Coulomb friction reads of speeds, after the sines: one over the smoothed
//! speed of a joint.
//!
//! ```text
//! let r2 = 1.0 / libm::sqrt(qd[1] * qd[1] + 0.0001);
//! ```

use std::fmt::Write;

use crate::language::dialect::Dialect;
use crate::program::{Code, Input, Literal, Operation};

/// Prints those that are read. Roots are correctly rounded, whoever computes them.
pub(super) fn write(text: &mut String, dialect: Dialect, code: &Code, path: &str) {
    let one = dialect.literal(Literal(1.0));
    for own in &code.speeds {
        let (name, joint) = (Input::PerSpeed(own.joint).name(), own.joint);
        let square = dialect.literal(own.square);
        let speed = format!("qd[{joint}]");
        let product = dialect.operation(Operation::Mul, &speed, &speed);
        let sum = format!("{product} + {square}");
        let value = format!("{one} / {}", dialect.call(path, "sqrt", &sum));
        // Writing to a string cannot fail.
        let _ = writeln!(text, "    {}", dialect.declare(&name, &value));
    }
}
