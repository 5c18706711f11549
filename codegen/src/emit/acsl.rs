//! Contracts of the functions in C, in ACSL, which Frama-C reads: where a function holds, what it
//! writes, and how far its results are from the full model where that is certified.
//!
//! ```text
//! /*@ logic real arm_exact_gravity(double *q, integer i) =
//!       \let s1 = \sin(q[0]);
//!       \let t1 = s1 * (1.0/2.0);
//!       (i == 0) ? t1 : -t1;
//! */
//! /*@ requires \valid_read(q + (0 .. 1)) && \valid(c + (0 .. 1));
//!     requires -3.0d <= q[0] <= 3.0d;
//!     assigns c[0 .. 1];
//!     ensures \abs(c[0] - arm_exact_gravity(q, 0)) <= 1e-4;
//! */
//! ```

use std::fmt::Write;

use dalembert_model::number::Exact;

use super::GeneratedFunction;
use super::state_box::StateBox;
use crate::certificate::Certificate;
use crate::function::Argument;
use crate::language::Printed;
use crate::language::c99::{self, Names};
use crate::language::scope::Scope;
use crate::program::text::input_name;
use crate::program::{Operand, Operation, Program, ScalarType};
use crate::scene::SceneRobot;

/// Returns the contract of a function.
pub(super) fn contract(
    generated: &GeneratedFunction,
    printed: &Printed<'_>,
    scene_robot: &SceneRobot,
    names: &Names,
) -> String {
    let scalar = printed.code.scalar;
    let arguments = printed.arguments.iter();
    let read = arguments.map(|argument| block(argument.name(), argument.length(printed.sizes)));
    let read: Vec<String> = read.collect();
    let quantities = generated.function.quantities().iter();
    let (written, assigned): (Vec<String>, Vec<String>) = match generated.function {
        function if c99::is_number(function) => Default::default(),
        function if c99::is_bundle(function) => (vec!["result".into()], vec!["*result".into()]),
        _ => quantities
            .map(|quantity| (quantity.field(), quantity.len(printed.sizes)))
            .map(|(field, length)| {
                (
                    block(field, length),
                    format!("{field}[0 .. {}]", length - 1),
                )
            })
            .unzip(),
    };
    let mut clauses = validity(&read, &written);
    let state_box = StateBox::of(std::slice::from_ref(generated), scene_robot, scalar);
    for argument in printed.arguments {
        let is_locked = |joint: &usize| {
            Argument::STATE.contains(argument) && scene_robot.lock(*joint).is_some()
        };
        // Entries of locked joints are not read.
        let entries = 0..argument.length(printed.sizes);
        for index in entries.filter(|joint| !is_locked(joint)) {
            let (name, state_box) = (argument.name(), state_box.as_ref());
            let ends = state_box.and_then(|own| own.ends(*argument, index, scalar));
            clauses.push(match ends {
                Some(ends) => format!("requires {};", between(ends, name, index, scalar)),
                None => format!("requires \\is_finite({name}[{index}]);"),
            });
        }
    }
    clauses.push(match assigned.is_empty() {
        true => "assigns \\nothing;".to_owned(),
        false => format!("assigns {};", assigned.join(", ")),
    });
    let mut all = generated.admitted.iter().flat_map(|own| &own.certificates);
    let mut text = String::new();
    if let Some(certificate) = all.find(|certificate| certificate.scalar == scalar) {
        let exact = names.of(&format!("exact_{}", generated.function));
        text += &logic(&exact, certificate, printed, scalar);
        clauses.extend(bounds(&exact, certificate, printed));
    }
    text + &comment(&clauses)
}

/// Returns the contract of the function that says whether a state is inside a box.
pub(super) fn in_box(state_box: &StateBox, scalar: ScalarType) -> String {
    let (mut read, mut inside) = (Vec::new(), Vec::new());
    for (argument, column) in &state_box.columns {
        read.push(block(argument.name(), column.len()));
        for index in 0..column.len() {
            if let Some(ends) = state_box.ends(*argument, index, scalar) {
                inside.push(between(ends, argument.name(), index, scalar));
            }
        }
    }
    let mut clauses = validity(&read, &[]);
    clauses.push("assigns \\nothing;".to_owned());
    let inside = inside.join(" && ");
    clauses.push(format!("ensures (\\result == 1) <==> ({inside});"));
    clauses.push("ensures \\result == 0 || \\result == 1;".to_owned());
    comment(&clauses)
}

/// Returns that an entry is between two numbers of the scalar: literals without its mark would be
/// reals.
fn between(ends: [String; 2], name: &str, index: usize, scalar: ScalarType) -> String {
    let mark = match scalar {
        ScalarType::F64 => "d",
        ScalarType::F32 => "f",
    };
    let [low, high] = ends;
    format!("{low}{mark} <= {name}[{index}] <= {high}{mark}")
}

fn block(name: &str, length: usize) -> String {
    format!("{name} + (0 .. {})", length - 1)
}

fn comment(clauses: &[String]) -> String {
    format!("/*@ {}\n*/\n", clauses.join("\n    "))
}

