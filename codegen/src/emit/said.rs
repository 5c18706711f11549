//! The documentation of a function about its sines, Coulomb friction and fused products:
//! nothing where there are none.

use super::{GeneratedFunction, paragraph};
use crate::figures::{bound_of, decimal};
use crate::function::Argument;
use crate::language::list;
use crate::program::{Counts, Loop, Program, ScalarType};
use crate::setup::Setup;
use crate::sincos::AngleKernel;

pub(super) fn sines(sines: &[AngleKernel], scalar: ScalarType) -> Vec<String> {
    if sines.is_empty() {
        return Vec::new();
    }
    let counts = Counts::default().with_kernels(sines.iter().map(|sine| &sine.kernel));
    let (mul, add) = (counts.trig_mul, counts.trig_add);
    let what =
        format!("Sines and cosines are polynomials, {mul} mul, {add} add, with proved errors:");
    let mut lines = Vec::new();
    let head = "| angle | from | to | error | by |";
    lines.extend(paragraph(["", &what, "", head, "|---|---|---|---|---|"]));
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
    lines.extend(paragraph([
        "",
        "Outside these ranges they are no sines: the error grows with every step away. Ask",
        "[`in_box`] whether a state is inside.",
    ]));
    lines
}

pub(super) fn friction(generated: &GeneratedFunction, setup: &Setup) -> Vec<String> {
    let program = &generated.program;
    if program.speeds.is_empty() {
        return Vec::new();
    }
    let arguments = generated.function.arguments();
    let wished = arguments.contains(&Argument::ReferenceVelocity);
    let speed = if wished { "v_i" } else { "q̇_i" };
    let friction =
        format!("friction is F_i {speed}/√(q̇_i² + w_i²). In the proof each r_i is a variable.");
    let mut lines = Vec::from(paragraph([
        "",
        "With Coulomb friction: b_i stands for b_i + F_i r_i, r_i = 1/√(q̇_i² + w_i²), so that the",
        &friction,
        "",
        "| joint | F | w |",
        "|---|---|---|",
    ]));
    for speed in &program.speeds {
        let Some(index) = setup.robot().joint_of(speed.coordinate) else {
            continue;
        };
        let joint = &setup.robot().joints[index];
        let (force, width) = (decimal(&joint.coulomb), decimal(&joint.coulomb_width));
        lines.push(format!("| {} | {force} | {width} |", index + 1));
    }
    lines
}

/// Says what the loops of the text are.
pub(super) fn lanes(program: &Program) -> Vec<String> {
    if program.loops.is_empty() {
        return Vec::new();
    }
    let shape = |block: &Loop| format!("{} lanes of {} operations", block.lanes, block.rows);
    let shapes = list(program.loops.iter().map(shape));
    Vec::from(paragraph([
        "",
        &format!("Limbs of one structure are lanes of loops: {shapes}. A compiler"),
        "makes vectors of them, with the bits of their operations one after the other.",
    ]))
}

pub(super) fn fused(program: &Program) -> Vec<String> {
    if !program.fuses() {
        return Vec::new();
    }
    Vec::from(paragraph([
        "",
        "A product and the sum that alone reads it are one operation, fma, rounded once; the t of",
        "that product is left out. `mul_add` needs `std`, and a build for a processor that has it",
        "(`-C target-cpu=native`, or `-C target-feature=+fma`): any other calls a function for each,",
        "slower by far than a product and a sum, with the same bits.",
    ]))
}
