//! The entries of each quantity by their indices, and the nested lists that SymPy has of them.

use crate::entries::Coefficients;
use crate::line::List;
use crate::quantity::Quantity;
use crate::ring::Polynomial;
use crate::symbol::Symbol;

/// Lists the pairs i ≤ k.
pub fn pairs(n: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..n).flat_map(move |i| (i..n).map(move |k| (i, k)))
}

/// Lists the names and the polynomials of D, h or c, symmetric ones once.
pub fn coefficients_of(
    coefficients: &Coefficients<Polynomial>,
    quantity: Quantity,
) -> (Vec<Symbol>, Vec<Polynomial>) {
    let n = coefficients.gravity.len();
    match quantity {
        Quantity::Gravity => {
            let names = (0..n).map(|i| quantity.entry(&[i]));
            (names.collect(), coefficients.gravity.clone())
        }
        Quantity::Inertia | Quantity::InertiaRotation | Quantity::InertiaTranslation => {
            let names = pairs(n).map(|(i, k)| quantity.entry(&[i, k]));
            let entries = pairs(n).map(|(i, k)| coefficients.inertia[i][k].clone());
            (names.collect(), entries.collect())
        }
        _ => {
            let all = || (0..n).flat_map(|i| pairs(n).map(move |(k, m)| (i, k, m)));
            let names = all().map(|(i, k, m)| quantity.entry(&[i, k, m]));
            let entries = all().map(|(i, k, m)| coefficients.christoffel[i][k][m].clone());
            (names.collect(), entries.collect())
        }
    }
}

/// Returns the nested list of a quantity's entries.
pub fn list(quantity: Quantity, n: usize) -> Option<List> {
    let [letters, mark] = quantity.letters();
    let name = match quantity {
        // R is a rational number of SymPy.
        Quantity::Pose => "Rot".to_owned(),
        Quantity::Torque => "tau".to_owned(),
        _ => format!("{letters}{mark}"),
    };
    let (entries, lengths): (Vec<Symbol>, Vec<usize>) = match quantity {
        Quantity::Gravity | Quantity::Torque => {
            ((0..n).map(|i| quantity.entry(&[i])).collect(), vec![n])
        }
        Quantity::Inertia | Quantity::InertiaRotation | Quantity::InertiaTranslation => {
            let all = (0..n).flat_map(|i| (0..n).map(move |k| [i.min(k), i.max(k)]));
            (
                all.map(|indices| quantity.entry(&indices)).collect(),
                vec![n, n],
            )
        }
        Quantity::Christoffel
        | Quantity::ChristoffelRotation
        | Quantity::ChristoffelTranslation => {
            let all = (0..n).flat_map(move |i| {
                (0..n).flat_map(move |k| (0..n).map(move |m| [i, k.min(m), k.max(m)]))
            });
            (
                all.map(|indices| quantity.entry(&indices)).collect(),
                vec![n, n, n],
            )
        }
        Quantity::Pose => {
            let all = (0..3).flat_map(|r| (0..3).map(move |c| [r, c]));
            (
                all.map(|indices| quantity.entry(&indices)).collect(),
                vec![3, 3],
            )
        }
        Quantity::Jacobian => {
            let all = (0..6).flat_map(|r| (0..n).map(move |c| [r, c]));
            (
                all.map(|indices| quantity.entry(&indices)).collect(),
                vec![6, n],
            )
        }
        Quantity::KineticEnergy | Quantity::PotentialEnergy => return None,
    };
    Some(List {
        name,
        entries,
        lengths,
    })
}
