//! Finds independent columns of a regressor modulo two primes, and how the others depend on them.

use dalembert_model::equations::Formulation;
use dalembert_model::equations::regressor::Column;
use dalembert_model::number::{Exact, Rational};
use dalembert_model::scalar::Scalar;
use dalembert_model::scalar::field::{Field, Modulo, ProofField};
use dalembert_model::scalar::sparse::Sparse;

use crate::dag::Points;
use crate::function::{Function, Quantity, RegressorColumns};
use crate::program::Input;
use crate::scalar::Case;
use crate::setup::Setup;

const SEED: u64 = 0x6261_7365;

pub(super) fn values<const P: u64>(
    setup: &Setup,
    quantity: Quantity,
    columns: &[Column<Exact>],
) -> Option<Vec<Vec<Modulo<P>>>>
where
    Modulo<P>: Case,
{
    let points = Points::new(SEED);
    // Constant angles are the same in every state.
    let constant = |value: &Exact| match points.constant_at(value, 0) {
        Some(residue) => Sparse::constant(value, Modulo::<P>::any(residue)),
        None => Sparse::Lost,
    };
    let is_over = |function: &Function| function.columns() == RegressorColumns::Base(quantity);
    let task = setup.task(Function::ALL.into_iter().find(is_over)?);
    let arm = setup.arm(constant);
    let columns: Vec<_> = columns.iter().map(|c| c.map(constant)).collect();
    let mut samples: Vec<Vec<Modulo<P>>> = vec![Vec::new(); columns.len()];
    let states = columns.len() / setup.rows().len().max(1) + 4;
    for state in 0..states {
        let input = |input: Input| Sparse::Value(Modulo::<P>::any(points.input_at(input, state)));
        let posed = task.posed_over(arm.clone(), &(constant, input), Vec::new());
        for row in posed.regressor(Formulation::NewtonEulerLink, quantity, &columns) {
            for (column, entry) in samples.iter_mut().zip(row) {
                column.push(entry.value().and_then(Modulo::of)?);
            }
        }
    }
    Some(samples)
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct ColumnBasis<T> {
    pub(super) pivots: Vec<usize>,
    /// Each column as a combination: places in `pivots`, with their factors.
    pub(super) coefficients: Vec<Vec<(usize, T)>>,
}

impl ColumnBasis<Exact> {
    pub(super) fn confirmed(
        first: ColumnBasis<Field>,
        second: ColumnBasis<ProofField>,
    ) -> Option<ColumnBasis<Exact>> {
        if first.pivots != second.pivots {
            return None;
        }
        let both = first.coefficients.iter().zip(&second.coefficients);
        let coefficients = both.map(|(factors, others)| {
            let ratios = factors.iter().zip(others).map(|((place, x), (other, y))| {
                let ratio = fraction(*x, *y).filter(|_| place == other);
                Some((*place, Exact::from(ratio?)))
            });
            let terms: Option<Vec<(usize, Exact)>> = ratios.collect();
            terms.filter(|_| factors.len() == others.len())
        });
        Some(ColumnBasis {
            coefficients: coefficients.collect::<Option<_>>()?,
            pivots: first.pivots,
        })
    }
}

pub(super) fn reduced<const P: u64>(columns: Vec<Vec<Modulo<P>>>) -> ColumnBasis<Modulo<P>> {
    let mut basis = ColumnBasis {
        pivots: Vec::new(),
        coefficients: Vec::with_capacity(columns.len()),
    };
    // The independent ones so far: reduced to one in their own row and to zero
    // in the others' rows, with what they are over the pivots as they came.
    let mut kept: Vec<(usize, Vec<Modulo<P>>, Vec<Modulo<P>>)> = Vec::new();
    for (index, mut column) in columns.into_iter().enumerate() {
        let mut factors = vec![Modulo::ZERO; kept.len()];
        for (row, other, over) in &kept {
            let factor = column[*row];
            if factor == Modulo::ZERO {
                continue;
            }
            subtract(&mut column, &factor, other);
            for (sum, x) in factors.iter_mut().zip(over) {
                *sum = sum.add(&x.mul(&factor));
            }
        }
        let Some(row) = column.iter().position(|x| *x != Modulo::ZERO) else {
            let combination = factors.into_iter().enumerate();
            let nonzero = combination.filter(|(_, x)| *x != Modulo::ZERO);
            basis.coefficients.push(nonzero.collect());
            continue;
        };
        // The rest of the column, (column − Σ factors · pivots) / its entry.
        let scale = column[row].inverse().unwrap_or(Modulo::ZERO);
        column.iter_mut().for_each(|x| *x = x.mul(&scale));
        let mut over: Vec<Modulo<P>> = factors.iter().map(|x| x.mul(&scale).neg()).collect();
        over.push(scale);
        for (_, other, others) in &mut kept {
            let factor = other[row];
            subtract(other, &factor, &column);
            others.push(Modulo::ZERO);
            subtract(others, &factor, &over);
        }
        basis.coefficients.push(vec![(kept.len(), Modulo::ONE)]);
        basis.pivots.push(index);
        kept.push((row, column, over));
    }
    basis
}

fn subtract<const P: u64>(a: &mut [Modulo<P>], factor: &Modulo<P>, b: &[Modulo<P>]) {
    for (x, y) in a.iter_mut().zip(b) {
        *x = x.sub(&factor.mul(y));
    }
}

/// A fraction n/d with 2·|n|·d below the product of both primes, 2¹²², is a step of Euclid's algorithm
/// on its residue (Wang 1981). Nearly every residue has such a step, so that one alone shows nothing:
/// one of less than 2⁹⁰ comes by chance once in 10⁸ times. Products of a few lengths are shorter.
fn fraction(x: Field, y: ProofField) -> Option<Rational> {
    let more = y
        .sub(&ProofField::from_i64(x.value() as i64))
        .mul(&ProofField::from_i64(Field::P as i64).inverse()?);
    // The residue of both, by the Chinese remainder theorem.
    let both = i128::from(x.value()) + i128::from(Field::P) * i128::from(more.value());
    let whole = i128::from(Field::P) * i128::from(ProofField::P);
    let [mut before, mut rest] = [whole, both];
    let [mut last, mut factor] = [0i128, 1i128];
    while rest != 0 {
        if rest * factor.abs() < 1 << 89 {
            return Some(Rational::new(rest.into(), factor.into()));
        }
        let quotient = before / rest;
        (before, rest) = (rest, before - quotient * rest);
        (last, factor) = (factor, last - quotient * factor);
    }
    (both == 0).then(|| Rational::from_integer(0.into()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use dalembert_model::scalar::field::Points;

    #[test]
    fn fractions_come_back() {
        for (n, d) in [
            (0_i64, 1_i64),
            (1, 1),
            (-1, 2),
            (355, 113),
            (-18_645_124, 100_000_000),
            (-982_451_653_217, 1_000_000_000_000),
        ] {
            let wanted = Rational::new(n.into(), d.into());
            let x = Field::from_rational(&wanted).unwrap();
            let y = ProofField::from_rational(&wanted).unwrap();
            assert_eq!(fraction(x, y), Some(wanted));
        }
    }

    #[test]
    fn a_fraction_of_one_prime_alone_is_none() {
        let digits = "3141592653589793238462643383279502884197169399375105820974944";
        let scale = num_bigint::BigInt::from(10).pow(60);
        let pi = Rational::new(digits.parse().unwrap(), scale);
        let mut points = Points::new(7);
        let mut seeming = 0;
        for round in 0..1000 {
            let wanted = pi.clone() * Rational::from_integer((points.bits() | round).into());
            let x = Field::from_rational(&wanted).unwrap();
            let y = ProofField::from_rational(&wanted).unwrap();
            assert_eq!(fraction(x, y), None);
            let short = (1..1 << 15).find_map(|d: i64| {
                let n = x.mul(&Field::from_i64(d));
                let n = n.min(n.neg()).value();
                (n < 1 << 45).then_some((n, d))
            });
            seeming += usize::from(short.is_some());
        }
        assert!(seeming > 300, "{seeming}");
    }
}
