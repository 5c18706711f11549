//! The box of states in which functions hold that do not hold everywhere: those that a tolerance was
//! applied to, and those whose sines are polynomials.
//!
//! The module says it in numbers, `BOX`, and asks for a caller whether a state
//! is inside, `in_box`. A controller does that before it trusts a torque.

use super::GeneratedFunction;
use super::variant::held;
use crate::function::{Argument, Sizes};
use crate::language::c99::{Names, float};
use crate::language::list;
use crate::program::{Literal, ScalarType};
use crate::setup::Setup;
use crate::sincos;
use crate::sincos::interval::Interval;
use crate::tolerance::variant::Variant;

pub(super) struct StateBox {
    pub(super) columns: Vec<(Argument, Vec<Option<Interval>>)>,
}

impl StateBox {
    pub(super) fn of(
        functions: &[GeneratedFunction],
        setup: &Setup,
        scalar: ScalarType,
    ) -> Option<StateBox> {
        let sizes = Sizes::of(setup.robot());
        let columns = Argument::STATE.into_iter().map(|argument| {
            let mut column = vec![None; argument.length(sizes)];
            for generated in functions {
                bound(&mut column, argument, generated, setup, scalar);
            }
            (argument, column)
        });
        let is_bounded =
            |column: &(Argument, Vec<Option<Interval>>)| column.1.iter().any(Option::is_some);
        let columns: Vec<_> = columns.filter(is_bounded).collect();
        (!columns.is_empty()).then_some(StateBox { columns })
    }

    pub(super) fn write(&self, text: &mut String, scalar: ScalarType) {
        text.push_str(
            "\n/// The lowest and the highest entries of arguments for which the functions of this\n\
             /// module hold; an infinite end bounds nothing.\n\
             pub const BOX: StateBox = StateBox {\n",
        );
        for (argument, column) in &self.columns {
            *text += &format!("    {}: [\n", argument.name());
            for range in column {
                let [low, high] = ends(*range, scalar);
                *text += &format!("        [{low}, {high}],\n");
            }
            text.push_str("    ],\n");
        }
        text.push_str(
            "};\n\n\
             /// A box of states: the lowest and the highest entry for each joint.\n\
             #[derive(Clone, Copy, Debug, PartialEq)]\n\
             pub struct StateBox {\n",
        );
        for (argument, column) in &self.columns {
            let (name, what, n) = (argument.name(), argument.meaning(), column.len());
            *text += &format!("    /// {what}\n    pub {name}: [[{scalar}; 2]; {n}],\n");
        }
        text.push_str(
            "}\n\n\
             /// True if a state is inside [`BOX`], ends included. The error bounds of this module's\n\
             /// functions hold only there. A state with a NaN is not inside.\n\
             #[must_use]\n",
        );
        let parameters = self.columns.iter().map(|(argument, column)| {
            format!("{}: &[{scalar}; {}]", argument.name(), column.len())
        });
        let parameters = list(parameters);
        *text += &format!("pub fn in_box({parameters}) -> bool {{\n    let inside = true;\n");
        for (argument, column) in &self.columns {
            let name = argument.name();
            for joint in (0..column.len()).filter(|&joint| column[joint].is_some()) {
                *text += &format!(
                    "    let inside = inside & (BOX.{name}[{joint}][0] <= {name}[{joint}]) & \
                     ({name}[{joint}] <= BOX.{name}[{joint}][1]);\n"
                );
            }
        }
        text.push_str("    inside\n}\n");
    }

    pub(super) fn write_c(&self, text: &mut String, scalar: ScalarType, names: &Names) {
        let (float, restrict) = (float(scalar), names.constant("RESTRICT"));
        let dialect = names.dialect();
        let parameters = self.columns.iter().map(|(argument, column)| {
            let (name, length) = (argument.name(), column.len());
            format!("const {float} {name}[{restrict} {length}]")
        });
        *text += &format!(
            "\n/* Whether a state is where the functions hold, ends included: 1 or 0. The error bounds\n \
             * hold only there. A state with a NaN is not inside. */\n\
             {} int {}({})\n{{\n    int inside = 1;\n",
            dialect.function,
            names.of("in_box"),
            list(parameters)
        );
        for (argument, column) in &self.columns {
            let name = argument.name();
            for (joint, range) in column.iter().enumerate().filter(|(_, r)| r.is_some()) {
                let [low, high] = ends(*range, scalar).map(|end| dialect.digits(&end));
                *text += &format!(
                    "    if (!(({low} <= {name}[{joint}]) && ({name}[{joint}] <= {high}))) {{\n        \
                     inside = 0;\n    }}\n"
                );
            }
        }
        text.push_str("    return inside;\n}\n");
    }
}

fn bound(
    column: &mut [Option<Interval>],
    argument: Argument,
    generated: &GeneratedFunction,
    setup: &Setup,
    scalar: ScalarType,
) {
    if generated.admitted.is_some() {
        let reads = |variant: &&Variant| variant.emitted.arguments.contains(&argument);
        let Some(variant) = generated.variant(scalar).filter(reads) else {
            return;
        };
        let base = match argument {
            Argument::Position => 0,
            _ => setup.robot().base_coordinates(),
        };
        for (index, place) in column.iter_mut().enumerate() {
            let joint = index.checked_sub(base);
            if joint.is_none_or(|joint| setup.lock(joint).is_none())
                && let Some(range) = held(variant, setup, argument, index)
            {
                *place = Some(narrower(*place, range));
            }
        }
    } else if argument == Argument::Position {
        let positions = sincos::positions(setup.robot(), scalar);
        let sines = generated.sines(scalar).iter();
        for joint in sines.map(|sine| sine.joint) {
            if let (Some(place), Some(range)) = (column.get_mut(joint), positions.get(joint)) {
                *place = Some(narrower(*place, *range));
            }
        }
    }
}

fn narrower(known: Option<Interval>, range: Interval) -> Interval {
    let both = known.and_then(|known| {
        Interval::new(known.low().max(range.low()), known.high().min(range.high()))
    });
    both.unwrap_or(range)
}

/// Returns the outermost numbers of the scalar that are inside a range.
fn ends(range: Option<Interval>, scalar: ScalarType) -> [String; 2] {
    let Some(range) = range else {
        return ["NEG_INFINITY", "INFINITY"].map(|end| format!("{scalar}::{end}"));
    };
    let mut ends = [scalar.above(range.low()), -scalar.above(-range.high())];
    if ends[0] > ends[1] {
        // A point between two numbers becomes the next one: the checker's box has both.
        ends = [ends[0]; 2];
    }
    ends.map(|end| Literal(end).text(scalar))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_are_inside() {
        let pi = std::f64::consts::PI;
        for (low, high) in [(-pi, pi), (-0.1, 0.3), (0.0, 1e6), (-1.0, 2.0)] {
            let range = Interval::new(low, high).unwrap();
            let read = ends(Some(range), ScalarType::F64).map(|end| end.parse::<f64>().unwrap());
            assert_eq!(read, [low, high]);
            let read = ends(Some(range), ScalarType::F32).map(|end| end.parse::<f32>().unwrap());
            assert!(f64::from(read[0]) >= low && f64::from(read[1]) <= high);
            assert!(f64::from(read[0].next_down()) < low && f64::from(read[1].next_up()) > high);
        }
        let infinite = ["f32::NEG_INFINITY", "f32::INFINITY"];
        assert_eq!(ends(None, ScalarType::F32), infinite);
    }
}
