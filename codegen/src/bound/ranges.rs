//! Overflow: how large each intermediate can become over a box.
//!
//! The intervals are those of the rounding bound, so they contain what is
//! computed, not only what is exact.

use crate::bound::input_box::InputBox;
use crate::bound::sensitivity::{Constants, forward};
use crate::program::{Program, ScalarType};
use crate::sincos::AngleKernel;

/// Sub-boxes for the overflow of a certificate.
pub(crate) const RANGE_BOXES: usize = 256;

/// Says which steps may overflow over a box, from at most `boxes` sub-boxes; sines are
/// libm's where there are no polynomials for them.
pub(crate) fn overflows(
    program: &Program,
    scalar: ScalarType,
    sines: &[AngleKernel],
    limits: &InputBox,
    boxes: usize,
) -> Vec<String> {
    let ids: Vec<_> = program.dag.operations().map(|(id, ..)| id).collect();
    let mut magnitudes = vec![0.0f64; ids.len()];
    let constants = Constants::new(program, scalar, sines);
    for sub in limits.sub_boxes(program, boxes) {
        let run = forward(&constants, &sub);
        for (most, id) in magnitudes.iter_mut().zip(&ids) {
            *most = most.max(run.values[*id as usize].magnitude());
        }
    }
    let largest = scalar.of(f64::MAX, f32::MAX.into());
    let steps = magnitudes.into_iter().enumerate();
    steps
        .filter(|(_, magnitude)| *magnitude > largest)
        .map(|(step, magnitude)| format!("t{} may reach {magnitude:e}: it may overflow", step + 1))
        .collect()
}
