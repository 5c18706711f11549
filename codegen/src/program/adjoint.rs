//! The backward pass over steps: what a result changes by, for a change of each value that it is
//! computed from, in any scalar.

use dalembert_model::scalar::Divide;

use super::{Operand, Step};

/// A step's operand that no step computes: an input or a constant.
#[derive(Debug)]
pub(crate) struct Leaf<'p, C, I> {
    /// The step that reads it.
    pub step: usize,
    /// 0 for its left operand, 1 for its right one.
    pub side: usize,
    /// An input or a constant.
    pub operand: &'p Operand<C, I>,
}

/// Goes from the step `top` backwards. `operands` are the values that a step reads. `visit` is
/// given every step with its whole adjoint, users before operands, and says whether to go on
/// through it: what adds nothing ends there. `leaf` is given what steps read besides each other,
/// use by use.
pub(crate) fn backward<'p, C, I, S: Divide>(
    steps: &'p [Step<C, I>],
    top: usize,
    operands: impl Fn(usize) -> [S; 2],
    mut visit: impl FnMut(usize, &S) -> bool,
    mut leaf: impl FnMut(Leaf<'p, C, I>, S),
) {
    let count = steps.len().min(top + 1);
    let mut adjoints = vec![S::zero(); count];
    if let Some(adjoint) = adjoints.get_mut(top) {
        *adjoint = S::one();
    }
    for (index, step) in steps.iter().enumerate().take(count).rev() {
        let adjoint = adjoints[index].clone();
        if !visit(index, &adjoint) {
            continue;
        }
        let [left, right] = operands(index);
        let parts = step.operation.parts(&adjoint, &left, &right);
        let both = [&step.left, &step.right].into_iter().enumerate();
        for ((side, operand), part) in both.zip(parts) {
            match operand {
                Operand::Step(before) => {
                    if let Some(sum) = adjoints.get_mut(*before) {
                        *sum = sum.add(&part);
                    }
                }
                operand => leaf(
                    Leaf {
                        step: index,
                        side,
                        operand,
                    },
                    part,
                ),
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dag::Operation;
    use crate::random::Random;
    use dalembert_model::scalar::Scalar;
    use dalembert_model::scalar::dual::Dual;
    use dalembert_model::scalar::field::Field;

    /// Backwards and forwards (duals) are the same derivative, in a field, where
    /// equal is equal: programs of all operations, with values read twice.
    #[test]
    fn the_pass_agrees_with_duals() {
        let (mut random, mut proved) = (Random::new(0xadd), 0);
        for _ in 0..200 {
            let count = 2 + (random.bits() % 12) as usize;
            let steps: Vec<Step<u64, usize>> = (0..count)
                .map(|index| {
                    let mut operand = || match random.bits() % 4 {
                        0 => Operand::Input((random.bits() % 3) as usize),
                        1 => Operand::Constant(random.bits() % 1000 + 1),
                        _ if index == 0 => Operand::Input(0),
                        _ => Operand::Step((random.bits() % index as u64) as usize),
                    };
                    let (left, right) = (operand(), operand());
                    Step {
                        operation: Operation::ALL[(random.bits() % 5) as usize],
                        left,
                        right,
                    }
                })
                .collect();
            let inputs: Vec<Field> = (0..3).map(|_| Field::new(random.bits() >> 8)).collect();
            // Forwards, with one input at a time moving.
            let run = |moving: usize| {
                let mut values: Vec<Dual<Field>> = Vec::new();
                for step in &steps {
                    let read = |operand: &Operand<u64, usize>| match *operand {
                        Operand::Input(i) => Dual {
                            value: inputs[i],
                            rate: if i == moving {
                                Field::one()
                            } else {
                                Field::zero()
                            },
                        },
                        Operand::Constant(c) => Dual {
                            value: Field::new(c),
                            rate: Field::zero(),
                        },
                        Operand::Step(s) => values[s],
                    };
                    values.push(step.operation.apply(&read(&step.left), &read(&step.right)));
                }
                values
            };
            let values: Vec<Field> = run(0).into_iter().map(|dual| dual.value).collect();
            let operands = |index: usize| {
                [&steps[index].left, &steps[index].right].map(|operand| match *operand {
                    Operand::Input(i) => inputs[i],
                    Operand::Constant(c) => Field::new(c),
                    Operand::Step(s) => values[s],
                })
            };
            let divides = |index: &usize| steps[*index].operation == Operation::Div;
            let mut quotients = (0..count).filter(divides);
            if quotients.any(|index| operands(index)[1] == Field::zero()) {
                continue;
            }
            proved += 1;
            let mut slopes = [Field::zero(); 3];
            let leaf = |leaf: Leaf<'_, u64, usize>, part: Field| {
                if let Operand::Input(i) = leaf.operand {
                    slopes[*i] = slopes[*i].add(&part);
                }
            };
            backward(&steps, count - 1, operands, |_, _| true, leaf);
            for (moving, slope) in slopes.iter().enumerate() {
                assert_eq!(run(moving)[count - 1].rate, *slope, "{steps:?}");
            }
        }
        assert!(proved > 100, "{proved}");
    }
}
