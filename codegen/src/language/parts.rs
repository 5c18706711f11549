//! Very long functions, cut into functions of their own.
//!
//! rustc's and LLVM's time for one function grows faster than its length; for
//! many short ones it grows with their number. Each part stands where its
//! statements would, and receives and returns every value under its own name,
//! so that the text still reads as one program from top to bottom:
//!
//! ```text
//! let [t9, t12] = {
//!     #[inline(never)]
//!     fn part(qd: &[f64; 6], [s1, c1, t3]: [f64; 3]) -> [f64; 2] {
//!         let t4 = s1 * qd[0];
//!         …
//!         [t9, t12]
//!     }
//!     part(qd, [s1, c1, t3])
//! };
//! ```

use std::collections::BTreeSet;
use std::fmt::Write;

use crate::function::{Argument, Sizes};
use crate::language::Printed;
use crate::language::dialect::Dialect;
use crate::program::fused::pieces;
use crate::program::text::input_name;
use crate::program::{Input, Literal, Lowered, Operand, ScalarType};

/// A function of more operations than this is printed in parts.
pub const LONG: usize = 5000;

/// Operations a part.
pub const PART: usize = 1000;

/// Prints the arithmetic in parts.
pub(super) fn write(text: &mut String, printed: &Printed<'_>) {
    let (code, scalar) = (printed.code, printed.code.scalar);
    let dialect = Dialect::rust(scalar);
    let last_use = last_uses(code);
    for part in pieces(&code.steps, PART) {
        let (start, end) = (part.start, part.end);
        let steps = &code.steps[part.clone()];
        let live = part.clone().filter(|&step| last_use[step] >= end);
        let live: Vec<String> = live.map(|step| format!("t{}", step + 1)).collect();
        let operands = steps.iter().flat_map(|step| [&step.left, &step.right]);
        let reads = Reads::of(operands, start);
        let (results, count) = (live.join(", "), live.len());
        let mut line = |indent: usize, line: &str| {
            // Writing to a string cannot fail.
            let _ = writeln!(text, "{:indent$}{line}", "");
        };
        line(4, &format!("let [{results}] = {{"));
        line(8, "#[inline(never)]");
        let parameters = reads.parameters(printed.sizes, scalar);
        line(
            8,
            &format!("fn part({parameters}) -> [{scalar}; {count}] {{"),
        );
        for statement in part.filter_map(|index| dialect.statement(code, index)) {
            line(12, &statement);
        }
        line(12, &format!("[{results}]"));
        line(8, "}");
        line(8, &format!("part({})", reads.arguments()));
        line(4, "};");
    }
}

/// What a part reads from outside.
#[derive(Default)]
struct Reads {
    /// Whether it reads each argument.
    arrays: [bool; Argument::COUNT],
    /// Sines, cosines and earlier steps.
    values: Vec<String>,
}

impl Reads {
    fn of<'a>(operands: impl Iterator<Item = &'a Operand<Literal>>, start: usize) -> Reads {
        let (mut arrays, mut trig, mut steps) =
            ([false; Argument::COUNT], BTreeSet::new(), BTreeSet::new());
        for operand in operands {
            match operand {
                Operand::Input(Input::Entry(argument, _)) => arrays[argument.index()] = true,
                Operand::Input(input) => {
                    trig.insert(*input);
                }
                Operand::Step(step) if *step < start => {
                    steps.insert(*step);
                }
                Operand::Step(_) | Operand::Constant(_) => {}
            }
        }
        let trig = trig.into_iter().map(input_name);
        let steps = steps.into_iter().map(|step| format!("t{}", step + 1));
        Reads {
            arrays,
            values: trig.chain(steps).collect(),
        }
    }

    fn arrays(&self) -> impl Iterator<Item = Argument> + '_ {
        let arguments = Argument::ALL.into_iter().zip(self.arrays);
        arguments.filter_map(|(argument, read)| read.then_some(argument))
    }

    fn parameters(&self, sizes: Sizes, scalar: ScalarType) -> String {
        let parameter = |argument: Argument| {
            let (name, length) = (argument.name(), argument.length(sizes));
            format!("{name}: &[{scalar}; {length}]")
        };
        let mut parameters: Vec<String> = self.arrays().map(parameter).collect();
        let (names, count) = (self.values.join(", "), self.values.len());
        parameters.push(format!("[{names}]: [{scalar}; {count}]"));
        parameters.join(", ")
    }

    fn arguments(&self) -> String {
        let mut arguments: Vec<String> = self.arrays().map(|a| a.name().to_owned()).collect();
        arguments.push(format!("[{}]", self.values.join(", ")));
        arguments.join(", ")
    }
}

/// Returns the last step that reads each step; past the end for results.
pub(super) fn last_uses(code: &Lowered) -> Vec<usize> {
    let mut last = vec![0; code.steps.len()];
    for (index, step) in code.steps.iter().enumerate() {
        for operand in [&step.left, &step.right] {
            if let Operand::Step(read) = operand {
                last[*read] = index;
            }
        }
    }
    for output in &code.outputs {
        if let Operand::Step(read) = output.value {
            last[read] = usize::MAX;
        }
    }
    last
}
