//! Functions in C99, which C++ reads too, and in CUDA: one flat function each, matrices row by row.
//!
//! ```text
//! static inline void arm_gravity(const double q[ARM_RESTRICT 2], double c[ARM_RESTRICT 2])
//! {
//!     ARM_UNFUSED
//!     double sines[1];
//!     double cosines[1];
//!     arm_sines_1(&q[0], sines, cosines);
//!     const double s1 = sines[0];
//!     const double t1 = s1 * 0.5;
//!     c[0] = t1;
//!     c[1] = -t1;
//! }
//! ```

use dalembert_sines::{LARGEST, LARGEST_F32};

use super::called::SineCall;
use super::dialect::Lines;
use super::function::reads;
use super::loops::{self, Piece};
pub(crate) use super::names::{LONGEST, Names, float};
use super::{Language, trig};
use crate::function::{Argument, Function, Quantity, Sizes};
use crate::program::{Code, Input, Library, Pair, Program, ScalarType};

pub(crate) fn is_bundle(function: Function) -> bool {
    matches!(function, Function::Bundle(_) | Function::Load)
}

pub(crate) fn argument_structure(argument: Argument, names: &Names) -> Option<String> {
    let name = argument.name();
    argument.has_type().then(|| names.of(&format!("{name}_t")))
}

pub(crate) fn is_number(function: Function) -> bool {
    function.structure().is_none() && function.quantities()[0].shape().0.is_empty()
}

pub(crate) fn structure(program: &Program, names: &Names) -> Option<String> {
    let (function, sizes) = (program.function, program.sizes());
    is_bundle(function).then(|| {
        let float = float(names.dialect().scalar);
        let fields = function.quantities().iter().map(|quantity| {
            let (field, length) = (quantity.field(), quantity.len(sizes));
            let doc = shaped(*quantity, sizes);
            format!("    /* {doc} */\n    {float} {field}[{length}];\n")
        });
        let (fields, kind) = (fields.collect::<String>(), structure_name(function, names));
        let name = names.of(function.name());
        format!("/* The results of {name}. */\ntypedef struct {{\n{fields}}} {kind};\n")
    })
}

pub(crate) fn structure_name(function: Function, names: &Names) -> String {
    names.of(&format!("{}_t", function.name()))
}

pub(crate) fn shaped(quantity: Quantity, sizes: Sizes) -> String {
    let shape = quantity.shape();
    let lengths = shape.lengths(sizes);
    let brackets: Vec<String> = lengths.map(|length| format!("[{length}]")).collect();
    let is_matrix = brackets.len() > 1;
    let rows = if is_matrix { ", row by row" } else { "" };
    let (field, summary) = (quantity.field(), quantity.facts().summary);
    format!("{field}{}{rows}: {summary}", brackets.concat())
}

/// The angles of one state may be far; in a batch the function is told.
pub(crate) const FAR: [&str; 2] = ["1", "far"];

pub(crate) fn head(program: &Program, names: &Names, is_told: bool) -> String {
    let (function, sizes) = (program.function, program.sizes());
    let float = float(names.dialect().scalar);
    let restrict = names.constant("RESTRICT");
    let (mut parameters, mut name) = (Vec::new(), function.name().to_owned());
    if is_told {
        parameters.push("const int far".to_owned());
        name += "_any";
    }
    for &argument in &program.arguments {
        let (name, length) = (argument.name(), argument.length(sizes));
        parameters.push(match argument_structure(argument, names) {
            Some(kind) => format!("const {kind} {name}[{restrict} 1]"),
            None => format!("const {float} {name}[{restrict} {length}]"),
        });
    }
    let mut result = "void";
    if is_number(function) {
        result = float;
    } else if is_bundle(function) {
        let kind = structure_name(function, names);
        parameters.push(format!("{kind} result[{restrict} 1]"));
    } else {
        for quantity in function.quantities() {
            let (name, length) = (quantity.field(), quantity.len(sizes));
            parameters.push(format!("{float} {name}[{restrict} {length}]"));
        }
    }
    let (qualifiers, name) = (names.dialect().function, names.of(&name));
    format!("{qualifiers} {result} {name}({})", parameters.join(", "))
}

fn written(function: Function) -> Vec<&'static str> {
    match (is_number(function), is_bundle(function)) {
        (true, _) => Vec::new(),
        (_, true) => vec!["result"],
        _ => function.quantities().iter().map(|q| q.field()).collect(),
    }
}

pub(crate) fn single(program: &Program, names: &Names) -> String {
    let function = program.function;
    let called = names.of(&format!("{function}_any"));
    let arguments = program.arguments.iter().map(|argument| argument.name());
    let mut passed = vec![FAR[0]];
    passed.extend(arguments.chain(written(function)));
    let (head, passed) = (head(program, names, false), passed.join(", "));
    let back = if is_number(function) { "return " } else { "" };
    format!("{head}\n{{\n    {back}{called}({passed});\n}}\n")
}

/// The crate's algorithm calls others for far angles: calls would be in the way of vectors.
pub(crate) fn is_told(code: &Code, names: &Names) -> bool {
    names.language == Language::C && trig::taken(code).next().is_some()
}

