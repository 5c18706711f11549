//! Resubstitution: (a ∘ b) ∘ c for a class, a ∘ b being new.

use dalembert_model::scalar::Scalar;
use dalembert_model::scalar::field::Field;
use rustc_hash::FxHashMap;

use super::{for_pairs, up_to_sign};
use crate::simplify::classes::{ClassId, Classes, Operator, Way};
use crate::simplify::sieve::Sieve;

/// What of y and c a pair a ∘ b is, in the order in which ways are tried.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Inverse {
    /// y − c
    Difference,
    /// y + c
    Sum,
    /// y / c
    Quotient,
}

/// Tries (a ∘ b) ∘ c for every class of the pool over the pool.
///
/// y = (a ∘ b) ± c where the pair a ∘ b has the key of another, y ∓ c, and y = (a ∘ b)·c
/// where it has that of y / c. So of the keys of all pairs and quotients, hundreds of
/// thousands, only those come into a map that are met twice.
pub(crate) fn resubstitute(classes: &mut Classes, pool: &[ClassId]) {
    let mut met = Sieve::new(5 * pool.len() * pool.len() / 2);
    let mut again = met.clone();
    let mut meet = |key: Field| match met.passes(key) {
        true => again.note(key),
        false => met.note(key),
    };
    for_pairs(classes, pool, |key, _| meet(key));
    for_quotients(classes, pool, |key, _, _| meet(key));
    let mut pairs: Vec<(Field, Way)> = Vec::new();
    for_pairs(classes, pool, |key, way| {
        if again.passes(key) {
            pairs.push((key, way));
        }
    });
    // a ∘ b → the first such pair.
    let mut table: FxHashMap<Field, Way> = FxHashMap::default();
    for &(key, way) in &pairs {
        table.entry(key).or_insert(way);
    }
    // y, c, which of the three keys, and the pair that has it.
    let mut found: Vec<(ClassId, ClassId, Inverse, Way)> = Vec::new();
    let mut meet = |key: &Field, y: ClassId, c: ClassId, inverse: Inverse| {
        if let Some(&way) = table.get(key)
            && !way.operands.contains(&y)
        {
            found.push((y, c, inverse, way));
        }
    };
    for (key, way) in &pairs {
        let inverse = match way.operator {
            Operator::Difference => Inverse::Difference,
            Operator::Sum => Inverse::Sum,
            _ => continue,
        };
        let [y, c] = way.operands;
        if y != c {
            meet(key, y, c, inverse);
            meet(key, c, y, inverse);
        }
    }
    for_quotients(classes, pool, |key, y, c| {
        if again.passes(key) {
            meet(&key, y, c, Inverse::Quotient);
        }
    });
    found.sort_unstable();
    for (y, c, inverse, inner) in found {
        let Some(middle) = classes.add(inner) else {
            continue;
        };
        let operators: &[Operator] = match inverse {
            Inverse::Quotient => &[Operator::Product],
            _ => &[Operator::Sum, Operator::Difference],
        };
        for &operator in operators {
            classes.add_to(y, Way::new(operator, [middle.class, c]));
        }
    }
}

/// Calls with the key of every y / c in the pool, y and c.
fn for_quotients(
    classes: &Classes,
    pool: &[ClassId],
    mut call: impl FnMut(Field, ClassId, ClassId),
) {
    let first = |id: ClassId| classes.print(id).0[0];
    let divisors: Vec<(ClassId, Field)> = pool
        .iter()
        .filter_map(|&c| Some((c, first(c).inverse()?)))
        .collect();
    for &y in pool {
        let target = first(y);
        for (c, inverse) in divisors.iter().filter(|(c, _)| *c != y) {
            call(up_to_sign(target.mul(inverse)), y, *c);
        }
    }
}
