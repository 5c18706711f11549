//! What stands for the modules after an error: the same functions without
//! bodies, so that only the error is reported and not every call as well.
//!
//! - `arguments`: those that are no joint vectors
//! - `entries`: a function, and more ways to call it

use std::collections::BTreeSet;
use std::fmt::Write;

use dalembert_model::outputs::RuntimeParameter;

mod arguments;
mod entries;

use crate::clauses::invocation::Invocation;
use crate::emit::module;
use crate::function::{Argument, Function};
use crate::language::Entries;
use crate::program::ScalarType;
use crate::sincos::SinCos;
use crate::task::Interface;

/// Returns the modules' text. Without a number of joints the functions take arrays
/// of any length.
pub(super) fn write(invocation: &Invocation, joints: Option<usize>) -> String {
    let mut text = String::new();
    let chosen = invocation.outputs.iter().flatten().map(|(f, _)| *f);
    let chosen: Vec<Function> = chosen.collect();
    let functions = match chosen.as_slice() {
        // Whatever the caller calls is there.
        [] => Function::ALL.as_slice(),
        chosen => chosen,
    };
    let scalars = match invocation.scalars.as_deref() {
        None | Some([]) => &[ScalarType::F64],
        Some(chosen) => chosen,
    };
    for &scalar in scalars {
        let base = invocation.name.to_string();
        let name = module::name(&base, scalar, scalars);
        let count = joints.unwrap_or(1);
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "#[allow(dead_code)]\npub mod {name} {{\npub const N: usize = {count};"
        );
        if invocation.request.entries > Entries::Single {
            text += &entries::angles(joints, scalar);
        }
        let taken: Vec<RuntimeParameter> = invocation.parameters.iter().map(|(p, _)| *p).collect();
        text += &arguments::types(&taken, scalar);
        for &function in functions {
            let given = arguments::of(function, &taken);
            text += &entries::write(function, &given, joints, scalar, invocation.request.entries);
        }
        if invocation.request.interface == Interface::Traits {
            let given = functions.iter().map(|&f| (f, arguments::of(f, &taken)));
            let given: Vec<(Function, Vec<Argument>)> = given.collect();
            text += &entries::robot(&given, joints, scalar);
        }
        let results = functions.iter().flat_map(|f| f.quantities());
        // Once, whoever has them.
        let constants = results.filter_map(|quantity| quantity.linear());
        let constants: BTreeSet<&str> = constants.map(|(_, constant)| constant).collect();
        for constant in constants {
            let _ = writeln!(text, "pub const {constant}: &[{scalar}] = &[];");
        }
        text += &state_box(&bounded(invocation, functions), joints, scalar);
        text += "}\n";
    }
    text
}

/// Returns the arguments that `BOX` may bound: those of all functions in a scene, which
/// may have a tolerance, and the positions of sines by polynomials alone.
fn bounded(invocation: &Invocation, functions: &[Function]) -> Vec<Argument> {
    let taken = |argument: &Argument| match (&invocation.scene, invocation.request.sincos) {
        (Some(_), _) => functions.iter().any(|f| f.arguments().contains(argument)),
        (None, SinCos::Polynomial { .. }) => *argument == Argument::Position,
        (None, _) => false,
    };
    let all = Argument::STATE.into_iter();
    all.filter(taken).collect()
}

/// Returns `BOX` and `in_box`, if arguments are bounded.
fn state_box(arguments: &[Argument], joints: Option<usize>, scalar: ScalarType) -> String {
    let mut text = String::new();
    if arguments.is_empty() {
        return text;
    }
    let (length, generic) = match joints {
        Some(n) => (n.to_string(), ""),
        None => ("L".to_owned(), "<const L: usize>"),
    };
    let stored = joints.unwrap_or(1);
    let (mut fields, mut values, mut parameters) = (Vec::new(), Vec::new(), Vec::new());
    for argument in arguments {
        let name = argument.name();
        fields.push(format!("pub {name}: [[{scalar}; 2]; {stored}]"));
        values.push(format!("{name}: [[0.0; 2]; {stored}]"));
        parameters.push(format!("_{name}: &[{scalar}; {length}]"));
    }
    // Writing to a string cannot fail.
    let _ = writeln!(
        text,
        "#[derive(Clone, Copy, Debug, PartialEq)]\npub struct StateBox {{ {} }}\n\
         pub const BOX: StateBox = StateBox {{ {} }};\n\
         pub fn in_box{generic}({}) -> bool {{ ::core::unreachable!() }}",
        fields.join(", "),
        values.join(", "),
        parameters.join(", ")
    );
    text
}
