//! What builders fold, as tables of patterns.

use std::collections::HashMap;

use dalembert_model::number::{Exact, Rational};

use super::pattern::{InBuilder, Pattern, is_constant};
use super::{Builder, Edge, Folding};
use crate::dag::Input;
use crate::function::Argument;

/// Every builder folds these.
pub(crate) const BY_SHAPE: &[(&str, &str)] = &[
    ("(+ ?k ?m)", "(+ ?k ?m)"),
    ("(- ?k ?m)", "(- ?k ?m)"),
    ("(* ?k ?m)", "(* ?k ?m)"),
    ("(+ ?a 0)", "?a"),
    ("(+ 0 ?a)", "?a"),
    ("(- ?a 0)", "?a"),
    ("(- 0 ?a)", "(neg ?a)"),
    ("(- ?a ?a)", "0"),
    ("(+ ?a (neg ?a))", "0"),
    ("(* 0 ?a)", "0"),
    ("(* 1 ?a)", "?a"),
    ("(* (neg 1) ?a)", "(neg ?a)"),
    ("(* ?a ?k)", "(* ?k ?a)"),
    ("(* (neg ?k) ?a)", "(neg (* ?k ?a))"),
    ("(* ?k (* ?m ?a))", "(* (* ?k ?m) ?a)"),
];

/// These too; they save no operation.
pub(crate) const NORMAL_FORM: &[(&str, &str)] = &[
    ("(* 2 ?a)", "(+ ?a ?a)"),
    ("(+ ?b ?a)", "(+ ?a ?b)"),
    ("(* ?b ?a)", "(* ?a ?b)"),
    ("(- ?b ?a)", "(neg (- ?a ?b))"),
    ("(+ (neg ?a) ?b)", "(neg (- ?a ?b))"),
    ("(- (neg ?a) ?b)", "(neg (+ ?a ?b))"),
    ("(- ?a (neg ?b))", "(+ ?a ?b)"),
    ("(* (neg ?a) ?b)", "(neg (* ?a ?b))"),
];

/// A builder that merges equal values folds these, which no shape shows.
pub(crate) const BY_FINGERPRINT: &[(&str, &str)] = &[
    ("(+ (* ?a ?b) (* ?a ?c))", "(* ?a (+ ?b ?c))"),
    ("(- (* ?b ?a) (* ?c ?a))", "(neg (* ?a (- ?c ?b)))"),
    (
        "(- (- (* (+ ?a ?b) (+ ?a ?b)) (* ?a ?a)) (* ?b (+ ?b (+ ?a ?a))))",
        "0",
    ),
    ("(- (+ ?a ?k) (+ ?a ?m))", "(- ?k ?m)"),
];

/// Both sides of a row in a builder: an input for each variable, a decimal for each
/// constant. The right side first: by fingerprint it is the value that is known.
fn sides((from, to): &(&str, &str), folding: Folding) -> [Edge; 2] {
    let (from, to) = (Pattern::parse(from), Pattern::parse(to));
    let mut builder = Builder::new(folding);
    let mut values = HashMap::new();
    for (place, name) in from.variables().into_iter().enumerate() {
        let value = match is_constant(name) {
            true => {
                let number = Rational::new((31 + 4 * place as i64).into(), 7.into());
                builder.constant(&Exact::from(number))
            }
            false => builder.input(Input::Entry(Argument::Velocity, place)),
        };
        values.insert(name, value);
    }
    let to = to.evaluate(&mut InBuilder(&mut builder), &values);
    [from.evaluate(&mut InBuilder(&mut builder), &values), to]
}

#[test]
fn left_sides_become_right_sides() {
    for row in BY_SHAPE.iter().chain(NORMAL_FORM) {
        let [from, to] = sides(row, Folding::Syntactic);
        assert_eq!(from, to, "{row:?}");
    }
    for row in BY_FINGERPRINT {
        let [from, to] = sides(row, Folding::Semantic);
        assert_eq!(from, to, "{row:?}");
        // Else the row would show nothing of the fingerprints.
        let [from, to] = sides(row, Folding::Syntactic);
        assert_ne!(from, to, "{row:?}");
    }
}
