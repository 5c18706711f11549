//! The sines and cosines at the start of a function: called angle by angle, or
//! together, or as polynomials. And after them what is read of speeds.
//!
//! ```text
//! let (s1, c1) = libm::sincos(q[0]);
//!
//! let ([s1, s2], [c1, _]) = dalembert_sines::sincos(&[q[0], q[1]]);
//!
//! let (s1, c1) = {
//!     let x1 = q[0] * q[0];
//!     …
//!     (x9, -x14)
//! };
//! ```

use crate::language::dialect::{Dialect, Lines};
use crate::language::list;
use crate::program::kernel::Kernel;
use crate::program::{Code, Input, Library, Literal, Operation, Pair};

pub(super) fn write(text: &mut String, code: &Code) {
    let dialect = Dialect::rust(code.scalar);
    let call = |function: &str, angle: &str| dialect.call("libm", function, angle);
    write_each(text, code, dialect, call);
    let angles = list(taken(code).map(|pair| operand(pair.joint)));
    if !angles.is_empty() {
        let ([sin, cos], suffix) = (taken_names(code), code.scalar.math_suffix());
        let value = format!("dalembert_sines::sincos{suffix}(&[{angles}])");
        *text += &format!("    let ([{sin}], [{cos}]) = {value};\n");
    }
}

pub(super) fn write_each(
    text: &mut String,
    code: &Code,
    dialect: Dialect,
    call: impl Fn(&str, &str) -> String,
) {
    for pair in code.pairs.iter().filter(|pair| !is_together(pair, code)) {
        let [sine, cosine] = [Input::Sin(pair.joint), Input::Cos(pair.joint)].map(Input::name);
        let (names, function) = match (pair.need.sin, pair.need.cos) {
            (true, false) => (sine, "sin"),
            (false, true) => (cosine, "cos"),
            _ => (format!("({sine}, {cosine})"), "sincos"),
        };
        let angle = operand(pair.joint);
        match &pair.kernel {
            Some(kernel) => write_kernel(text, &names, &angle, kernel, dialect),
            None => *text += &format!("    let {names} = {};\n", call(function, &angle)),
        }
    }
}

fn write_kernel(text: &mut String, names: &str, angle: &str, kernel: &Kernel, dialect: Dialect) {
    let lines = Lines::of_kernel(dialect, kernel, angle, "x");
    *text += &format!("    let {names} = {{\n");
    for line in lines.statements() {
        *text += &format!("        {line}\n");
    }
    let mut result = list(lines.results());
    if kernel.dag.outputs.len() != 1 {
        result = format!("({result})");
    }
    *text += &format!("        {result}\n    }};\n");
}

pub(super) fn operand(joint: usize) -> String {
    format!("q[{joint}]")
}

fn is_together(pair: &Pair, code: &Code) -> bool {
    code.library == Library::Together && pair.kernel.is_none()
}

pub(super) fn taken(code: &Code) -> impl Iterator<Item = &Pair> {
    code.pairs.iter().filter(|pair| is_together(pair, code))
}

pub(super) fn taken_names(code: &Code) -> [String; 2] {
    let name = |is_needed, input: Input| if is_needed { input.name() } else { "_".into() };
    let sines = taken(code).map(|pair| name(pair.need.sin, Input::Sin(pair.joint)));
    let cosines = taken(code).map(|pair| name(pair.need.cos, Input::Cos(pair.joint)));
    [list(sines), list(cosines)]
}

/// `let r2 = 1.0 / libm::sqrt(qd[1] * qd[1] + 0.0001);` Every library rounds roots correctly.
pub(super) fn write_speeds(text: &mut String, dialect: Dialect, code: &Code, path: &str) {
    let one = dialect.literal(Literal(1.0));
    for joint_speed in &code.speeds {
        let name = Input::PerSpeed(joint_speed.coordinate).name();
        let square = dialect.literal(joint_speed.square);
        let speed = format!("qd[{}]", joint_speed.coordinate);
        let product = dialect.operation(Operation::Mul, &speed, &speed);
        let sum = format!("{product} + {square}");
        let value = format!("{one} / {}", dialect.call(path, "sqrt", &sum));
        *text += &format!("    {}\n", dialect.declare(&name, &value));
    }
}
