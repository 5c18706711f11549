//! Arguments of functions without bodies, those among them that are parameters.

use std::fmt::Write;

use dalembert_model::outputs::RuntimeParameter;

use crate::emit::arguments::{gravity_type, payload_type};
use crate::function::{Argument, Function, Sizes};
use crate::language::function::{LOAD, PAYLOAD, own_type};
use crate::program::ScalarType;

/// Returns the arguments of a function that takes these parameters.
pub(super) fn of(function: Function, taken: &[RuntimeParameter]) -> Vec<Argument> {
    let mut arguments = function.arguments();
    let taken = taken
        .iter()
        .filter(|&&parameter| function.depends_on(parameter));
    arguments.extend(taken.map(|parameter| parameter.argument()));
    arguments.sort();
    arguments
}

/// Returns the type of an argument: an array of entries, `length` of them if they are joints'.
pub(super) fn array(argument: Argument, entry: &str, length: &str) -> String {
    match own_type(argument) {
        Some(name) => format!("{name}<{entry}>"),
        None if argument.is_of_joints() => format!("[{entry}; {length}]"),
        None => format!("[{entry}; {}]", argument.length(Sizes::whole(0))),
    }
}

/// Returns the types of these parameters, and the function between a payload and its load.
pub(super) fn types(taken: &[RuntimeParameter], scalar: ScalarType) -> String {
    let mut text = String::new();
    if taken.contains(&RuntimeParameter::Gravity) {
        text += &gravity_type(scalar);
    }
    if taken.contains(&RuntimeParameter::Payload) {
        text += &payload_type(scalar, "that of the last joint");
        // How many numbers there are, the robot would have said. Writing to a string cannot
        // fail.
        let _ = writeln!(
            text,
            "#[derive(Clone, Copy, Debug, PartialEq)]\n\
             pub struct {LOAD}<T = {scalar}>(::core::marker::PhantomData<T>);\n\
             pub fn {}(_payload: &{PAYLOAD}) -> {LOAD} {{ ::core::unreachable!() }}",
            Function::Load
        );
    }
    text
}
