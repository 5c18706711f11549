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

use super::ScalarType;
use crate::sincos::kernel::{Kernel, Term, Value};
use crate::sincos::{AngleKernel, angle_name, counts};

/// The block that computes one angle's sine and cosine; `argument` is how the
/// code names the angle.
pub(super) fn write(
    text: &mut String,
    names: &str,
    argument: &str,
    kernel: &Kernel,
    scalar: ScalarType,
) {
    let term = |term: Term| match term {
        Term::Angle => argument.to_owned(),
        Term::Literal(value) => literal(value, scalar),
        Term::Step(step) => format!("x{}", step + 1),
    };
    let value = |value: Value| {
        let sign = if value.negative { "-" } else { "" };
        format!("{sign}{}", term(value.term))
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

/// The shortest literal that reads back as the value in the scalar.
fn literal(value: f64, scalar: ScalarType) -> String {
    match scalar {
        ScalarType::F64 => format!("{value:?}"),
        ScalarType::F32 => format!("{:?}", value as f32),
    }
}

/// What a function's documentation says about its sines.
pub(super) fn doc(sines: &[AngleKernel], scalar: ScalarType) -> Vec<String> {
    if sines.is_empty() {
        return Vec::new();
    }
    let (mul, add) = counts(sines);
    let mut lines = vec![
        String::new(),
        format!("Sines and cosines are polynomials, {mul} mul, {add} add, with proved errors:"),
        String::new(),
        "| angle | from | to | error | by |".into(),
        "|---|---|---|---|---|".into(),
    ];
    for sine in sines {
        lines.push(format!(
            "| {} | {:?} | {:?} | {:.1e} | {} |",
            angle_name(sine.angle),
            scalar.nearest(sine.range.low()),
            scalar.nearest(sine.range.high()),
            sine.errors.worst(),
            sine.form
        ));
    }
    lines.push(String::new());
    lines.push(
        "Outside these ranges they are no sines: the error grows with every step away.".into(),
    );
    lines
}
