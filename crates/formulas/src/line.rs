//! The lines of formulas, by the indices of each quantity's entries, and the nested lists that SymPy
//! has of them.

use crate::entries::Coefficients;
use crate::expression::Sum;
use crate::quantity::Quantity;
use crate::symbol::Symbol;

/// A formula.
#[derive(Clone, Debug)]
pub struct Line {
    /// The name of the entry.
    pub name: Symbol,
    /// Later entries that are equal, or opposite: then the flag is set.
    pub others: Vec<(bool, Symbol)>,
    /// The right side.
    pub sum: Sum,
}

impl Line {
    pub(crate) fn new(name: Symbol, sum: Sum) -> Line {
        let others = Vec::new();
        Line { name, others, sum }
    }
}

/// Lines with a heading.
#[derive(Clone, Debug)]
pub struct Section {
    /// The heading.
    pub title: String,
    /// The entries that are not zero.
    pub lines: Vec<Line>,
    /// The entries that are zero.
    pub zeros: Vec<Symbol>,
    /// The nested list that SymPy text makes of them.
    pub list: Option<List>,
}

/// A nested list of entries, as SymPy text defines it.
#[derive(Clone, Debug)]
pub struct List {
    /// The identifier.
    pub name: String,
    /// The entries in the order of their indices.
    pub entries: Vec<Symbol>,
    /// The number of entries at each depth.
    pub lengths: Vec<usize>,
}

/// Lists the pairs i ≤ k.
pub fn pairs(n: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..n).flat_map(move |i| (i..n).map(move |k| (i, k)))
}

/// Lists the indices of the coefficients of D, h or c, symmetric ones once, each with its value.
pub fn coefficients_of<S>(
    coefficients: &Coefficients<S>,
    quantity: Quantity,
) -> Vec<(Vec<usize>, &S)> {
    let n = coefficients.gravity.len();
    match quantity {
        Quantity::Gravity => {
            let entries = coefficients.gravity.iter().enumerate();
            entries.map(|(i, value)| (vec![i], value)).collect()
        }
        Quantity::Inertia | Quantity::InertiaRotation | Quantity::InertiaTranslation => {
            let entries = pairs(n).map(|(i, k)| (vec![i, k], &coefficients.inertia[i][k]));
            entries.collect()
        }
        _ => {
            let triples = (0..n).flat_map(|i| pairs(n).map(move |(k, m)| [i, k, m]));
            let value = |[i, k, m]: [usize; 3]| &coefficients.christoffel[i][k][m];
            triples
                .map(|indices| (indices.to_vec(), value(indices)))
                .collect()
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
    let lengths = match quantity {
        Quantity::Gravity | Quantity::Torque => vec![n],
        Quantity::Inertia | Quantity::InertiaRotation | Quantity::InertiaTranslation => vec![n, n],
        Quantity::Christoffel
        | Quantity::ChristoffelRotation
        | Quantity::ChristoffelTranslation => vec![n, n, n],
        Quantity::Pose => vec![3, 3],
        Quantity::Jacobian => vec![6, n],
        Quantity::KineticEnergy | Quantity::PotentialEnergy => return None,
    };
    let is_symmetric = !matches!(quantity, Quantity::Pose | Quantity::Jacobian);
    let entry = |place: usize| {
        let mut left = place;
        let mut indices = vec![0; lengths.len()];
        for (index, length) in indices.iter_mut().zip(&lengths).rev() {
            (*index, left) = (left % length, left / length);
        }
        // Entries that are equal have one name: that with the last two indices in order.
        if let [.., k, m] = indices.as_mut_slice()
            && is_symmetric
            && k > m
        {
            core::mem::swap(k, m);
        }
        quantity.entry(&indices)
    };
    let entries = (0..lengths.iter().product()).map(entry).collect();
    Some(List {
        name,
        entries,
        lengths,
    })
}
