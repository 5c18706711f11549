//! `NAME`: sines, then the function that takes them.
//!
//! ```text
//! pub fn gravity(q: &[f64; 2]) -> [f64; 2] {
//!     let (s1, c1) = libm::sincos(q[0]);
//!     gravity_with_sincos(q, &[s1, 0.0], &[c1, 0.0])
//! }
//! ```

use std::fmt::Write;

use super::{Around, arguments};
use crate::backend::{function, trig};
use crate::program::Program;
use crate::sincos::AngleKernel;

/// Prints it.
pub(super) fn write(
    text: &mut String,
    program: &Program,
    around: &Around<'_>,
    sines: &[AngleKernel],
    doc: &[String],
) {
    let (name, scalar) = (program.function.name(), around.scalar);
    let arguments = arguments(program);
    let parameters = program.arguments.iter().map(|&argument| {
        let kind = function::argument_type(program, argument, scalar);
        format!("{}: &{kind}", argument.name())
    });
    let parameters: Vec<String> = parameters.collect();
    let result = function::result_type(program, scalar);
    function::write_doc(text, doc);
    // Writing to a string cannot fail.
    let _ = writeln!(
        text,
        "#[must_use]\npub fn {name}({}) -> {result} {{",
        parameters.join(", ")
    );
    trig::write(text, program, scalar, around.math, sines);
    let sin = around.angles.array(&program.trig, |trig| {
        trig.sin.then(|| format!("s{}", trig.angle))
    });
    let cos = around.angles.array(&program.trig, |trig| {
        trig.cos.then(|| format!("c{}", trig.angle))
    });
    let arguments = arguments.join(", ");
    let _ = writeln!(
        text,
        "    {name}_with_sincos({arguments}, &{sin}, &{cos})\n}}"
    );
}
