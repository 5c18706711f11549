//! The one backward pass: what a result changes by, for a change of each value
//! that it is computed from, in any scalar; and its step at many states at once.

use dalembert_model::scalar::Divide;

use super::columns::Column;
use super::machine::Machine;
use super::run::State;
use super::{Literal, Lowered, Operand, Operation, Step};
use crate::states::JointState;

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

impl Operation {
    /// Returns the result's adjoint passed on to the left and to the right operand.
    #[inline]
    pub fn parts<S: Divide>(self, adjoint: &S, left: &S, right: &S) -> [S; 2] {
        match self {
            Operation::Add => [adjoint.clone(), adjoint.clone()],
            Operation::Sub => [adjoint.clone(), adjoint.neg()],
            Operation::Mul | Operation::Fused => [adjoint.mul(right), adjoint.mul(left)],
            // ∂(x/y) = ∂x/y − (x/y)·∂y/y
            Operation::Div => {
                let by_left = adjoint.div(right);
                let by_right = by_left.mul(&left.div(right)).neg();
                [by_left, by_right]
            }
        }
    }
}

impl Operation {
    /// Computes [`Operation::parts`] at every state, that of one side added to `sums`.
    pub fn add_parts<T: Machine>(
        self,
        side: usize,
        adjoints: &[T],
        operands: [Column<'_, T>; 2],
        sums: &mut [T],
    ) {
        // A loop an operation: what its derivative does not read, none reads.
        macro_rules! add {
            ($operation:expr) => {
                add_each(adjoints, operands, sums, |adjoint, left, right| {
                    $operation.parts(&adjoint, &left, &right)[side & 1]
                })
            };
        }
        match self {
            Operation::Add => add!(Operation::Add),
            Operation::Sub => add!(Operation::Sub),
            Operation::Mul | Operation::Fused => add!(Operation::Mul),
            Operation::Div => add!(Operation::Div),
        }
    }
}

#[inline]
fn add_each<T: Machine>(
    adjoints: &[T],
    operands: [Column<'_, T>; 2],
    sums: &mut [T],
    part: impl Fn(T, T, T) -> T,
) {
    let pairs = sums.iter_mut().zip(adjoints);
    match operands {
        [Column::Each(left), Column::Each(right)] => {
            for (((sum, &adjoint), &x), &y) in pairs.zip(left).zip(right) {
                *sum = sum.add(&part(adjoint, x, y));
            }
        }
        [Column::Each(left), Column::All(y)] => {
            for ((sum, &adjoint), &x) in pairs.zip(left) {
                *sum = sum.add(&part(adjoint, x, y));
            }
        }
        [Column::All(x), Column::Each(right)] => {
            for ((sum, &adjoint), &y) in pairs.zip(right) {
                *sum = sum.add(&part(adjoint, x, y));
            }
        }
        [Column::All(x), Column::All(y)] => {
            for (sum, &adjoint) in pairs {
                *sum = sum.add(&part(adjoint, x, y));
            }
        }
    }
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

impl Lowered {
    /// Returns the first-order rounding error that an output may have at a state, in units of
    /// u: the sum of |value·adjoint| over all operations.
    pub(crate) fn rounded(&self, output: usize, state: &JointState) -> f64 {
        let Operand::Step(top) = self.outputs[output].value else {
            return 0.0;
        };
        let input = self.inputs(State::<f64>::of(|argument| state.of(argument)));
        let mut values: Vec<f64> = Vec::with_capacity(self.steps.len());
        let read = |operand: &Operand<Literal>, values: &[f64]| match operand {
            Operand::Input(name) => input(name).unwrap_or(0.0),
            Operand::Constant(value) => value.0,
            Operand::Step(index) => values[*index],
        };
        for step in &self.steps {
            let (left, right) = (read(&step.left, &values), read(&step.right, &values));
            values.push(step.operation.apply(&left, &right));
        }
        let operands = |index: usize| {
            let step = &self.steps[index];
            [read(&step.left, &values), read(&step.right, &values)]
        };
        let mut sum = 0.0;
        let visit = |index: usize, adjoint: &f64| {
            sum += (values[index] * adjoint).abs();
            *adjoint != 0.0
        };
        backward(&self.steps, top, operands, visit, |_, _| {});
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;
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

    /// At many states side by side, each gets the bits that it has alone.
    #[test]
    fn states_side_by_side_have_the_parts_of_each() {
        let mut random = Random::new(0x51de);
        let mut column = || -> Vec<f64> { (0..9).map(|_| random.unit() - 0.5).collect() };
        let (adjoints, left, right, before) = (column(), column(), column(), column());
        let each = [Column::Each(&left), Column::Each(&right)];
        let one = [Column::All(0.3), Column::All(-0.7)];
        let all = [each, one, [each[0], one[1]], [one[0], each[1]]];
        let at = |column: Column<'_, f64>, state: usize| match column {
            Column::Each(values) => values[state],
            Column::All(value) => value,
        };
        for operation in Operation::ALL {
            for (operands, side) in all.iter().flat_map(|&both| [(both, 0), (both, 1)]) {
                let mut sums = before.clone();
                operation.add_parts(side, &adjoints, operands, &mut sums);
                for (k, sum) in sums.iter().enumerate() {
                    let [x, y] = operands.map(|column| at(column, k));
                    let alone = before[k] + operation.parts(&adjoints[k], &x, &y)[side];
                    assert_eq!(sum.to_bits(), alone.to_bits(), "{operation:?} {side}");
                }
            }
        }
    }
}
