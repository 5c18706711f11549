//! The robot as a value: a type that answers by the traits of `dalembert`, for code
//! that is generic over robots.

use std::fmt::Write;

use super::GeneratedFunction;
use crate::function::{Columns, Function};
use crate::language::function::result_type;
use crate::program::ScalarType;

/// The type that has the traits.
pub(crate) const ROBOT: &str = "Robot";

/// Returns the trait that asks what a function answers. What bundles return, what is at a frame,
/// and what a load is, are each module's own.
pub fn question(function: Function) -> Option<String> {
    let is_own = matches!(
        function,
        Function::Load | Function::Bundle(_) | Function::At(_)
    );
    (!is_own).then(|| function.camel())
}

/// Returns what the trait answers, of these lengths: an array, or the struct of this name that
/// fits every robot.
pub(crate) fn answer(
    function: Function,
    path: &str,
    scalar: ScalarType,
    joints: &str,
) -> Option<String> {
    let name = function.structure()?;
    Some(format!("{path}::answers::{name}<{scalar}, {joints}>"))
}

/// Returns the type and what it answers; `path` is where the traits are.
pub(super) fn write(functions: &[GeneratedFunction], scalar: ScalarType, path: &str) -> String {
    let asked = |generated: &&GeneratedFunction| fits(generated);
    let (with, without): (Vec<_>, Vec<_>) = functions.iter().partition(asked);
    let mut text = String::from(
        "\n/// This robot as a value, for code that is generic over robots by the traits of\n\
         /// `dalembert`.\n",
    );
    for generated in without {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "/// [`{}`] {}", generated.function, why(generated));
    }
    let _ = writeln!(
        text,
        "#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]\npub struct {ROBOT};"
    );
    for generated in with {
        text.push_str(&implementation(generated, scalar, path));
    }
    text
}

/// Returns what the type answers by one function.
fn implementation(generated: &GeneratedFunction, scalar: ScalarType, path: &str) -> String {
    let (function, program) = (generated.function, &generated.program);
    let n = program.joints;
    let names: Vec<&str> = program.arguments.iter().map(|a| a.name()).collect();
    let parameters = program.arguments.iter().map(|argument| {
        let length = argument.length(program.sizes());
        format!("{}: &[{scalar}; {length}]", argument.name())
    });
    let parameters: Vec<String> = parameters.collect();
    let call = format!("{function}({})", names.join(", "));
    let (result, body) = match answer(function, path, scalar, &n.to_string()) {
        None => (result_type(function, program.sizes(), scalar), call),
        Some(result) => {
            let fields: Vec<&str> = function.quantities().iter().map(|q| q.field()).collect();
            let fields = fields.join(", ");
            let name = function.camel();
            let body = format!(
                "let {name} {{ {fields} }} = {call};\n        \
                 {path}::answers::{name} {{ {fields} }}"
            );
            (result, body)
        }
    };
    let columns = match function.columns() {
        Columns::None => String::new(),
        Columns::Links | Columns::Base(_) => {
            let lengths = function.quantities()[0].shape().lengths(program.sizes());
            lengths
                .last()
                .map_or_else(String::new, |k| format!(", {k}"))
        }
    };
    format!(
        "\nimpl {path}::{}<{scalar}, {n}{columns}> for {ROBOT} {{\n    \
         #[inline]\n    \
         fn {function}(&self, {}) -> {result} {{\n        \
         {body}\n    }}\n}}\n",
        function.camel(),
        parameters.join(", "),
    )
}

/// Returns whether a trait has this signature: a scene may have left arguments or rows out,
/// and parameters may be arguments.
fn fits(generated: &GeneratedFunction) -> bool {
    let program = &generated.program;
    question(generated.function).is_some() && is_whole(generated) && !program.arguments.is_empty()
}

fn is_whole(generated: &GeneratedFunction) -> bool {
    let program = &generated.program;
    let all: Vec<usize> = (0..program.joints).collect();
    program.arguments == generated.function.arguments() && program.rows == all
}

fn why(generated: &GeneratedFunction) -> &'static str {
    match question(generated.function) {
        Some(_) => "has other arguments or rows here than of a whole robot: call it by name.",
        None => "returns what is this module's own: call it by name.",
    }
}
