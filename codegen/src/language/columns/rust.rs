//! `NAME_columns`: the function at any number of states, by the crate `dalembert-batch`, which
//! asks the processor what vectors it has.
//!
//! The type `…Batch` tells that crate about the function.

use std::fmt::Write;

use super::vectors;
use crate::language::Printed;
use crate::language::c99::largest;
use crate::language::trig;

/// The largest error of a sine or cosine with fused products, in u: the documentation of
/// `dalembert-sines` proves it.
const FUSED_ERROR: f64 = 0.83;

/// Prints the function of columns, and the type that it is computed by.
pub(crate) fn columns(printed: &Printed<'_>) -> String {
    let name = printed.function.name();
    let kind = format!("{}Batch", printed.function.camel());
    let (n, scalar) = (printed.sizes.joints, printed.code.scalar);
    let arguments = printed.arguments.iter().map(|argument| argument.name());
    let arguments: Vec<&str> = arguments.collect();
    let (count, entries) = (arguments.len(), printed.code.dag.outputs.len());
    let taken = trig::taken(printed.code).count();
    let sizes = format!("{count}, {n}, {entries}, {taken}");
    let bits = match vectors::fuses_sines(printed.code) {
        false => {
            "/// the processor has; bit for bit the results that each has alone, or a NaN for a NaN.".to_owned()
        }
        true => format!(
            "/// the processor has: the same bits on every one, but not those of [`{name}`]. Products are fused\n\
             /// in the sines and cosines as well, which are proved to err by at most {FUSED_ERROR} u, u = {}, up to\n\
             /// {:?} rad; beyond, they are libm's.",
            scalar.of("2⁻⁵³", "2⁻²⁴"),
            largest(scalar)
        ),
    };
    let mut text = format!(
        "/// [`{name}`] as the functions of `dalembert-batch` take it.\n\
         #[derive(Clone, Copy, Debug)]\npub struct {kind};\n\n\
         impl dalembert_batch::Function<{sizes}> for {kind} {{\n    \
         type Scalar = {scalar};\n"
    );
    if vectors::fuses_sines(printed.code) {
        text.push_str("    const FUSED: bool = true;\n");
    }
    text.push('\n');
    vectors::write(&mut text, printed);
    let parameters = arguments.iter();
    let parameters: String = parameters
        .map(|name| format!("{name}: &[&[{scalar}]; {n}], "))
        .collect();
    // Writing to a string cannot fail.
    let _ = writeln!(
        text,
        "}}\n\n/// [`{name}`] at any number of states in columns: a slice for every entry of an argument, and of\n\
         /// the result in the order of its text. It is computed with the vectors that\n\
         {bits}\n\
         ///\n/// # Errors\n/// The slices are of different lengths; then nothing is computed.\n\
         pub fn {name}_columns({parameters}results: &mut [&mut [{scalar}]; {entries}]) -> Result<(), dalembert_batch::Unequal> {{\n    \
         dalembert_batch::columns::<{kind}, {sizes}>([{}], results)\n}}",
        arguments.join(", "),
    );
    text
}
