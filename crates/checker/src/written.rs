//! Programs written out: as intervals at a state, as polynomials over a box.

use crate::fault::Fault;
use crate::identity::exact::Exact;
use crate::interval::Interval;
use crate::polynomial::{Polynomial, Variable};
use crate::program::{Operand, Program};
use crate::ring::Ring;
use crate::work::Work;

/// The most terms that are alive at once: 32 bytes each.
const MOST_ALIVE: usize = 1 << 23;

pub(crate) fn evaluate(
    program: &Program<Exact>,
    arguments: &[Vec<Interval>],
) -> Option<Vec<Interval>> {
    let leaf = |operand: &Operand<Exact>| match operand {
        Operand::Constant(constant) => {
            let [value, radius] = constant.double()?;
            Some(Interval::around(value, radius))
        }
        Operand::Entry(place, index) => arguments.get(*place)?.get(*index).copied(),
        Operand::Sine(joint, is_sine) => Some(arguments.first()?.get(*joint)?.sine(*is_sine)),
        _ => None,
    };
    let apply = |operation: char, a: Interval, b: Interval| match operation {
        '+' => a + b,
        '-' => a + -b,
        '*' | '×' => a * b,
        _ => Interval::NOTHING_KNOWN,
    };
    program.run(leaf, apply, |interval: Interval| -interval)
}

/// The largest error of a joint's sine, or else of its cosine; none where it is exact.
pub(crate) type Errors<'w> = &'w dyn Fn(usize, bool) -> Option<f64>;

/// A program whose steps and results are polynomials. Sines by polynomials have an error that is a
/// variable.
pub(crate) struct PolynomialProgram<'w> {
    ring: &'w Ring,
    errors: Option<Errors<'w>>,
    /// The value of each step, as long as another one needs it; all if errors are given.
    steps: Vec<Option<Polynomial>>,
    pub(crate) outputs: Vec<Polynomial>,
}

impl<'w> PolynomialProgram<'w> {
    /// Writes a program out. Steps are kept if errors of sines are given.
    pub(crate) fn new(
        program: &Program<Exact>,
        ring: &'w Ring,
        errors: Option<Errors<'w>>,
        work: &Work,
    ) -> Result<PolynomialProgram<'w>, Fault> {
        let mut left = uses(program);
        let mut polynomials = PolynomialProgram {
            ring,
            errors,
            steps: vec![None; left.len()],
            outputs: Vec::new(),
        };
        let mut alive = 0;
        for (index, (operation, operands)) in program.steps.iter().enumerate() {
            if left[index] == 0 {
                continue;
            }
            let [one, other] = operands;
            let (a, b) = (polynomials.value(one)?, polynomials.value(other)?);
            let value = match operation {
                '+' => a.sum(&b, work)?,
                '-' => a.sum(&b.negated(), work)?,
                '*' | '×' => a.times(&b, work)?,
                _ => return Err(Fault::Claim("tolerance: the program divides".into())),
            };
            alive += value.terms.len();
            polynomials.steps[index] = Some(value);
            for operand in operands {
                if let Operand::Step(step) = operand {
                    left[*step] -= 1;
                    if left[*step] == 0 && errors.is_none() {
                        let value = polynomials.steps[*step].take();
                        alive -= value.map_or(0, |polynomial| polynomial.terms.len());
                    }
                }
            }
            if alive > MOST_ALIVE {
                return Err(Fault::Large);
            }
        }
        for (negative, output) in &program.outputs {
            let value = polynomials.value(output)?;
            let result = if *negative { value.negated() } else { value };
            polynomials.outputs.push(result);
        }
        Ok(polynomials)
    }

    pub(crate) fn step(&self, index: usize) -> Option<&Polynomial> {
        self.steps[index].as_ref()
    }

    pub(crate) fn value(&self, operand: &Operand<Exact>) -> Result<Polynomial, Fault> {
        let value = match operand {
            Operand::Step(step) => self.steps[*step].clone(),
            leaf => self.leaf(leaf),
        };
        let why = "tolerance: it reads an angle as a number, or an operand outside the state";
        value.ok_or_else(|| Fault::Claim(why.into()))
    }

    pub(crate) fn leaf(&self, operand: &Operand<Exact>) -> Option<Polynomial> {
        match operand {
            Operand::Constant(constant) => {
                let double = constant.double();
                double.map(|[value, radius]| Polynomial::constant(value, radius))
            }
            Operand::Sine(joint, is_sine) => {
                let value = self.ring.leaf(operand)?;
                let error = self.errors.and_then(|errors| errors(*joint, *is_sine));
                let variable = [Variable::EvenError, Variable::OddError][usize::from(*is_sine)];
                Some(match error {
                    Some(error) => value.plus(&Polynomial::variable(variable, *joint, error)),
                    None => value,
                })
            }
            leaf => self.ring.leaf(leaf),
        }
    }
}

/// Counts how often each step is read on the way to the results: never, if it is in vain.
fn uses(program: &Program<Exact>) -> Vec<usize> {
    let mut counts = vec![0; program.steps.len()];
    let step = |operand: &Operand<Exact>| match operand {
        Operand::Step(step) => Some(*step),
        _ => None,
    };
    let outputs = program.outputs.iter().filter_map(|output| step(&output.1));
    outputs.for_each(|step| counts[step] += 1);
    for (index, (_, operands)) in program.steps.iter().enumerate().rev() {
        if counts[index] > 0 {
            let steps = operands.iter().filter_map(step);
            steps.for_each(|step| counts[step] += 1);
        }
    }
    counts
}
