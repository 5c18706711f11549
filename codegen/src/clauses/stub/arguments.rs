//! Arguments of functions without bodies, those among them that are parameters.

use std::fmt::Write;

use dalembert_model::outputs::RuntimeParameter;

use crate::function::{Argument, Function, Sizes};
use crate::language::function::{LOAD, PAYLOAD};
use crate::program::ScalarType;

/// The arguments of a function that takes these parameters.
pub(super) fn of(function: Function, taken: &[RuntimeParameter]) -> Vec<Argument> {
    let mut arguments = function.arguments();
    let taken = taken
        .iter()
        .filter(|&&parameter| function.depends_on(parameter));
    arguments.extend(taken.map(|parameter| parameter.argument()));
    arguments.sort();
    arguments
}

/// An argument's array of entries, `length` of them if they are joints'.
pub(super) fn array(argument: Argument, entry: &str, length: &str) -> String {
    match argument {
        // How many there are, the robot would have said.
        Argument::Load => LOAD.to_owned(),
        other if other.is_of_joints() => format!("[{entry}; {length}]"),
        other => format!("[{entry}; {}]", other.length(Sizes::whole(0))),
    }
}

/// The types of a payload and of its load, and the function between them.
pub(super) fn types(taken: &[RuntimeParameter], scalar: ScalarType) -> String {
    let mut text = String::new();
    if taken.contains(&RuntimeParameter::Payload) {
        let length = Argument::Payload.length(Sizes::whole(0));
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "pub type {PAYLOAD} = [{scalar}; {length}];\n\
             #[derive(Clone, Copy, Debug, PartialEq)]\npub struct {LOAD};\n\
             pub fn {}(_payload: &{PAYLOAD}) -> {LOAD} {{ ::core::unreachable!() }}",
            Function::Load
        );
    }
    text
}
