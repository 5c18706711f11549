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
use crate::language::{Printed, angles, function, sines, speed, trig};
use crate::program::{Code, Pair};

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
    let computed = || {
        let pairs = code.pairs.iter();
        pairs.filter(|pair| !trig::is_together(pair, code))
    };
    for pair in computed() {
        write_sines(&mut body, pair, dialect);
    }
    speed::write(&mut body, dialect, code, "dalembert_batch");
    function::write_steps(&mut body, code, dialect);
    let results: Vec<String> = Lines::new(dialect, code).results().collect();
    let results = results.join(", ");
    let first = printed.arguments.first().map_or("", |first| first.name());
    let of = match body.contains("of.all(") || results.contains("of.all(") {
        true => format!("        let of = {first}[0];\n"),
        false => String::new(),
    };
    let is_computed = computed().next().is_some();
    let (count, n, entries) = (
        printed.arguments.len(),
        printed.sizes.joints,
        code.dag.outputs.len(),
    );
    let arguments = printed.arguments.iter().map(|&argument| {
        let is_read = function::reads_entry(code, argument)
            || (argument == Argument::Position && is_computed)
            || (argument.name() == first && !of.is_empty());
        format!(
            "{}{argument}",
            if is_read { "" } else { "_" },
            argument = argument.name()
        )
    });
    let arguments: Vec<String> = arguments.collect();
    let [sin, cos] = trig::taken_names(code);
    let _ = writeln!(
        text,
        "\n    #[inline(always)]\n    \
         fn vectors<V: dalembert_batch::Vector<{}>>([{}]: &[[V; {n}]; {count}], \
         &[{}]: &[V; {taken}], &[{}]: &[V; {taken}]) -> [V; {entries}] {{",
        code.scalar,
        arguments.join(", "),
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

/// Prints which angles sines are given of.
fn write_angles(text: &mut String, printed: &Printed<'_>) {
    let (code, n, count) = (printed.code, printed.sizes.joints, printed.arguments.len());
    let angles: Vec<_> = trig::taken(code).map(|pair| pair.joint).collect();
    let arguments = printed.arguments.iter().map(|argument| argument.name());
    let is_read = |name: &str| name == "q" && !angles.is_empty();
    let arguments: Vec<String> = arguments
        .map(|name| format!("{}{name}", if is_read(name) { "" } else { "_" }))
        .collect();
    // Writing to a string cannot fail.
    let _ = writeln!(
        text,
        "    #[inline(always)]\n    \
         fn angles<V: dalembert_batch::Floats<{}>>([{}]: &[[V; {n}]; {count}]) -> [V; {}] {{",
        code.scalar,
        arguments.join(", "),
        angles.len()
    );
    let angles: Vec<String> = angles.iter().map(|&own| angles::operand(own)).collect();
    let _ = writeln!(text, "        [{}]\n    }}", angles.join(", "));
}

/// Prints the sines of an angle that are computed for themselves.
fn write_sines(text: &mut String, pair: &Pair, dialect: Dialect) {
    let (names, angle) = (
        angles::names(pair.joint, pair.need),
        angles::operand(pair.joint),
    );
    if let Some(kernel) = &pair.kernel {
        return sines::write(text, &names, &angle, kernel, dialect);
    }
    let called = trig::called(pair.need);
    let method = if called == "sincos" { "both" } else { "each" };
    let library = format!("libm::{called}{}", dialect.scalar.math_suffix());
    let _ = writeln!(text, "    let {names} = {angle}.{method}({library});");
}
