//! Polynomials for sines, in the words of a function's documentation.

use super::figures::bound_of;
use super::say;
use crate::program::{Counts, ScalarType};
use crate::sincos::AngleKernel;

/// Returns what a function's documentation says about its sines.
pub(super) fn doc(sines: &[AngleKernel], scalar: ScalarType) -> Vec<String> {
    if sines.is_empty() {
        return Vec::new();
    }
    let counts = Counts::default().with_kernels(sines.iter().map(|own| &own.kernel));
    let (mul, add) = (counts.trig_mul, counts.trig_add);
    let what =
        format!("Sines and cosines are polynomials, {mul} mul, {add} add, with proved errors:");
    let mut lines = Vec::new();
    let head = "| angle | from | to | error | by |";
    say(&mut lines, ["", &what, "", head, "|---|---|---|---|---|"]);
    for sine in sines {
        lines.push(format!(
            "| q{} | {:?} | {:?} | {} | {} |",
            sine.joint + 1,
            scalar.above(sine.range.low()),
            -scalar.above(-sine.range.high()),
            bound_of(sine.errors.worst(), 2),
            sine.form
        ));
    }
    let outside = [
        "",
        "Outside these ranges they are no sines: the error grows with every step away. Ask",
        "[`in_box`] whether a state is inside.",
    ];
    say(&mut lines, outside);
    lines
}
