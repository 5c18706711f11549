//! The arithmetic of a function over vectors: what `NAME_columns` runs.
//!
//! ```text
//! fn angles<V: dalembert_batch::Floats<f64>>([q]: &[[V; 2]; 1]) -> [V; 1] {
//!     [q[0]]
//! }
//!
//! fn vectors<V: dalembert_batch::Vector<f64>>([q]: &[[V; 2]; 1], &[s1]: &[V; 1], &[c1]: &[V; 1]) -> [V; 2] {
//!     let of = q[0];
//!     let t1 = c1 * of.all(0.5);
//!     …
//! }
//! ```
//!
//! It is a text of its own, since one that both took would slow down the other: unoptimised, each
//! operator of a type that nobody knows is a call.

use std::fmt::Write;

use crate::function::Argument;
use crate::language::dialect::{Dialect, Lines};
use crate::language::{Printed, function, list, trig};
use crate::program::Code;

/// Returns whether products are fused in the sines that are given, as they are in what reads them.
pub(super) fn fuses_sines(code: &Code) -> bool {
    code.counts().fma > 0 && trig::taken(code).next().is_some()
}

/// Prints the methods that compute in vectors.
pub(super) fn write(text: &mut String, printed: &Printed<'_>) {
    write_angles(text, printed);
    let code = printed.code;
    let dialect = Dialect::vectors(code.scalar);
    let mut body = String::new();
    trig::write_each(&mut body, code, dialect, |function, angle| {
        let method = if function == "sincos" { "both" } else { "each" };
        let suffix = code.scalar.math_suffix();
        format!("{angle}.{method}(libm::{function}{suffix})")
    });
    let is_computed = !body.is_empty();
    trig::write_speeds(&mut body, dialect, code, "dalembert_batch");
    function::write_steps(&mut body, code, dialect);
    let results = list(Lines::new(dialect, code).results());
    let first = printed.arguments.first().map_or("", |first| first.name());
    let of = match body.contains("of.all(") || results.contains("of.all(") {
        true => format!("        let of = {first}[0];\n"),
        false => String::new(),
    };
    let (count, n, entries) = (
        printed.arguments.len(),
        printed.sizes.joints,
        code.dag.outputs.len(),
    );
    let arguments = printed.arguments.iter().map(|&argument| {
        let is_read = function::reads_entry(code, argument)
            || (argument == Argument::Position && is_computed)
            || (argument.name() == first && !of.is_empty());
        marked(argument.name(), is_read)
    });
    let [sin, cos] = trig::taken_names(code);
    let _ = writeln!(
        text,
        "\n    #[inline(always)]\n    \
         fn vectors<V: dalembert_batch::Vector<{}>>([{}]: &[[V; {n}]; {count}], \
         &[{}]: &[V; {taken}], &[{}]: &[V; {taken}]) -> [V; {entries}] {{",
        code.scalar,
        list(arguments),
        sin,
        cos,
        taken = trig::taken(code).count(),
    );
    text.push_str(&of);
    for line in body.lines() {
        let _ = writeln!(text, "    {line}");
    }
    let _ = writeln!(text, "        [{results}]\n    }}");
}

/// Returns the name of an argument, marked where it is not read.
fn marked(name: &str, is_read: bool) -> String {
    format!("{}{name}", if is_read { "" } else { "_" })
}

/// Prints which angles sines are given of.
fn write_angles(text: &mut String, printed: &Printed<'_>) {
    let (code, n, count) = (printed.code, printed.sizes.joints, printed.arguments.len());
    let angles: Vec<_> = trig::taken(code).map(|pair| pair.joint).collect();
    let arguments = printed.arguments.iter().map(|argument| {
        let is_read = *argument == Argument::Position && !angles.is_empty();
        marked(argument.name(), is_read)
    });
    // Writing to a string cannot fail.
    let _ = writeln!(
        text,
        "    #[inline(always)]\n    \
         fn angles<V: dalembert_batch::Floats<{}>>([{}]: &[[V; {n}]; {count}]) -> [V; {}] {{",
        code.scalar,
        list(arguments),
        angles.len()
    );
    let angles = list(angles.iter().map(|&own| trig::operand(own)));
    let _ = writeln!(text, "        [{angles}]\n    }}");
}
