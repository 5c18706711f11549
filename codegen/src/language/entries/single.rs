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
use crate::language::{Printed, function, trig};

/// Prints it.
pub(super) fn write(text: &mut String, printed: &Printed<'_>, around: &Around<'_>, doc: &[String]) {
    let (name, scalar) = (printed.function.name(), printed.code.scalar);
    let arguments = arguments(printed);
    let parameters = printed.arguments.iter().map(|&argument| {
        let kind = function::argument_type(argument, printed.sizes, scalar);
        format!("{}: &{kind}", argument.name())
    });
    let parameters: Vec<String> = parameters.collect();
    let result = function::result_type(printed.function, printed.sizes, scalar);
    function::write_doc(text, doc);
    // Writing to a string cannot fail.
    let _ = writeln!(
        text,
        "#[must_use]\npub fn {name}({}) -> {result} {{",
        parameters.join(", ")
    );
    trig::write(text, printed.code, around.path);
    let sin = around.angles.array(&printed.code.trig, |trig| {
        trig.sin.then(|| format!("s{}", trig.angle))
    });
    let cos = around.angles.array(&printed.code.trig, |trig| {
        trig.cos.then(|| format!("c{}", trig.angle))
    });
    let arguments = arguments.join(", ");
    let _ = writeln!(
        text,
        "    {name}_with_sincos({arguments}, &{sin}, &{cos})\n}}"
    );
}
