//! Operations and their derivatives at many states side by side: each state gets the bits that it
//! has alone.

use crate::program::Operation;
use crate::program::machine::Machine;

/// An operand of an operation over columns.
#[derive(Clone, Copy, Debug)]
pub(in crate::approximate::prune) enum Column<'c, T> {
    /// A value of each state.
    Each(&'c [T]),
    /// One for all.
    All(T),
}

impl Operation {
    /// Computes the operation at every state, in one loop: no state waits for another.
    pub(in crate::approximate::prune) fn at_each<T: Machine>(
        self,
        left: Column<'_, T>,
        right: Column<'_, T>,
        out: &mut [T],
    ) {
        match self {
            Operation::Add => zip(out, left, right, |x, y| x.add(&y)),
            Operation::Sub => zip(out, left, right, |x, y| x.sub(&y)),
            Operation::Mul | Operation::Fused => zip(out, left, right, |x, y| x.mul(&y)),
            Operation::Div => zip(out, left, right, |x, y| x.div(&y)),
        }
    }
}

#[inline]
fn zip<T: Machine>(
    out: &mut [T],
    left: Column<'_, T>,
    right: Column<'_, T>,
    f: impl Fn(T, T) -> T,
) {
    match (left, right) {
        (Column::Each(left), Column::Each(right)) => {
            for ((out, &x), &y) in out.iter_mut().zip(left).zip(right) {
                *out = f(x, y);
            }
        }
        (Column::Each(left), Column::All(y)) => {
            for (out, &x) in out.iter_mut().zip(left) {
                *out = f(x, y);
            }
        }
        (Column::All(x), Column::Each(right)) => {
            for (out, &y) in out.iter_mut().zip(right) {
                *out = f(x, y);
            }
        }
        (Column::All(x), Column::All(y)) => out.fill(f(x, y)),
    }
}

impl Operation {
    /// Computes [`Operation::parts`] at every state, that of one side added to `sums`.
    pub(in crate::approximate::prune) fn add_parts<T: Machine>(
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

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
