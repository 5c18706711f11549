//! The load: the numbers that the function `load` makes of a payload, over all bodies that one may be.

use crate::fault::Fault;
use crate::identity::exact::Exact;
use crate::identity::setting::Setting;
use crate::interval::Interval;
use crate::payload::BodyRange;
use crate::program::{ARGUMENTS, LOAD, Operand, Program, Step, argument};
use crate::read;
use crate::rounding::{Ranges, Rounding, Value};
use crate::written::evaluate;

impl Setting<'_> {
    /// Returns the box of a function's states, with that of its load and the load's entries; of a
    /// function that takes none they are empty.
    pub(crate) fn loaded_box(
        &self,
        places: &[usize],
        is_single: bool,
        load: Option<&Program<Exact>>,
    ) -> Result<(Ranges, Vec<Value>), Fault> {
        let of_robot = |why| Fault::Robot("limits".into(), why);
        let mut ranges = self.state_box(places, is_single)?;
        let (Some(load), Some(place)) = (load, argument(LOAD)) else {
            return Ok((ranges, Vec::new()));
        };
        for (place, bodies) in self.bodies_given().map_err(of_robot)? {
            let outward = bodies.into_iter().map(|body| body.outward(is_single));
            ranges[place] = outward.flat_map(BodyRange::ranges).collect();
        }
        let text = literals(load);
        let rounding = Rounding::new(&text, is_single, &ranges);
        let values = rounding.bounds(&ranges, None).results;
        ranges[place] = values.iter().map(|value| value.exact.ends()).collect();
        Ok((ranges, values))
    }
}

pub(crate) fn load_of_point(
    load: &Program<Exact>,
    mass: f64,
    at_point: [f64; 3],
) -> Result<Vec<Interval>, Fault> {
    let numbers = [&[mass][..], &at_point, &[0.0; 6]].concat();
    let mut arguments = vec![Vec::new(); ARGUMENTS.len()];
    let numbers = numbers.into_iter().map(Interval::point);
    arguments[argument("payload").unwrap_or_default()] = numbers.collect();
    let values = evaluate(load, &arguments);
    values.ok_or_else(|| Fault::Claim("`load` reads what is not a payload".into()))
}

/// Returns a program with the nearest double in place of each constant.
pub(crate) fn literals(program: &Program<Exact>) -> read::ReadFunction {
    let operand = |operand: &Operand<Exact>| match operand {
        // An angle beyond the series' range is not a number.
        Operand::Constant(constant) => {
            Operand::Constant(constant.double().map_or(f64::NAN, |double| double[0]))
        }
        Operand::Step(step) => Operand::Step(*step),
        Operand::Entry(place, index) => Operand::Entry(*place, *index),
        Operand::Sine(joint, is_sine) => Operand::Sine(*joint, *is_sine),
        Operand::Speed(joint) => Operand::Speed(*joint),
    };
    let step = |(operation, both): &Step<Exact>| (*operation, both.each_ref().map(operand));
    let output = |(negative, result): &(bool, Operand<Exact>)| (*negative, operand(result));
    read::ReadFunction {
        program: Program {
            steps: program.steps.iter().map(step).collect(),
            outputs: program.outputs.iter().map(output).collect(),
        },
        ..read::ReadFunction::default()
    }
}
