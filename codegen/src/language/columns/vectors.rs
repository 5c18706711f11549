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
use crate::language::dialect::Dialect;
use crate::language::{Printed, angles, function, sines, speed, trig};
use crate::program::{Lowered, LoweredTrig, Operation, Step};

/// Returns the angles whose sines are given.
pub(super) fn taken(code: &Lowered) -> impl Iterator<Item = &LoweredTrig> {
    code.trig
        .iter()
        .filter(|trig| trig::is_together(trig, code))
}

/// Returns whether products are fused in the sines that are given, as they are in what reads them.
pub(super) fn fuses_sines(code: &Lowered) -> bool {
    let is_fused = |step: &Step<_>| step.operation == Operation::Fused;
    code.steps.iter().any(is_fused) && taken(code).next().is_some()
}

/// Prints the methods that compute in vectors.
pub(super) fn write(text: &mut String, printed: &Printed<'_>) {
    write_angles(text, printed);
    let code = printed.code;
    let dialect = Dialect::vectors(code.scalar);
    let mut body = String::new();
    for trig in code
        .trig
        .iter()
        .filter(|trig| !trig::is_together(trig, code))
    {
        write_sines(&mut body, trig, dialect);
    }
    speed::write(&mut body, dialect, code, "dalembert_batch");
    function::write_steps(&mut body, code, dialect);
    let outputs = code.outputs.iter();
    let results: Vec<String> = outputs.map(|o| function::result_item(o, dialect)).collect();
    let results = results.join(", ");
    let first = printed.arguments.first().map_or("", |first| first.name());
    let of = match body.contains("of.all(") || results.contains("of.all(") {
        true => format!("        let of = {first}[0];\n"),
        false => String::new(),
    };
    let is_computed = code.trig.iter().any(|trig| !trig::is_together(trig, code));
    let (count, n, entries) = (
        printed.arguments.len(),
        printed.sizes.joints,
        code.outputs.len(),
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
    let name = |is_taken: bool, letter: char, trig: &LoweredTrig| match is_taken {
        true => format!("{letter}{}", trig.angle),
        false => "_".to_owned(),
    };
    let sin: Vec<String> = taken(code).map(|trig| name(trig.sin, 's', trig)).collect();
    let cos: Vec<String> = taken(code).map(|trig| name(trig.cos, 'c', trig)).collect();
    let _ = writeln!(
        text,
        "\n    #[inline(always)]\n    \
         fn vectors<V: dalembert_batch::Vector<{}>>([{}]: &[[V; {n}]; {count}], \
         &[{}]: &[V; {taken}], &[{}]: &[V; {taken}]) -> [V; {entries}] {{",
        code.scalar,
        arguments.join(", "),
        sin.join(", "),
        cos.join(", "),
        taken = sin.len(),
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
    let angles: Vec<_> = taken(code).map(|trig| trig.angle).collect();
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
    let angles: Vec<String> = angles.iter().map(|&own| angles::sum(own)).collect();
    let _ = writeln!(text, "        [{}]\n    }}", angles.join(", "));
}

/// Prints the sines of an angle that are computed for themselves.
fn write_sines(text: &mut String, trig: &LoweredTrig, dialect: Dialect) {
    if trig.angle.additions() > 0 {
        let _ = writeln!(
            text,
            "    let a{} = {};",
            trig.angle,
            angles::sum(trig.angle)
        );
    }
    let (pair, angle) = (angles::pair(trig), angles::operand(trig.angle));
    if let Some(kernel) = &trig.kernel {
        return sines::write(text, &pair, &angle, kernel, dialect);
    }
    let called = trig::called(trig);
    let method = if called == "sincos" { "both" } else { "each" };
    let library = format!("libm::{called}{}", dialect.scalar.math_suffix());
    let _ = writeln!(text, "    let {pair} = {angle}.{method}({library});");
}
