//! Sines and cosines as polynomials: a block an angle, an operation a line.
//!
//! ```text
//! let (s1, c1) = {
//!     let x1 = q[0] * q[0];
//!     …
//!     (x9, -x14)
//! };
//! ```

use std::fmt::Write;

use crate::language::dialect::Dialect;
use crate::program::kernel::{Kernel, Term, Value};

/// Writes the block that computes one angle's sine and cosine; `argument` is how the code names
/// the angle.
pub(super) fn write(
    text: &mut String,
    names: &str,
    argument: &str,
    kernel: &Kernel,
    dialect: Dialect,
) {
    let term = |term: Term| match term {
        Term::Input(_) => argument.to_owned(),
        Term::Constant(value) => dialect.literal(value),
        Term::Step(step) => format!("x{}", step + 1),
    };
    let value = |value: Value| {
        let sign = if value.negative { "-" } else { "" };
        format!("{sign}{}", term(value.value))
    };
    // Writing to a string cannot fail.
    let _ = writeln!(text, "    let {names} = {{");
    for (index, step) in kernel.steps.iter().enumerate() {
        let (left, right) = (term(step.left), term(step.right));
        let (number, symbol) = (index + 1, step.operation.symbol());
        let _ = writeln!(text, "        let x{number} = {left} {symbol} {right};");
    }
    let result = match (kernel.sin, kernel.cos) {
        (Some(sin), Some(cos)) => format!("({}, {})", value(sin), value(cos)),
        (Some(only), None) | (None, Some(only)) => value(only),
        (None, None) => "()".to_owned(),
    };
    let _ = writeln!(text, "        {result}\n    }};");
}
