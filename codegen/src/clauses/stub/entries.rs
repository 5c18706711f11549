//! The other ways to call a function, without bodies.

use std::fmt::Write;

use dalembert_model::outputs::Axis;

use super::arguments;
use crate::clauses::module::{BATCH, TRAITS};
use crate::emit::interface::{ROBOT, answer, question};
use crate::function::{Argument, Columns, Function, Quantity};
use crate::language::Entries;
use crate::program::ScalarType;

/// Returns what a module has of a function beside itself. Lengths that are not known are
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
    let mut text = String::new();
    if entries >= Entries::WithSincos {
        own.with_sincos(&mut text);
    }
    if entries >= Entries::Lanes {
        own.lanes(&mut text);
    }
    if entries >= Entries::Batch {
        own.batch(&mut text);
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

    fn with_sincos(&self, text: &mut String) {
        let (name, scalar) = (self.function.name(), self.scalar);
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "pub fn {name}_with_sincos{}({}_sin: &[{scalar}; A], _cos: &[{scalar}; A]) -> {} \
             {{ ::core::unreachable!() }}",
            self.generic(&["A"]),
            self.arguments(scalar.name()),
            self.result(scalar.name(), "", &[])
        );
    }

    fn lanes(&self, text: &mut String) {
        let name = self.function.name();
        let entry = format!("[{}; L]", self.scalar);
        if let Some(structure) = self.function.structure() {
            let quantities = self.function.quantities().iter();
            let fields = quantities.map(|&quantity| {
                format!("pub {}: {}", quantity.field(), self.array(&entry, quantity))
            });
            let fields: Vec<String> = fields.collect();
            let _ = writeln!(
                text,
                "#[derive(Clone, Copy, Debug, PartialEq)]\npub struct {structure}Lanes{} {{ {} }}",
                self.generic(&["L"]),
                fields.join(", ")
            );
        }
        let _ = writeln!(
            text,
            "pub fn {name}_lanes{}({}) -> {} {{ ::core::unreachable!() }}",
            self.generic(&["L"]),
            self.arguments(&entry),
            self.result(&entry, "Lanes", &["L"])
        );
    }

    fn batch(&self, text: &mut String) {
        let (name, scalar, length) = (self.function.name(), self.scalar, self.length());
        let _ = writeln!(
            text,
            "pub fn {name}_batch{}({}_results: &mut [{}]) -> Result<(), {BATCH}::Unequal> \
             {{ ::core::unreachable!() }}\n\
             pub fn {name}_columns{}({}_results: &mut [&mut [{scalar}]; M]) -> \
             Result<(), {BATCH}::Unequal> {{ ::core::unreachable!() }}",
            self.generic(&[]),
            self.states(&format!("&[[{scalar}; {length}]]")),
            self.result(scalar.name(), "", &[]),
            self.generic(&["M"]),
            self.states(&format!("&[&[{scalar}]; {length}]")),
        );
    }
}
