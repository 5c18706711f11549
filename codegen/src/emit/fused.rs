//! Products that are fused with sums, in the words of a function's documentation.

use crate::program::Program;

/// Returns what a function's documentation says of them, if it has any.
pub(super) fn doc(program: &Program) -> Vec<String> {
    if !program.fuses() {
        return Vec::new();
    }
    let lines = [
        "",
        "A product and the sum that alone reads it are one operation, fma, rounded once; the t of",
        "that product is left out. `mul_add` needs `std`, and a build for a processor that has it",
        "(`-C target-cpu=native`, or `-C target-feature=+fma`): any other calls a function for each,",
        "slower by far than a product and a sum, with the same bits.",
    ];
    lines.map(String::from).to_vec()
}
