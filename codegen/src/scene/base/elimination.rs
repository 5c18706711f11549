//! Finds independent columns modulo 2⁶¹ − 1, and how the others depend on them.

use dalembert_model::number::Rational;
use dalembert_model::scalar::Scalar;
use dalembert_model::scalar::field::Field;

/// A fraction's numerator and denominator are below this, so that there is one
/// at most for a residue: 2·N² < p.
const BOUND: i128 = 1 << 30;

/// Columns over those that are independent.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Reduced {
    /// The columns that do not depend on those before them, ascending.
    pub(super) pivots: Vec<usize>,
    /// Each column as a combination: places in `pivots`, with their factors.
    pub(super) coefficients: Vec<Vec<(usize, Field)>>,
}

/// Eliminates columns from the first to the last, each against those before it.
pub(super) fn reduced(columns: Vec<Vec<Field>>) -> Reduced {
    let mut found = Reduced {
        pivots: Vec::new(),
        coefficients: Vec::with_capacity(columns.len()),
    };
    // The independent ones so far: reduced to one in their own row and to zero
    // in the others' rows, with what they are over the pivots as they came.
    let mut kept: Vec<(usize, Vec<Field>, Vec<Field>)> = Vec::new();
    for (index, mut column) in columns.into_iter().enumerate() {
        let mut factors = vec![Field::ZERO; kept.len()];
        for (row, other, over) in &kept {
            let factor = column[*row];
            if factor == Field::ZERO {
                continue;
            }
            subtract(&mut column, &factor, other);
            let added = over.iter().map(|x| x.mul(&factor));
            for (sum, x) in factors.iter_mut().zip(added) {
                *sum = sum.add(&x);
            }
        }
        let Some(row) = column.iter().position(|x| *x != Field::ZERO) else {
            let own = factors.into_iter().enumerate();
            let own = own.filter(|(_, x)| *x != Field::ZERO).collect();
            found.coefficients.push(own);
            continue;
        };
        // The rest of the column, (column − Σ factors · pivots) / its entry.
        let scale = column[row].inverse().unwrap_or(Field::ZERO);
        column.iter_mut().for_each(|x| *x = x.mul(&scale));
        let mut over: Vec<Field> = factors.iter().map(|x| x.mul(&scale).neg()).collect();
        over.push(scale);
        for (_, other, others) in &mut kept {
            let factor = other[row];
            subtract(other, &factor, &column);
            others.push(Field::ZERO);
            subtract(others, &factor, &over);
        }
        found.coefficients.push(vec![(kept.len(), Field::ONE)]);
        found.pivots.push(index);
        kept.push((row, column, over));
    }
    found
}

/// Computes a − factor · b
fn subtract(a: &mut [Field], factor: &Field, b: &[Field]) {
    for (x, y) in a.iter_mut().zip(b) {
        *x = x.sub(&factor.mul(y));
    }
}

/// Returns the short fraction of a residue, by Euclid's algorithm (Wang 1981); `None`
/// if there is none.
pub(super) fn fraction(x: Field) -> Option<Rational> {
    let [mut before, mut rest] = [i128::from(Field::P), i128::from(x.value())];
    let [mut last, mut factor] = [0i128, 1i128];
    while rest >= BOUND {
        let whole = before / rest;
        (before, rest) = (rest, before - whole * rest);
        (last, factor) = (factor, last - whole * factor);
    }
    (factor != 0 && factor.abs() < BOUND).then(|| Rational::new(rest.into(), factor.into()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use dalembert_model::scalar::field::Points;

    #[test]
    fn fractions_come_back() {
        for (n, d) in [
            (0, 1),
            (1, 1),
            (-1, 2),
            (355, 113),
            (-18_645_124, 100_000_000),
        ] {
            let wanted = Rational::new(n.into(), d.into());
            let residue = Field::from_rational(&wanted).unwrap();
            assert_eq!(fraction(residue), Some(wanted));
        }
    }

    /// Every column is what its coefficients say, and those that were built from
    /// others are found to be.
    #[test]
    fn dependences_are_found() {
        let mut points = Points::new(3);
        let mut random = || -> Vec<Field> { (0..9).map(|_| points.field()).collect() };
        let [a, b, c] = [random(), random(), random()];
        let mix = |x: i64, y: i64| -> Vec<Field> {
            let entry = |(a, b): (&Field, &Field)| {
                Field::from_i64(x).mul(a).add(&Field::from_i64(y).mul(b))
            };
            a.iter().zip(&b).map(entry).collect()
        };
        let columns = vec![
            vec![Field::ZERO; 9],
            a.clone(),
            mix(3, 0),
            b.clone(),
            mix(-2, 5),
            c,
        ];
        let found = reduced(columns.clone());
        assert_eq!(found.pivots, [1, 3, 5]);
        assert!(found.coefficients[0].is_empty());
        assert_eq!(found.coefficients[2], [(0, Field::new(3))]);
        let both = [(0, Field::from_i64(-2)), (1, Field::new(5))];
        assert_eq!(found.coefficients[4], both);
    }
}
