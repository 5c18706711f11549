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

use super::classes::{ClassId, Classes, Operator, Way};
use super::sieve::Sieve;

pub(crate) use multiples::multiples;
pub(crate) use resubstitute::resubstitute;

/// Tries every pair of the pool.
pub(crate) fn pairs(classes: &mut Classes, pool: &[ClassId]) {
    let mut known = Sieve::new(classes.ids().len());
    for &id in classes.ids() {
        known.note(up_to_sign(classes.print(id).0[0]));
    }
    let mut found = Vec::new();
    for_pairs(classes, pool, |first, way| {
        if known.passes(first) {
            found.push(way);
        }
    });
    for way in found {
        if classes.find(&classes.way_print(way)).is_some() {
            classes.add(way);
        }
    }
}

/// Calls with the key of every sum, difference and product in the pool.
fn for_pairs(classes: &Classes, pool: &[ClassId], mut call: impl FnMut(Field, Way)) {
    let first: Vec<Field> = pool.iter().map(|&id| classes.print(id).0[0]).collect();
    for (index, (&a, x)) in pool.iter().zip(&first).enumerate() {
        for (&b, y) in pool[index..].iter().zip(&first[index..]) {
            call(up_to_sign(x.add(y)), Way::new(Operator::Sum, [a, b]));
            call(up_to_sign(x.sub(y)), Way::new(Operator::Difference, [a, b]));
            call(up_to_sign(x.mul(y)), Way::new(Operator::Product, [a, b]));
        }
    }
}

/// The key of a value at the first point: what agrees there is compared at all points
/// afterwards.
fn up_to_sign(x: Field) -> Field {
    x.min(x.neg())
}

#[cfg(test)]
mod tests {
    use std::collections::HashMap;

    use dalembert_model::number::{Exact, Rational};

    use super::*;
    use crate::function::Argument;
    use crate::graph::pattern::{InBuilder, Pattern, is_constant};
    use crate::graph::{Builder, Folding, Value};
    use crate::program::Input;

    /// Who finds it, a formula that hides it, and what its way is at the top, up to sign.
    const HIDDEN: &[(&str, &str, Operator)] = &[
        ("pairs", "(- (+ ?a (+ ?b ?c)) ?c)", Operator::Sum),
        ("pairs", "(- (+ ?a ?c) (+ ?b ?c))", Operator::Sum),
        ("pairs", "(- (* ?a (+ ?b ?c)) (* ?a ?c))", Operator::Product),
        ("multiples", "(+ (* ?k ?a) (* ?m ?a))", Operator::Product),
        ("multiples", "(+ (+ ?a ?k) ?m)", Operator::Sum),
        ("multiples", "(+ (- ?k ?a) ?m)", Operator::Sum),
        (
            "resubstitute",
            "(- (+ (* ?a ?b) (+ ?c ?c)) ?c)",
            Operator::Sum,
        ),
        (
            "resubstitute",
            "(- (+ (* ?a ?b) ?c) (+ ?c ?c))",
            Operator::Sum,
        ),
        ("resubstitute", "(+ (* ?a ?c) (* ?b ?c))", Operator::Product),
    ];

    /// Up to sign, sums and differences are one kind.
    fn is_kind(way: Way, operator: Operator) -> bool {
        (way.operator == Operator::Product) == (operator == Operator::Product)
    }

    #[test]
    fn finds_every_kind_of_hidden_way() {
        for &(who, formula, operator) in HIDDEN {
            let mut builder = Builder::new(Folding::Syntactic);
            let formula = Pattern::parse(formula);
            let mut values = HashMap::new();
            let mut outputs = Vec::new();
            for (place, name) in formula.variables().into_iter().enumerate() {
                let value = match is_constant(name) {
                    true => {
                        let number = Rational::new((31 + 4 * place as i64).into(), 7.into());
                        Value::Constant(Exact::from(number))
                    }
                    false => builder.input(Input::Entry(Argument::Velocity, place)),
                };
                if !is_constant(name) {
                    outputs.push(value.clone());
                }
                values.insert(name, value);
            }
            outputs.insert(0, formula.evaluate(&mut InBuilder(&mut builder), &values));
            let mut classes = Classes::default();
            let (_, program) = classes.begin(&builder.finish(&outputs));
            let ids: Vec<ClassId> = classes.outputs.iter().flatten().map(|o| o.class).collect();
            let (target, inputs) = (ids[0], &ids[1..]);
            let known: Vec<Way> = classes.ways_of(target).collect();
            match who {
                "pairs" => pairs(&mut classes, inputs),
                // Of pairs with one key the first is taken: that of the inputs, not of y and one.
                "resubstitute" => resubstitute(&mut classes, &[inputs, &[target]].concat()),
                _ => multiples(&mut classes, &[inputs[0], target], &program),
            }
            let new = classes.ways_of(target).filter(|way| !known.contains(way));
            let new: Vec<Way> = new.collect();
            let found = new.iter().any(|&way| is_kind(way, operator));
            assert!(found, "{who}: {formula:?}: {new:?}");
            for way in new {
                let hit = classes.find(&classes.way_print(way));
                assert!(
                    hit.is_some_and(|hit| hit.class == target),
                    "{who}: {formula:?}"
                );
            }
        }
    }
}