pub(crate) fn write(program: &Program, code: &Code, names: &Names, is_told: bool) -> String {
    let dialect = names.dialect();
    let far = FAR[usize::from(is_told)];
    let mut text = format!("{}\n{{\n", head(program, names, is_told));
    let mut line = |line: &str| text += &format!("    {line}\n");
    line(&names.constant("UNFUSED"));
    let called = SineCall::of(code, program.joints, names, is_told);
    let is_called = |pair: &&Pair| called.is_some() && pair.kernel.is_none();
    let (by_call, alone): (Vec<&Pair>, Vec<&Pair>) = code.pairs.iter().partition(is_called);
    for pair in alone {
        let joint = pair.joint;
        let (argument, both) = (trig::operand(joint), format!("p{}", joint + 1));
        if let (None, Library::Together) = (&pair.kernel, code.library) {
            let [kind, call] = ["sincos_t", "sincos"].map(|word| names.of(word));
            line(&format!("const {kind} {both} = {call}({far}, {argument});"));
        }
        let kernel = pair.kernel.as_ref();
        let prefix = format!("x{}_", joint + 1);
        let lines = kernel.map(|kernel| Lines::of_kernel(dialect, kernel, &argument, &prefix));
        if let Some(lines) = &lines {
            lines.statements().for_each(|statement| line(&statement));
        }
        let mut results = lines.iter().flat_map(Lines::results);
        for (name, is_sine) in taken(pair) {
            let function = if is_sine { "sin" } else { "cos" };
            let value = match (results.next(), code.library) {
                (Some(value), _) => value,
                (None, Library::Together) => format!("{both}.{function}"),
                (None, Library::Libm) => dialect.call("", function, &argument),
            };
            line(&dialect.declare(&name, &value));
        }
    }
    if let Some(called) = &called {
        for statement in called.lines(names) {
            line(&statement);
        }
        for pair in by_call {
            for (name, is_sine) in taken(pair) {
                let value = called.value(pair.joint, is_sine).unwrap_or_default();
                line(&dialect.declare(&name, &value));
            }
        }
    }
    trig::write_speeds(&mut text, dialect, code, "");
    let mut line = |line: &str| text += &format!("    {line}\n");
    let (lines, pieces) = loops::pieces(dialect, code);
    for piece in &pieces {
        match piece {
            Piece::Shared(ids) => {
                for statement in ids.iter().filter_map(|id| lines.statement(*id)) {
                    line(&statement);
                }
            }
            Piece::Lanes(block) => {
                // clang would carry values from lane to lane in registers, and make no vectors.
                let is_forgotten = has_vectors(code, names);
                let forget = |array: &Option<String>| {
                    let array = array.as_ref().filter(|_| is_forgotten);
                    array.map(|array| format!("{}({array});", names.constant("FORGET")))
                };
                let [read, written] = [&block.read, &block.written].map(forget);
                for statement in block.before.iter().chain(&read).chain([&block.head]) {
                    line(statement);
                }
                for statement in block.rows.iter().flat_map(|(_, lines)| lines) {
                    line(&format!("    {statement}"));
                }
                line("}");
                if let Some(statement) = &written {
                    line(statement);
                }
            }
        }
    }
    let (function, sizes) = (program.function, program.sizes());
    let arguments = program.arguments.iter();
    for argument in arguments.filter(|argument| !reads(code, **argument)) {
        line(&format!("(void){};", argument.name()));
    }
    let mut results = lines.results();
    if is_number(function) {
        results.for_each(|value| line(&format!("return {value};")));
    } else {
        let before = if is_bundle(function) { "result->" } else { "" };
        for quantity in function.quantities() {
            let array = format!("{before}{}", quantity.field());
            let values: Vec<String> = results.by_ref().take(quantity.len(sizes)).collect();
            let stores = stores(&array, &values, has_vectors(code, names), names);
            stores.iter().for_each(|store| line(store));
        }
    }
    text.push_str("}\n");
    text
}

/// Returns the lines that store an array of results: with lanes four at a time. Compilers would store
/// each alone, which took a quarter of the time of a quadruped's slopes.
fn stores(array: &str, values: &[String], is_four: bool, names: &Names) -> Vec<String> {
    let (four, float) = (names.constant("FOUR"), float(names.dialect().scalar));
    let store = |(first, chunk): (usize, &[String])| match chunk {
        [a, b, c, d] if is_four => {
            let place = format!("&{array}[{first}]");
            vec![format!("{four}({float}, {place}, {a}, {b}, {c}, {d});")]
        }
        _ => {
            let entries = (first..).zip(chunk);
            let stores = entries.map(|(index, value)| format!("{array}[{index}] = {value};"));
            stores.collect()
        }
    };
    let firsts = (0..).step_by(4);
    firsts.zip(values.chunks(4)).flat_map(store).collect()
}

/// `true` where a header has the macros by which compilers make vectors of lanes.
pub(crate) fn has_vectors(code: &Code, names: &Names) -> bool {
    names.language == Language::C && !code.loops.is_empty()
}

fn taken(pair: &Pair) -> impl Iterator<Item = (String, bool)> {
    let (need, joint) = (pair.need, pair.joint);
    let sine = need.sin.then(|| (Input::Sin(joint).name(), true));
    let cosine = need.cos.then(|| (Input::Cos(joint).name(), false));
    sine.into_iter().chain(cosine)
}

/// Up to this magnitude sines are computed without a library.
pub(crate) fn largest(scalar: ScalarType) -> f64 {
    scalar.of(LARGEST, LARGEST_F32.into())
}
