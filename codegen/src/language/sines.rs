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

use crate::language::dialect::{Dialect, Lines};
use crate::program::kernel::Kernel;

/// Writes the block that computes one angle's sine and cosine; `argument` is how the code names
/// the angle.
pub(super) fn write(
    text: &mut String,
    names: &str,
    argument: &str,
    kernel: &Kernel,
    dialect: Dialect,
) {
    let lines = Lines::of_kernel(dialect, kernel, argument, "x");
    // Writing to a string cannot fail.
    let _ = writeln!(text, "    let {names} = {{");
    for line in lines.statements() {
        let _ = writeln!(text, "        {line}");
    }
    let results: Vec<String> = lines.results().collect();
    let result = match results.as_slice() {
        [only] => only.clone(),
        results => format!("({})", results.join(", ")),
    };
    let _ = writeln!(text, "        {result}\n    }};");
}
