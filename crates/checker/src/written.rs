//! Programs written out: as intervals at a state, as polynomials over a box.

use crate::fault::Fault;
use crate::identity::exact::Exact;
use crate::interval::Interval;
use crate::polynomial::{Polynomial, Variable};
use crate::program::{Operand, Program};
use crate::ring::Ring;
use crate::rounding::Rounding;
use crate::work::Work;

pub(crate) fn at(program: &Program<Exact>, given: &[Vec<f64>]) -> Option<Vec<Interval>> {
    let leaf = |own: &Operand<Exact>| match own {
        Operand::Constant(constant) => {
            let [value, radius] = constant.double()?;
            Some(Interval::around(value, radius))
        }
        Operand::Entry(place, joint) => Some(Interval::point(*given.get(*place)?.get(*joint)?)),
        Operand::Sine(joint, is_sine) => {
            let angle = Interval::point(*given.first()?.get(*joint)?);
            Some(angle.sine(*is_sine))
        }
        _ => None,
    };
    let apply = |operation: char, a: Interval, b: Interval| match operation {
        '+' => a + b,
        '-' => a + -b,
        '*' | '×' => a * b,
        _ => Interval::NOTHING_KNOWN,
    };
    program.run(leaf, apply, |own: Interval| -own)
}

/// Sines by polynomials have an error that is a variable.
pub(crate) fn written(
    program: &Program<Exact>,
    ring: &Ring,
    sines: Option<&Rounding>,
    work: &Work,
) -> Result<(Vec<f64>, Vec<Polynomial>), Fault> {
    let counted = uses(program);
    let mut own = Values {
        ring,
        sines,
        values: vec![None; counted.len()],
        left: counted.clone(),
    };
    let mut sizes = vec![f64::INFINITY; counted.len()];
    for (index, (operation, [one, other])) in program.steps.iter().enumerate() {
        if counted[index] == 0 {
            continue;
        }
        let (a, b) = (own.read(one)?, own.read(other)?);
        let value = match operation {
            '+' => a.sum(&b, work)?,
            '-' => a.sum(&b.negated(), work)?,
            '*' | '×' => a.times(&b, work)?,
            _ => return Err(Fault::Claim("tolerance: the program divides".into())),
        };
        sizes[index] = ring.size(&value);
        own.values[index] = Some(value);
    }
    let outputs = program.outputs.iter().map(|(negative, output)| {
        let value = own.read(output)?;
        Ok(if *negative { value.negated() } else { value })
    });
    let outputs = outputs.collect::<Result<_, Fault>>()?;
    Ok((sizes, outputs))
}

struct Values<'v> {
    ring: &'v Ring,
    sines: Option<&'v Rounding<'v>>,
    values: Vec<Option<Polynomial>>,
    left: Vec<usize>,
}

impl Values<'_> {
    /// Reads an operand; who is the last to read a step takes its value away.
    fn read(&mut self, own: &Operand<Exact>) -> Result<Polynomial, Fault> {
        let value = match own {
            Operand::Step(step) => {
                self.left[*step] -= 1;
                match self.left[*step] {
                    0 => self.values[*step].take(),
                    _ => self.values[*step].clone(),
                }
            }
            Operand::Constant(constant) => {
                let double = constant.double();
                double.map(|[value, radius]| Polynomial::constant(value, radius))
            }
            own => self.ring.leaf(own),
        };
        let why = "tolerance: it reads an angle as a number, or what is no state";
        let value = value.ok_or_else(|| Fault::Claim(why.into()))?;
        let Operand::Sine(joint, is_sine) = own else {
            return Ok(value);
        };
        let error = self.sines.and_then(|own| own.polynomial(*joint, *is_sine));
        let variable = [Variable::EvenError, Variable::OddError][usize::from(*is_sine)];
        Ok(match error {
            Some(error) => value.plus(&Polynomial::variable(variable, *joint, error)),
            None => value,
        })
    }
}

/// Counts how often each step is read on the way to the results: never, if it is in vain.
fn uses(program: &Program<Exact>) -> Vec<usize> {
    let mut all = vec![0; program.steps.len()];
    let step = |own: &Operand<Exact>| match own {
        Operand::Step(step) => Some(*step),
        _ => None,
    };
    let outputs = program.outputs.iter().filter_map(|own| step(&own.1));
    outputs.for_each(|step| all[step] += 1);
    for (index, (_, operands)) in program.steps.iter().enumerate().rev() {
        if all[index] > 0 {
            let own = operands.iter().filter_map(step);
            own.for_each(|step| all[step] += 1);
        }
    }
    all
}
