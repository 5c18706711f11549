//! A function and the other ways to call it, without bodies.

use std::fmt::Write;

use dalembert_model::outputs::Axis;

use super::arguments;
use crate::clauses::module::{BATCH, TRAITS};
use crate::emit::interface::{ROBOT, answer, question};
use crate::function::{Argument, Columns, Function, Quantity};
use crate::language::Entries;
use crate::program::ScalarType;

/// Returns a function, and the other ways to call it. Lengths that are not known are
/// whatever the caller has.
pub(super) fn write(
    function: Function,
    given: &[Argument],
    joints: Option<usize>,
    scalar: ScalarType,
    entries: Entries,
) -> String {
    let own = Stub {
        function,
        given,
        joints,
        scalar,
    };
    let (mut text, one) = (String::new(), scalar.name());
    let (arguments, result) = (own.arguments(one), own.result(one, "", &[]));
    own.structure(&mut text, one, "", &[]);
    own.declare(&mut text, "", &[], &arguments, &result);
    if entries >= Entries::WithSincos {
        let arguments = format!("{arguments}_sin: &[{one}; A], _cos: &[{one}; A]");
        own.declare(&mut text, "_with_sincos", &["A"], &arguments, &result);
    }
    if entries >= Entries::Lanes {
        let lanes = format!("[{one}; L]");
        own.structure(&mut text, &lanes, "Lanes", &["L"]);
        let (arguments, result) = (own.arguments(&lanes), own.result(&lanes, "Lanes", &["L"]));
        own.declare(&mut text, "_lanes", &["L"], &arguments, &result);
    }
    if entries >= Entries::Batch {
        let (length, done) = (own.length(), format!("Result<(), {BATCH}::Unequal>"));
        let rows = own.states(&format!("&[[{one}; {length}]]"));
        let rows = format!("{rows}_results: &mut [{result}]");
        own.declare(&mut text, "_batch", &[], &rows, &done);
        let columns = own.states(&format!("&[&[{one}]; {length}]"));
        let columns = format!("{columns}_results: &mut [&mut [{one}]; M]");
        own.declare(&mut text, "_columns", &["M"], &columns, &done);
    }
    text
}

/// Returns the robot as a value, with the traits of these functions, each with its
/// arguments.
pub(super) fn robot(
    functions: &[(Function, Vec<Argument>)],
    joints: Option<usize>,
    scalar: ScalarType,
) -> String {
    let mut text = format!(
        "#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]\npub struct {ROBOT};\n"
    );
    for (function, given) in functions {
        let own = Stub {
            function: *function,
            given,
            joints,
            scalar,
        };
        if *given == function.arguments() {
            own.answer(&mut text);
        }
    }
    text
}

/// Returns the angles, of which nobody knows how many they are.
pub(super) fn angles(joints: Option<usize>, scalar: ScalarType) -> String {
    let (generic, length) = match joints {
        Some(n) => ("<const A: usize>", n.to_string()),
        None => ("<const J: usize, const A: usize>", "J".to_owned()),
    };
    format!(
        "pub fn angles{generic}(_q: &[{scalar}; {length}]) -> [{scalar}; A] \
         {{ ::core::unreachable!() }}\n"
    )
}

struct Stub<'a> {
    function: Function,
    given: &'a [Argument],
    joints: Option<usize>,
    scalar: ScalarType,
}

impl Stub<'_> {
    /// Returns the number of joints, or the name that stands for it.
    fn length(&self) -> String {
        self.joints.map_or("J".to_owned(), |n| n.to_string())
    }

    /// Returns what generic parameters there are, with that of the joints if nobody
    /// knows how many they are.
    fn generic(&self, others: &[&str]) -> String {
        let joints = self.joints.is_none().then_some("J");
        let all = others.iter().copied().chain(joints);
        let all: Vec<String> = all.map(|name| format!("const {name}: usize")).collect();
        match all.is_empty() {
            true => String::new(),
            false => format!("<{}>", all.join(", ")),
        }
    }

    /// Returns the arguments, each an array of these.
    fn arguments(&self, entry: &str) -> String {
        let argument = |&argument: &Argument| {
            let kind = arguments::array(argument, entry, &self.length());
            format!("_{}: &{kind}, ", argument.name())
        };
        self.given.iter().map(argument).collect()
    }

    /// Returns the arguments of many states, each of this type.
    fn states(&self, kind: &str) -> String {
        let each = self.given.iter();
        each.map(|argument| format!("_{}: {kind}, ", argument.name()))
            .collect()
    }

    fn array(&self, entry: &str, quantity: Quantity) -> String {
        let axes = quantity.shape().0.iter().rev();
        axes.fold(entry.to_owned(), |inner, axis| match axis {
            Axis::Joints => format!("[{inner}; {}]", self.length()),
            Axis::Fixed(length) => format!("[{inner}; {length}]"),
            // As many as the robot would have said.
            Axis::LinkParameters | Axis::BaseParameters | Axis::Load => {
                format!("&'static [{inner}]")
            }
        })
    }

    /// Returns what it returns, with such entries; a struct has `lanes` in its name and
    /// its parameters.
    fn result(&self, entry: &str, lanes: &str, parameters: &[&str]) -> String {
        match self.function.structure() {
            None => self.array(entry, self.function.quantities()[0]),
            Some(name) => {
                let joints = self.joints.is_none().then_some("J");
                let all: Vec<&str> = parameters.iter().copied().chain(joints).collect();
                match all.is_empty() {
                    true => format!("{name}{lanes}"),
                    false => format!("{name}{lanes}<{}>", all.join(", ")),
                }
            }
        }
    }

    fn answer(&self, text: &mut String) {
        let Some(question) = question(self.function) else {
            return;
        };
        let (scalar, length) = (self.scalar, self.length());
        // A regressor has as many columns as who asks expects.
        let columns = match self.function.columns() {
            Columns::None => None,
            Columns::Links | Columns::Base(_) => Some("K"),
        };
        let result = match (answer(self.function, TRAITS, scalar, &length), columns) {
            (Some(answer), _) => answer,
            (None, Some(columns)) => format!("[[{scalar}; {columns}]; {length}]"),
            (None, None) => self.result(scalar.name(), "", &[]),
        };
        let more = columns.map_or_else(String::new, |columns| format!(", {columns}"));
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "impl{} {TRAITS}::{question}<{scalar}, {length}{more}> for {ROBOT} {{ \
             fn {}(&self, {}) -> {result} {{ ::core::unreachable!() }} }}",
            self.generic(columns.as_slice()),
            self.function,
            self.arguments(scalar.name()),
        );
    }

    /// Writes the struct that it returns with such entries, if it returns one.
    fn structure(&self, text: &mut String, entry: &str, lanes: &str, parameters: &[&str]) {
        let Some(name) = self.function.structure() else {
            return;
        };
        let quantities = self.function.quantities().iter();
        let fields: Vec<String> = quantities
            .map(|&quantity| format!("pub {}: {}", quantity.field(), self.array(entry, quantity)))
            .collect();
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "#[derive(Clone, Copy, Debug, PartialEq)]\npub struct {name}{lanes}{} {{ {} }}",
            self.generic(parameters),
            fields.join(", ")
        );
    }

    /// Writes a function whose name ends so.
    fn declare(&self, text: &mut String, end: &str, generic: &[&str], given: &str, result: &str) {
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "pub fn {}{end}{}({}) -> {result} {{ ::core::unreachable!() }}",
            self.function,
            self.generic(generic),
            given.trim_end_matches(", "),
        );
    }
}
