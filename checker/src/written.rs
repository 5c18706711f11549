//! Programs written out: as intervals at a state, as polynomials over a box.

use crate::fault::Fault;
use crate::identity::exact::Exact;
use crate::identity::program::{Operand, Program};
use crate::interval::{Interval, SINE_ERROR, sin_cos};
use crate::polynomial::{Polynomial, Variable, Work};
use crate::ring::Ring;
use crate::rounding::Rounding;

/// Returns the results of a program at a state, each in an interval.
pub(crate) fn at(program: &Program<Exact>, given: &[Vec<f64>]) -> Option<Vec<Interval>> {
    let leaf = |own: &Operand<Exact>| match own {
        Operand::Constant(constant) => {
            let [value, radius] = constant.double()?;
            Some(Interval::around(value, radius))
        }
        Operand::Entry(place, joint) => Some(Interval::point(*given.get(*place)?.get(*joint)?)),
        Operand::Sine(angle, is_sine) => match angle.as_slice() {
            [(joint, false)] => {
                let (sin, cos) = sin_cos(*given[0].get(*joint)?);
                let value = if *is_sine { sin } else { cos };
                Some(Interval::around(value, SINE_ERROR))
            }
            _ => None,
        },
        _ => None,
    };
    let apply = |operation: char, a: Interval, b: Interval| match operation {
        '+' => a + b,
        '-' => a + -b,
        '*' | '×' => a * b,
        _ => Interval::NOTHING_KNOWN,
    };
    let all = program.run(leaf, apply)?.into_iter();
    let signed = all.map(|(negative, own)| if negative { -own } else { own });
    Some(signed.collect())
}

/// Writes a program out over a ring: the size of each of its values, and its results. Sines by
/// polynomials have an error that is a variable.
pub(crate) fn written(
    program: &Program<Exact>,
    ring: &Ring,
    sines: Option<&Rounding>,
    work: &mut Work,
) -> Result<(Vec<f64>, Vec<Polynomial>), Fault> {
    let mut values: Vec<Polynomial> = Vec::with_capacity(program.steps.len());
    let refused = || {
        let why = "tolerance: it reads an angle as a number, or what is no state";
        Fault::Claim(why.into())
    };
    let read = |values: &[Polynomial], own: &Operand<Exact>| -> Result<Polynomial, Fault> {
        let known = match own {
            Operand::Step(step) => values.get(*step).cloned(),
            Operand::Constant(constant) => {
                let [value, radius] = constant.double().ok_or_else(refused)?;
                Some(Polynomial::constant(value, radius))
            }
            own => ring.leaf(own),
        };
        let known = known.ok_or_else(refused)?;
        let error = match own {
            Operand::Sine(angle, is_sine) => {
                let joint = angle.first().map_or(0, |own| own.0);
                let error = sines.and_then(|own| own.polynomial(joint, *is_sine));
                error.map(|error| {
                    let variables = [Variable::EvenError, Variable::OddError];
                    Polynomial::variable(variables[usize::from(*is_sine)], joint, error)
                })
            }
            _ => None,
        };
        Ok(error.map_or(known.clone(), |error| known.plus(&error)))
    };
    let mut sizes = Vec::with_capacity(program.steps.len());
    for (operation, [left, right]) in &program.steps {
        let (a, b) = (read(&values, left)?, read(&values, right)?);
        let value = match operation {
            '+' => a.plus(&b),
            '-' => a.plus(&b.negated()),
            '*' | '×' => a.times(&b, work)?,
            _ => return Err(Fault::Claim("tolerance: the program divides".into())),
        };
        sizes.push(ring.size(&value));
        values.push(value);
    }
    let outputs = program.outputs.iter().map(|(negative, own)| {
        let own = read(&values, own)?;
        Ok(if *negative { own.negated() } else { own })
    });
    Ok((sizes, outputs.collect::<Result<_, Fault>>()?))
}
