//! The load: the numbers that the function `load` makes of a payload, over all bodies that one may be.

use crate::fault::Fault;
use crate::identity::exact::Exact;
use crate::identity::setting::Setting;
use crate::interval::Interval;
use crate::payload::Body;
use crate::program::{ARGUMENTS, LOAD, Operand, Program, Step, argument};
use crate::read;
use crate::rounding::{Ranges, Rounding, Value};
use crate::written::at;

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
            let outward = bodies.into_iter().map(|own| own.outward(is_single));
            ranges[place] = outward.flat_map(Body::ranges).collect();
        }
        let text = literals(load);
        let values = Rounding::new(&text, is_single, &ranges).bounds(&ranges, None);
        let values = values.results;
        let entries = values.iter().map(|own| [own.exact.low, own.exact.high]);
        ranges[place] = entries.collect();
        Ok((ranges, values))
    }
}

pub(crate) fn load_of_point(
    load: &Program<Exact>,
    mass: f64,
    at_point: [f64; 3],
) -> Result<Vec<Interval>, Fault> {
    let numbers = [&[mass][..], &at_point, &[0.0; 6]].concat();
    let mut given = vec![Vec::new(); ARGUMENTS.len()];
    let numbers = numbers.into_iter().map(Interval::point);
    given[argument("payload").unwrap_or_default()] = numbers.collect();
    let values = at(load, &given);
    values.ok_or_else(|| Fault::Claim("`load` reads what is not a payload".into()))
}

/// Returns a program with the nearest double in place of each constant.
pub(crate) fn literals(own: &Program<Exact>) -> read::Function {
    let operand = |own: &Operand<Exact>| match own {
        // An angle beyond the series' range is not a number.
        Operand::Constant(own) => Operand::Constant(own.double().map_or(f64::NAN, |own| own[0])),
        Operand::Step(step) => Operand::Step(*step),
        Operand::Entry(place, index) => Operand::Entry(*place, *index),
        Operand::Sine(joint, is_sine) => Operand::Sine(*joint, *is_sine),
        Operand::Speed(joint) => Operand::Speed(*joint),
    };
    let step = |(operation, both): &Step<Exact>| (*operation, both.each_ref().map(operand));
    let output = |(negative, own): &(bool, Operand<Exact>)| (*negative, operand(own));
    read::Function {
        program: Program {
            steps: own.steps.iter().map(step).collect(),
            outputs: own.outputs.iter().map(output).collect(),
        },
        ..read::Function::default()
    }
}