/// Returns what can be read and written, and that nothing that is written overlaps.
fn validity(read: &[String], written: &[String]) -> Vec<String> {
    let mut all: Vec<String> = Vec::new();
    all.extend(read.iter().map(|block| format!("\\valid_read({block})")));
    all.extend(written.iter().map(|block| format!("\\valid({block})")));
    for (index, own) in written.iter().enumerate() {
        let others = read.iter().chain(&written[index + 1..]);
        all.extend(others.map(|other| format!("\\separated({own}, {other})")));
    }
    let clauses = all.into_iter().map(|what| format!("requires {what};"));
    clauses.collect()
}

/// Returns how far each result may be from the full model's.
fn bounds(exact: &str, certificate: &Certificate, printed: &Printed<'_>) -> Vec<String> {
    let names: Vec<&str> = printed.arguments.iter().map(|a| a.name()).collect();
    let targets = match c99::is_number(printed.function) {
        true => vec!["\\result".to_owned()],
        false => c99::targets(printed),
    };
    let pairs = certificate.bounds.iter().zip(&certificate.scales);
    let clauses = targets.iter().zip(pairs).enumerate();
    let clauses = clauses.map(|(index, (target, (bound, scale)))| {
        // Rounded up: the product is off by half an ulp, and its shortest text by as much.
        let most = (bound.total() * scale).next_up().next_up();
        let arguments = names.join(", ");
        format!("ensures \\abs({target} - {exact}({arguments}, {index})) <= {most:e};")
    });
    clauses.collect()
}

/// Returns the full model as a function over the reals: the proved program.
fn logic(
    exact: &str,
    certificate: &Certificate,
    printed: &Printed<'_>,
    scalar: ScalarType,
) -> String {
    let first = certificate.stages.first();
    let program = first.map_or(&certificate.emitted, |stage| &stage.program);
    let float = c99::float(scalar);
    let arguments = printed.arguments.iter();
    let parameters: String = arguments
        .map(|argument| format!("{float} *{}, ", argument.name()))
        .collect();
    let mut text = format!("/*@ logic real {exact}({parameters}integer i) =\n");
    for trig in &program.trig {
        let sum = Scope::STATE.sum(trig.angle);
        for (taken, letter, function) in [(trig.sin, 's', "sin"), (trig.cos, 'c', "cos")] {
            if taken {
                // Writing to a string cannot fail.
                let _ = writeln!(
                    text,
                    "      \\let {letter}{} = \\{function}({sum});",
                    trig.angle
                );
            }
        }
    }
    for (index, step) in program.steps.iter().enumerate() {
        let [left, right] = [&step.left, &step.right].map(operand);
        let symbol = match step.operation {
            Operation::Fused => '*',
            other => other.symbol(),
        };
        let _ = writeln!(
            text,
            "      \\let t{} = {left} {symbol} {right};",
            index + 1
        );
    }
    text + &format!("      {};\n*/\n", results(program))
}

/// Returns the result of a number.
fn results(program: &Program) -> String {
    let values = program.outputs.iter().map(|output| {
        let sign = if output.negative { "-" } else { "" };
        format!("{sign}{}", operand(&output.value))
    });
    let values: Vec<String> = values.collect();
    let (last, others) = match values.split_last() {
        Some((last, others)) => (last.as_str(), others),
        None => ("0.0", &[][..]),
    };
    let cases = others.iter().enumerate();
    let cases: String = cases
        .map(|(index, value)| format!("(i == {index}) ? {value} : "))
        .collect();
    cases + last
}

fn operand(operand: &Operand) -> String {
    match operand {
        Operand::Input(input) => input_name(*input),
        Operand::Constant(value) => format!("({})", real(value)),
        Operand::Step(index) => format!("t{}", index + 1),
    }
}

/// Returns a constant without rounding: numbers have a point, since integers are divided as in
/// C, and a power is a product.
fn real(value: &Exact) -> String {
    let (text, mut real) = (value.to_string(), String::new());
    let (mut chars, mut factor) = (text.chars().peekable(), 0);
    while let Some(first) = chars.next() {
        let mut word = first.to_string();
        if first.is_ascii_alphanumeric() {
            while let Some(next) = chars.next_if(char::is_ascii_alphanumeric) {
                word.push(next);
            }
        }
        match word.as_str() {
            "sin" | "cos" => {
                factor = real.len();
                real += &format!("\\{word}");
            }
            "pi" => real += "\\pi",
            "^" => {
                let mut power = String::new();
                while let Some(digit) = chars.next_if(char::is_ascii_digit) {
                    power.push(digit);
                }
                let base = real[factor..].to_owned();
                for _ in 1..power.parse::<usize>().unwrap_or(1) {
                    real += &format!("*{base}");
                }
            }
            digits if digits.starts_with(|c: char| c.is_ascii_digit()) => {
                real += &format!("{digits}.0");
            }
            other => real += other,
        }
    }
    real
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn constants_are_reals() {
        for (text, expected) in [
            ("-3/4", "-3.0/4.0"),
            ("12", "12.0"),
            (
                "1/2*cos(1*pi/5)^3",
                "1.0/2.0*\\cos(1.0*\\pi/5.0)*\\cos(1.0*\\pi/5.0)*\\cos(1.0*\\pi/5.0)",
            ),
            (
                "1+-1/2*sin(3/10)*cos(3/10)",
                "1.0+-1.0/2.0*\\sin(3.0/10.0)*\\cos(3.0/10.0)",
            ),
        ] {
            let value: Exact = text.parse().unwrap();
            assert_eq!(value.to_string(), text);
            assert_eq!(real(&value), expected);
        }
    }
}
