//! Sines and cosines in a header of C or CUDA, by the operations of the crate `dalembert-sines`.

use std::collections::BTreeSet;

use dalembert_sines::text::Angle;

use crate::language::c99::{Names, float, largest};
use crate::language::called::SineCall;
use crate::language::dialect::{Dialect, Lines};
use crate::program::kernel::Kernel;
use crate::program::{Code, Library, Literal};
use crate::sincos::routine::routine;

/// Several angles get a loop that compilers make vectors of; functions of many states take one.
pub(super) fn write<'c>(
    text: &mut String,
    functions: impl Iterator<Item = (usize, &'c Code)>,
    names: &Names,
    is_batch: bool,
) {
    let (mut counts, mut is_alone) = (BTreeSet::new(), false);
    for (joints, code) in functions {
        match SineCall::of(code, joints, names, is_batch) {
            Some(called) => _ = counts.insert(called.angles.len()),
            None => is_alone |= code.library == Library::Together,
        }
    }
    if is_alone {
        text.push_str(&one(names));
    }
    for count in counts {
        text.push_str(&several(names, count));
    }
}

fn operations(dialect: Dialect, margin: &str) -> (String, [String; 2]) {
    let kernel: Kernel = routine(dialect.scalar);
    let lines = Lines::of_kernel(dialect, &kernel, "x0", "x");
    let steps = lines.statements().map(|line| format!("{margin}{line}\n"));
    let name = |edge: Option<_>| edge.map_or_else(String::new, |edge| lines.result(edge));
    (steps.collect(), kernel.results().map(name))
}

/// The loop has no branch and no integer, of which gcc makes vectors for every processor; clang
/// keeps results in memory if it is not inlined, which is shorter than taking vectors apart.
fn several(names: &Names, count: usize) -> String {
    let dialect = names.dialect();
    let (float, f) = (float(dialect.scalar), dialect.scalar.math_suffix());
    let (inline, largest) = (dialect.function, largest(dialect.scalar));
    let (steps, [sine, cosine]) = operations(dialect, "        ");
    let shift = dialect.scalar.of(f64::SHIFT, f32::SHIFT.into());
    let [largest, shift, one, four, fourth] =
        [largest, shift, 1.0, 4.0, 0.25].map(|value| dialect.literal(Literal(value)));
    let (restrict, unfused) = (names.constant("RESTRICT"), names.constant("UNFUSED"));
    let name = SineCall::name(count, names);
    let angles = if count == 1 { "angle" } else { "angles" };
    format!(
        "\n/*\n * Sines and cosines of {count} {angles}, each within one ulp: to {largest} rad the operations of the\n \
         * Rust crate dalembert-sines, to the same bits; beyond, and for what is no number, the C\n \
         * library's.\n */\n\
         #if defined(__clang__)\n__attribute__((noinline))\n#endif\n\
         {inline} void {name}(const {float} angle[{restrict} {count}], \
         {float} sine[{restrict} {count}], {float} cosine[{restrict} {count}])\n{{\n    {unfused}\n    \
         int i;\n    for (i = 0; i < {count}; ++i) {{\n        \
         const {float} x0 = angle[i];\n{steps}        \
         /* x3 counts the quarter turns: turns is what a multiple of four leaves, -2 to 2. */\n        \
         const {float} whole = ((x3 * {fourth}) + {shift}) - {shift};\n        \
         const {float} turns = x3 - (whole * {four});\n        \
         const {float} square = turns * turns;\n        \
         /* An odd one exchanges sine and cosine. */\n        \
         const {float} one = (square == {one}) ? {cosine} : {sine};\n        \
         const {float} other = (square == {one}) ? {sine} : {cosine};\n        \
         sine[i] = (turns >= square) ? one : -one;\n        \
         cosine[i] = (-turns >= square) ? other : -other;\n    }}\n    \
         for (i = 0; i < {count}; ++i) {{\n        \
         if (!(fabs{f}(angle[i]) <= {largest})) {{\n            \
         sine[i] = sin{f}(angle[i]);\n            cosine[i] = cos{f}(angle[i]);\n        }}\n    }}\n}}\n"
    )
}

fn one(names: &Names) -> String {
    let dialect = names.dialect();
    let (float, f) = (float(dialect.scalar), dialect.scalar.math_suffix());
    let (inline, largest) = (dialect.function, largest(dialect.scalar));
    let (steps, [sine, cosine]) = operations(dialect, "    ");
    let [largest, zero] = [largest, 0.0].map(|value| dialect.literal(Literal(value)));
    let [kind, function] = ["sincos_t", "sincos"].map(|word| names.of(word));
    let unfused = names.constant("UNFUSED");
    format!(
        "\n/* The sine and the cosine of an angle. */\n\
         typedef struct {{\n    {float} sin;\n    {float} cos;\n}} {kind};\n\n\
         /*\n * Sine and cosine, each within one ulp: to {largest} rad the operations of the Rust crate\n \
         * dalembert-sines, to the same bits; beyond, and for what is no\n * number, the C library's, where angles may be far.\n */\n\
         {inline} {kind} {function}(const int far, const {float} angle)\n{{\n    {unfused}\n    \
         const {float} x0 = (fabs{f}(angle) <= {largest}) ? angle : {zero};\n{steps}    \
         /* x3 counts the quarter turns: an odd one exchanges sine and cosine. */\n    \
         const unsigned int turns = (unsigned int)(int)x3;\n    \
         const {float} one = ((turns & 1U) == 0U) ? {sine} : {cosine};\n    \
         const {float} other = ((turns & 1U) == 0U) ? {cosine} : {sine};\n    \
         {kind} pair;\n    \
         pair.sin = ((turns & 2U) == 0U) ? one : -one;\n    \
         pair.cos = (((turns + 1U) & 2U) == 0U) ? other : -other;\n    \
         if ((far != 0) && !(fabs{f}(angle) <= {largest})) {{\n        \
         pair.sin = sin{f}(angle);\n        pair.cos = cos{f}(angle);\n    }}\n    \
         return pair;\n}}\n"
    )
}
