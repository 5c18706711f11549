//! `NAME_batch` and `NAME_columns`: the function at any number of states, by
//! the crate `dalembert-batch`, which asks the processor what it can do.
//!
//! What that needs to know of the function is the type `…Batch`.

use std::fmt::Write;

use super::{Around, arguments, vectors};
use crate::language::c99::largest;
use crate::language::{Printed, function, result};
use crate::program::ScalarType;

/// The largest error of a sine or cosine with fused products, in u: the documentation of
/// `dalembert-sines` proves it.
const FUSED_ERROR: f64 = 0.83;

/// Prints them.
pub(super) fn write(text: &mut String, printed: &Printed<'_>, around: &Around<'_>) {
    let kind = kind(printed);
    let name = printed.function.name();
    marker(text, printed, around, &kind);
    let (n, scalar, batch) = (printed.sizes.joints, printed.code.scalar, around.batch);
    let arguments = arguments(printed);
    let passed = arguments.join(", ");
    let result = function::result_type(printed.function, printed.sizes, scalar);
    let (count, entries) = (arguments.len(), printed.code.outputs.len());
    let taken = vectors::taken(printed.code).count();
    let sizes = format!("{count}, {n}, {entries}, {taken}");
    let parameters = |kind: &str| -> String {
        let each = arguments.iter();
        each.map(|name| format!("{name}: {kind}, ")).collect()
    };
    let bits = match vectors::fuses_sines(printed.code) {
        false => {
            "/// the processor has; bit for bit the results that each has alone, or a NaN for a NaN.".to_owned()
        }
        true => format!(
            "/// the processor has: the same bits on every one, but not those of [`{name}`]. Products are fused\n\
             /// in the sines and cosines as well, which are proved to err by at most {FUSED_ERROR} u, u = {}, up to\n\
             /// {:?} rad; beyond, they are libm's.",
            if scalar == ScalarType::F64 { "2⁻⁵³" } else { "2⁻²⁴" },
            largest(scalar)
        ),
    };
    // Writing to a string cannot fail.
    let _ = writeln!(
        text,
        "\n/// [`{name}`] at any number of states, an entry of every slice each, with the vectors that\n\
         {bits}\n\
         ///\n/// # Errors\n/// The slices are of different lengths; then nothing is computed.\n\
         pub fn {name}_batch({}results: &mut [{result}]) -> Result<(), {batch}::Unequal> {{\n    \
         {batch}::states::<{kind}, {sizes}>([{passed}], results)\n}}",
        parameters(&format!("&[[{scalar}; {n}]]")),
    );
    let _ = writeln!(
        text,
        "\n/// [`{name}_batch`] with states in columns: a slice for every entry of an argument, and of\n\
         /// the result in the order of its text. No number has to be moved: it is the faster one.\n\
         ///\n/// # Errors\n/// The slices are of different lengths; then nothing is computed.\n\
         pub fn {name}_columns({}results: &mut [&mut [{scalar}]; {entries}]) -> Result<(), {batch}::Unequal> {{\n    \
         {batch}::columns::<{kind}, {sizes}>([{passed}], results)\n}}",
        parameters(&format!("&[&[{scalar}]; {n}]")),
    );
}

/// Returns the type of a function: `InverseDynamicsBatch`.
fn kind(printed: &Printed<'_>) -> String {
    format!("{}Batch", printed.function.camel())
}

fn marker(text: &mut String, printed: &Printed<'_>, around: &Around<'_>, kind: &str) {
    let (name, n, scalar, batch) = (
        printed.function.name(),
        printed.sizes.joints,
        printed.code.scalar,
        around.batch,
    );
    let (count, entries) = (printed.arguments.len(), printed.code.outputs.len());
    let taken = vectors::taken(printed.code).count();
    let result = function::result_type(printed.function, printed.sizes, scalar);
    // Writing to a string cannot fail.
    let _ = writeln!(
        text,
        "/// [`{name}`] as the functions of `dalembert-batch` take it.\n\
         #[derive(Clone, Copy, Debug)]\npub struct {kind};\n\n\
         impl {batch}::Function<{count}, {n}, {entries}, {taken}> for {kind} {{\n    \
         type Scalar = {scalar};\n    type State = {result};"
    );
    if vectors::fuses_sines(printed.code) {
        text.push_str("    const FUSED: bool = true;\n");
    }
    text.push('\n');
    vectors::write(text, printed, around);
    let _ = writeln!(
        text,
        "    #[inline(always)]\n    fn state(results: [{scalar}; {entries}]) -> {result} {{"
    );
    let (function, sizes) = (printed.function, printed.sizes);
    let items = (0..entries).map(|index| format!("results[{index}]"));
    result::write(text, function, function.structure(), sizes, items);
    text.push_str("    }\n}\n");
}
