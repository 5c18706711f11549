//! `NAME_columns`: the function at any number of states, by the crate `dalembert-batch`, which
//! asks the processor what vectors it has.
//!
//! The type `…Batch` tells that crate about the function, and has its arithmetic over vectors:
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

use crate::function::Argument;
use crate::language::c99::largest;
use crate::language::dialect::{Dialect, Lines};
use crate::language::{function, list, trig};
use crate::program::{Code, Program};

/// In u; the documentation of `dalembert-sines` proves it.
const FUSED_ERROR: f64 = 0.83;

pub(crate) fn columns(program: &Program, code: &Code) -> String {
    let name = program.function.name();
    let kind = format!("{}Batch", program.function.camel());
    let (n, scalar) = (program.joints, code.scalar);
    let arguments = program.arguments.iter().map(|argument| argument.name());
    let arguments: Vec<&str> = arguments.collect();
    let (count, entries) = (arguments.len(), code.dag.outputs.len());
    let taken = trig::taken(code).count();
    let sizes = format!("{count}, {n}, {entries}, {taken}");
    let bits = match fuses_sines(code) {
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
    if fuses_sines(code) {
        text.push_str("    const FUSED: bool = true;\n");
    }
    text.push('\n');
    write_vectors(&mut text, program, code);
    let parameters = arguments.iter();
    let parameters: String = parameters
        .map(|name| format!("{name}: &[&[{scalar}]; {n}], "))
        .collect();
    text += &format!(
        "}}\n\n/// [`{name}`] at any number of states in columns: a slice for every entry of an argument, and of\n\
         /// the result in the order of its text. It is computed with the vectors that\n\
         {bits}\n\
         ///\n/// # Errors\n/// The slices are of different lengths; then nothing is computed.\n\
         pub fn {name}_columns({parameters}results: &mut [&mut [{scalar}]; {entries}]) -> Result<(), dalembert_batch::Unequal> {{\n    \
         dalembert_batch::columns::<{kind}, {sizes}>([{}], results)\n}}\n",
        arguments.join(", "),
    );
    text
}

fn fuses_sines(code: &Code) -> bool {
    code.counts().fma > 0 && trig::taken(code).next().is_some()
}

fn write_vectors(text: &mut String, program: &Program, code: &Code) {
    write_angles(text, program, code);
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
    let first = program.arguments.first().map_or("", |first| first.name());
    let of = match body.contains("of.all(") || results.contains("of.all(") {
        true => format!("        let of = {first}[0];\n"),
        false => String::new(),
    };
    let (count, n, entries) = (
        program.arguments.len(),
        program.joints,
        code.dag.outputs.len(),
    );
    let arguments = program.arguments.iter().map(|&argument| {
        let is_read = function::reads_entry(code, argument)
            || (argument == Argument::Position && is_computed)
            || (argument.name() == first && !of.is_empty());
        marked(argument.name(), is_read)
    });
    let [sin, cos] = trig::taken_names(code);
    *text += &format!(
        "\n    #[inline(always)]\n    \
         fn vectors<V: dalembert_batch::Vector<{}>>([{}]: &[[V; {n}]; {count}], \
         &[{}]: &[V; {taken}], &[{}]: &[V; {taken}]) -> [V; {entries}] {{\n",
        code.scalar,
        list(arguments),
        sin,
        cos,
        taken = trig::taken(code).count(),
    );
    text.push_str(&of);
    for line in body.lines() {
        *text += &format!("    {line}\n");
    }
    *text += &format!("        [{results}]\n    }}\n");
}

fn marked(name: &str, is_read: bool) -> String {
    format!("{}{name}", if is_read { "" } else { "_" })
}

fn write_angles(text: &mut String, program: &Program, code: &Code) {
    let (n, count) = (program.joints, program.arguments.len());
    let angles: Vec<_> = trig::taken(code).map(|pair| pair.joint).collect();
    let arguments = program.arguments.iter().map(|argument| {
        let is_read = *argument == Argument::Position && !angles.is_empty();
        marked(argument.name(), is_read)
    });
    *text += &format!(
        "    #[inline(always)]\n    \
         fn angles<V: dalembert_batch::Floats<{}>>([{}]: &[[V; {n}]; {count}]) -> [V; {}] {{\n",
        code.scalar,
        list(arguments),
        angles.len()
    );
    let angles = list(angles.iter().map(|&own| trig::operand(own)));
    *text += &format!("        [{angles}]\n    }}\n");
}
