//! New ways to compute the values of a program, found by fingerprint.
//!
//! - this file: pairs, a ± b and a·b over a pool of classes that happen to be a class
//! - [`mod@multiples`]: multiples and shifts, with a constant that is in no formula
//! - [`mod@resubstitute`]: (a ∘ b) ∘ c for a class, a ∘ b being new
//!
//! A hit at every point of the field is an identity but for a chance below
//! 1e-40; the final program is proved at other points all the same.

mod multiples;
mod resubstitute;

use dalembert_model::scalar::Scalar;
use dalembert_model::scalar::field::Field;

use super::classes::{ClassId, Classes, ENode};
use super::sieve::Sieve;
use crate::graph::Fingerprint;

pub(crate) use multiples::multiples;
pub(crate) use resubstitute::resubstitute;

/// Tries every pair of the pool; returns how many new ways there are.
pub(crate) fn pairs(classes: &mut Classes, pool: &[ClassId]) -> usize {
    let mut known = Sieve::new(classes.len());
    for id in 0..classes.len() as ClassId {
        known.note(key(&classes.get(id).print));
    }
    let mut found = Vec::new();
    for_pairs(classes, pool, |first, way| {
        if known.passes(first) {
            found.push(way);
        }
    });
    let mut count = 0;
    for way in found {
        if let Some(hit) = classes.find(&classes.way_print(way)) {
            count += usize::from(classes.add_way(hit.class, way));
        }
    }
    count
}

/// Calls with the key of every sum, difference and product in the pool.
fn for_pairs(classes: &Classes, pool: &[ClassId], mut call: impl FnMut(Field, ENode)) {
    let first: Vec<Field> = pool.iter().map(|&id| classes.get(id).print.0[0]).collect();
    for (index, (&a, x)) in pool.iter().zip(&first).enumerate() {
        for (&b, y) in pool[index..].iter().zip(&first[index..]) {
            call(up_to_sign(x.add(y)), ENode::Sum(a, b));
            call(up_to_sign(x.sub(y)), ENode::Difference(a, b));
            call(up_to_sign(x.mul(y)), ENode::Product(a, b));
        }
    }
}

/// Returns the first point of a print up to sign: what agrees there is compared at all points
/// afterwards.
fn key(print: &Fingerprint) -> Field {
    up_to_sign(print.0[0])
}

fn up_to_sign(x: Field) -> Field {
    x.min(x.neg())
}
