//! The robot as a value: a type that answers by the traits of `dalembert`, for code
//! that is generic over robots.

use std::fmt::Write;

use super::GeneratedFunction;
use crate::backend::function::result_type;
use crate::function::{Columns, Function};
use crate::program::ScalarType;

/// The type that has the traits.
pub const ROBOT: &str = "Robot";

/// How code meets a module.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Interface {
    /// By its functions.
    #[default]
    Functions,
    /// Also by a type with the traits of `dalembert`, which every robot can have.
    Traits,
}

impl Interface {
    /// Both, the default first.
    pub const ALL: [Interface; 2] = [Interface::Functions, Interface::Traits];

    /// Its name on the command line and in the macro.
    pub fn name(self) -> &'static str {
        match self {
            Interface::Functions => "functions",
            Interface::Traits => "traits",
        }
    }
}

/// The trait that asks what a function answers, for one array of the robot's size.
/// Structs and the columns of regressors are each module's own.
pub fn question(function: Function) -> Option<String> {
    let is_array = function.structure().is_none() && function.columns() == Columns::None;
    (is_array && function != Function::Load).then(|| function.camel())
}

/// The type and what it answers; `path` is where the traits are.
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
        let (function, program) = (generated.function, &generated.program);
        let n = program.joints;
        let names: Vec<&str> = program.arguments.iter().map(|a| a.name()).collect();
        let parameters = names.iter().map(|name| format!("{name}: &[{scalar}; {n}]"));
        let parameters: Vec<String> = parameters.collect();
        let _ = writeln!(
            text,
            "\nimpl {path}::{}<{scalar}, {n}> for {ROBOT} {{\n    \
             #[inline]\n    \
             fn {function}(&self, {}) -> {} {{\n        \
             {function}({})\n    }}\n}}",
            function.camel(),
            parameters.join(", "),
            result_type(function, program.sizes(), scalar),
            names.join(", ")
        );
    }
    text
}

/// Whether a trait has this signature: a scene may have left arguments or rows out,
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
