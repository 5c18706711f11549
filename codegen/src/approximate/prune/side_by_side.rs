//! Operations and their derivatives at many states side by side: each state gets the bits that it
//! has alone.

use crate::program::Operation;

#[derive(Clone, Copy, Debug)]
pub(in crate::approximate::prune) enum Column<'c> {
    Each(&'c [f64]),
    All(f64),
}

impl Operation {
    pub(in crate::approximate::prune) fn at_each(self, operands: [Column<'_>; 2], out: &mut [f64]) {
        let out = out.iter_mut();
        match self {
            Operation::Add => zip(out, operands, |out, x, y| *out = x + y),
            Operation::Sub => zip(out, operands, |out, x, y| *out = x - y),
            Operation::Mul | Operation::Fused => zip(out, operands, |out, x, y| *out = x * y),
            Operation::Div => zip(out, operands, |out, x, y| *out = x / y),
        }
    }

    pub(in crate::approximate::prune) fn add_parts(
        self,
        side: usize,
        adjoints: &[f64],
        operands: [Column<'_>; 2],
        sums: &mut [f64],
    ) {
        // A loop an operation: what its derivative does not read, none reads.
        macro_rules! add {
            ($operation:expr) => {
                zip(
                    sums.iter_mut().zip(adjoints),
                    operands,
                    |(sum, adjoint), x, y| {
                        *sum += $operation.parts(adjoint, &x, &y)[side & 1];
                    },
                )
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
fn zip<T>(items: impl Iterator<Item = T>, operands: [Column<'_>; 2], show: impl Fn(T, f64, f64)) {
    match operands {
        [Column::Each(left), Column::Each(right)] => {
            for ((item, &x), &y) in items.zip(left).zip(right) {
                show(item, x, y);
            }
        }
        [Column::Each(left), Column::All(y)] => {
            for (item, &x) in items.zip(left) {
                show(item, x, y);
            }
        }
        [Column::All(x), Column::Each(right)] => {
            for (item, &y) in items.zip(right) {
                show(item, x, y);
            }
        }
        [Column::All(x), Column::All(y)] => {
            for item in items {
                show(item, x, y);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    #[test]
    fn states_side_by_side_have_the_parts_of_each() {
        let mut random = Random::new(0x51de);
        let mut column = || -> Vec<f64> { (0..9).map(|_| random.unit() - 0.5).collect() };
        let (adjoints, left, right, before) = (column(), column(), column(), column());
        let each = [Column::Each(&left), Column::Each(&right)];
        let one = [Column::All(0.3), Column::All(-0.7)];
        let all = [each, one, [each[0], one[1]], [one[0], each[1]]];
        let at = |column: Column<'_>, state: usize| match column {
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
