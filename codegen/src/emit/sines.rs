//! Polynomials for sines, in the words of a function's documentation.

use super::figures::bound_of;
use crate::program::{Counts, ScalarType};
use crate::sincos::AngleKernel;

/// Returns what a function's documentation says about its sines.
pub(super) fn doc(sines: &[AngleKernel], scalar: ScalarType) -> Vec<String> {
    if sines.is_empty() {
        return Vec::new();
    }
    let counts = Counts::default().with_kernels(sines.iter().map(|own| &own.kernel));
    let (mul, add) = (counts.trig_mul, counts.trig_add);
    let mut lines = vec![
        String::new(),
        format!("Sines and cosines are polynomials, {mul} mul, {add} add, with proved errors:"),
        String::new(),
        "| angle | from | to | error | by |".into(),
        "|---|---|---|---|---|".into(),
    ];
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
    lines.push(String::new());
    lines.push(
        "Outside these ranges they are no sines: the error grows with every step away. Ask".into(),
    );
    lines.push("[`in_box`] whether a state is inside.".into());
    lines
}
