//! Ways that only the fingerprints show: a ∘ b or (a ∘ b) ∘ c that happens to be a class.
//!
//! A hit at every point of the field is an identity but for a chance below 1e-40; the final
//! program is proved at other points all the same.

use dalembert_model::scalar::Scalar;
use dalembert_model::scalar::field::Field;
use egg::Id as Class;
use rustc_hash::FxHashMap;

use super::egraph::{Classes, Kind, PRODUCT, SUM, Way, way};
use crate::program::Operation;

/// Keys that were noted, by some of their bits: small enough to stay in a processor's cache.
struct Sieve(Vec<u64>);

impl Sieve {
    fn new(keys: usize) -> Sieve {
        Sieve(vec![0; (8 * keys).next_power_of_two().max(64) / 64])
    }

    /// Lets a key pass; returns whether it passed before.
    fn note(&mut self, key: Field) -> bool {
        let (word, bit) = self.place(key);
        let known = self.0[word] & bit != 0;
        self.0[word] |= bit;
        known
    }

    fn passes(&self, key: Field) -> bool {
        let (word, bit) = self.place(key);
        self.0[word] & bit != 0
    }

    fn place(&self, key: Field) -> (usize, u64) {
        let place = key.value() as usize & (64 * self.0.len() - 1);
        (place / 64, 1 << (place % 64))
    }
}

/// Returns the key of a value: up to sign, at the first point.
fn key(x: Field) -> Field {
    x.min(x.neg())
}

fn pairs_of(pool: &[(Class, Field)], mut visit: impl FnMut(Field, Way)) {
    for (index, &(a, x)) in pool.iter().enumerate() {
        for &(b, y) in &pool[index..] {
            visit(key(x.add(&y)), way(Operation::Add, [a, b]));
            visit(key(x.sub(&y)), way(Operation::Sub, [a, b]));
            visit(key(x.mul(&y)), way(Operation::Mul, [a, b]));
        }
    }
}

fn keyed(classes: &Classes, pool: &[Class]) -> Vec<(Class, Field)> {
    let keyed = |&id: &Class| (id, classes.print(id).0[0]);
    pool.iter().map(keyed).collect()
}

pub(super) fn pairs(classes: &mut Classes, pool: &[Class]) {
    // A finer one than others: whatever passes costs a print and a look-up.
    let mut known = Sieve::new(8 * classes.ids().len());
    for &id in classes.ids() {
        known.note(key(classes.print(id).0[0]));
    }
    let mut ways = Vec::new();
    pairs_of(&keyed(classes, pool), |key, way| {
        ways.extend(known.passes(key).then_some(way));
    });
    ways.into_iter().for_each(|way| classes.offer(way, None));
}

/// If y = (a ∘ b) ∘ c, then y ∓ c or y / c has the key of a pair. Only those of hundreds of
/// thousands of such keys that are met twice come into a map.
pub(super) fn resubstitute(classes: &mut Classes, pool: &[Class]) {
    let keys = keyed(classes, pool);
    let inverse = |&(c, z): &(Class, Field)| Some((c, z.inverse()?));
    let inverses: Vec<(Class, Field)> = keys.iter().filter_map(inverse).collect();
    let quotients = |visit: &mut dyn FnMut(Field, Class, Class)| {
        for &(y, x) in &keys {
            for &(c, inverse) in inverses.iter().filter(|(c, _)| *c != y) {
                visit(key(x.mul(&inverse)), y, c);
            }
        }
    };
    let mut once = Sieve::new(5 * pool.len() * pool.len() / 2);
    let mut twice = Sieve::new(5 * pool.len() * pool.len() / 2);
    let mut meet = |key| {
        if once.note(key) {
            twice.note(key);
        }
    };
    pairs_of(&keys, |key, _| meet(key));
    quotients(&mut |key, _, _| meet(key));
    let mut pairs: Vec<(Field, Way)> = Vec::new();
    pairs_of(&keys, |key, way| {
        pairs.extend(twice.passes(key).then_some((key, way)));
    });
    let mut first: FxHashMap<Field, Way> = FxHashMap::default();
    for &(key, way) in &pairs {
        first.entry(key).or_insert(way);
    }
    let mut nestings: Vec<(Class, Class, Kind, Way)> = Vec::new();
    let mut add_nesting = |key: Field, y: Class, c: Class, outer: Kind| {
        if let Some(&inner) = first.get(&key)
            && !inner.1.contains(&y)
        {
            nestings.push((y, c, outer, inner));
        }
    };
    for &(key, (op, [y, c])) in &pairs {
        if op != Operation::Mul && y != c {
            add_nesting(key, y, c, SUM);
            add_nesting(key, c, y, SUM);
        }
    }
    quotients(&mut |key, y, c| {
        if twice.passes(key) {
            add_nesting(key, y, c, PRODUCT);
        }
    });
    nestings.sort_unstable();
    for (y, c, outer, (op, [a, b])) in nestings {
        let inner = if op == Operation::Mul { PRODUCT } else { SUM };
        classes.nest(y, [outer, inner], [c, a, b]);
    }
}
