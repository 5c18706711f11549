//! One loop over every rule: both sides agree at random points of the field,
//! and the code that applies a table does what the table says.

use std::collections::HashMap;

use dalembert_model::number::{Exact, Rational};
use dalembert_model::scalar::field::{Field, Points as FieldPoints};
use dalembert_model::scalar::{Divide, Scalar};

use super::SATURATION;
use super::discovery::DISCOVERY;
use crate::function::Argument;
use crate::graph::rules::Rule;
use crate::graph::rules::folding::{BY_FINGERPRINT, BY_SHAPE, NORMAL_FORM};
use crate::graph::rules::pattern::{Algebra, InBuilder, Pattern, is_constant};
use crate::graph::{Builder, Folding, Value};
use crate::program::Input;
use crate::simplify::classes::{Classes, ENode};
use crate::simplify::discover;

/// Residues.
struct InField;

impl Algebra for InField {
    type Value = Field;
    fn number(&mut self, number: u64) -> Field {
        Field::new(number)
    }
    fn neg(&mut self, a: &Field) -> Field {
        a.neg()
    }
    fn operate(&mut self, symbol: &str, a: &Field, b: &Field) -> Field {
        match symbol {
            "+" => a.add(b),
            "-" => a.sub(b),
            "/" => a.div(b),
            _ => a.mul(b),
        }
    }
}

fn all_but_discovery() -> impl Iterator<Item = &'static Rule> {
    let folding = [BY_SHAPE, NORMAL_FORM, BY_FINGERPRINT];
    let folding = folding.into_iter().flatten();
    folding.chain(SATURATION.iter().map(|(_, rule)| rule))
}

/// Returns an input for each variable, a random decimal for each constant.
fn in_builder(
    builder: &mut Builder,
    names: &[char],
    points: &mut FieldPoints,
) -> HashMap<char, Value> {
    let mut values = HashMap::new();
    for (joint, &name) in names.iter().enumerate() {
        let value = match is_constant(name) {
            true => Value::Constant(constant(points)),
            false => builder.input(Input::Entry(Argument::Velocity, joint)),
        };
        values.insert(name, value);
    }
    values
}

fn constant(points: &mut FieldPoints) -> Exact {
    // Neither 0 nor ±1 nor 2, which have rules of their own.
    let number = 3 + (points.bits() % 1000) as i64;
    Exact::from(Rational::new(number.into(), 7.into()))
}

#[test]
fn both_sides_of_every_rule_agree_in_the_field() {
    let mut points = FieldPoints::new(0x7275_6c65);
    for rule in all_but_discovery() {
        let (from, to) = (Pattern::parse(rule.from), Pattern::parse(rule.to));
        let names = from.variables();
        assert!(
            to.variables().iter().all(|name| names.contains(name)),
            "{}: the right side knows more than the left",
            rule.name
        );
        for _ in 0..20 {
            let values = names.iter().map(|&name| (name, points.field())).collect();
            let sides = [&from, &to].map(|side| side.evaluate(&mut InField, &values));
            assert_eq!(sides[0], sides[1], "{}", rule.name);
        }
    }
}

#[test]
fn names_are_unique_within_their_table() {
    let saturation: Vec<Rule> = SATURATION.iter().map(|(_, rule)| *rule).collect();
    for table in [
        BY_SHAPE,
        NORMAL_FORM,
        BY_FINGERPRINT,
        DISCOVERY,
        &saturation,
    ] {
        for (index, rule) in table.iter().enumerate() {
            let again = table[..index].iter().any(|other| other.name == rule.name);
            assert!(!again, "{} twice", rule.name);
            assert!(!rule.sound.is_empty(), "{} gives no reason", rule.name);
        }
    }
}

#[test]
fn the_builder_folds_what_its_tables_say() {
    let mut points = FieldPoints::new(0x666f_6c64);
    let by_shape = BY_SHAPE.iter().chain(NORMAL_FORM);
    let by_shape = by_shape.map(|rule| (rule, Folding::Syntactic));
    let by_print = BY_FINGERPRINT.iter().map(|rule| (rule, Folding::Semantic));
    for (rule, folding) in by_shape.chain(by_print) {
        let (from, to) = (Pattern::parse(rule.from), Pattern::parse(rule.to));
        for _ in 0..5 {
            let mut builder = Builder::new(folding);
            let values = in_builder(&mut builder, &from.variables(), &mut points);
            // The right side first: by fingerprint it is the value that is known.
            let to = to.evaluate(&mut InBuilder(&mut builder), &values);
            let from = from.evaluate(&mut InBuilder(&mut builder), &values);
            assert_eq!(from, to, "{}", rule.name);
        }
    }
}

#[test]
fn fingerprint_rules_are_not_seen_by_shape() {
    // Else the table would show nothing of the fingerprints.
    let mut points = FieldPoints::new(3);
    for rule in BY_FINGERPRINT {
        let (from, to) = (Pattern::parse(rule.from), Pattern::parse(rule.to));
        let mut builder = Builder::new(Folding::Syntactic);
        let values = in_builder(&mut builder, &from.variables(), &mut points);
        let to = to.evaluate(&mut InBuilder(&mut builder), &values);
        let from = from.evaluate(&mut InBuilder(&mut builder), &values);
        assert_ne!(from, to, "{}", rule.name);
    }
}

/// A formula for each of discovery's left sides that hides its right side.
const HIDDEN: &[(&str, &str)] = &[
    ("pair-sum", "(- (+ ?a (+ ?b ?c)) ?c)"),
    ("pair-difference", "(- (+ ?a ?c) (+ ?b ?c))"),
    ("pair-product", "(- (* ?a (+ ?b ?c)) (* ?a ?c))"),
    ("multiple", "(+ (* ?k ?a) (* ?m ?a))"),
    ("shift", "(+ (+ ?a ?k) ?m)"),
    ("mirror", "(+ (- ?k ?a) ?m)"),
    ("substitute-sum", "(- (+ (* ?a ?b) (+ ?c ?c)) ?c)"),
    ("substitute-difference", "(- (+ (* ?a ?b) ?c) (+ ?c ?c))"),
    ("substitute-product", "(+ (* ?a ?c) (* ?b ?c))"),
];

#[test]
fn discovery_finds_every_kind_of_way_in_its_table() {
    let mut points = FieldPoints::new(0x6669_6e64);
    assert_eq!(HIDDEN.len(), DISCOVERY.len());
    for (rule, (name, hidden)) in DISCOVERY.iter().zip(HIDDEN) {
        assert_eq!(rule.name, *name);
        let mut builder = Builder::new(Folding::Syntactic);
        let hidden = Pattern::parse(hidden);
        let values = in_builder(&mut builder, &hidden.variables(), &mut points);
        let y = hidden.evaluate(&mut InBuilder(&mut builder), &values);
        let mut outputs = vec![y];
        let names = hidden.variables().into_iter();
        let names: Vec<char> = names.filter(|&name| !is_constant(name)).collect();
        outputs.extend(names.iter().map(|name| values[name].clone()));
        let mut classes = Classes::new(&builder.finish(&outputs));
        let ids: Vec<u32> = classes.outputs.iter().flatten().map(|o| o.class).collect();
        let (target, inputs) = (ids[0], &ids[1..]);
        let known = classes.get(target).ways.clone();
        let found = match rule.name.split('-').next() {
            Some("pair") => discover::pairs(&mut classes, inputs),
            // Of pairs with one key the first is taken: that of the inputs, not of y and one.
            Some("substitute") => {
                discover::resubstitute(&mut classes, &[inputs, &[target]].concat())
            }
            _ => {
                let program = classes.program();
                discover::multiples(&mut classes, &[inputs[0], target], &program)
            }
        };
        let new: Vec<ENode> = classes.get(target).ways.clone();
        let new = new.into_iter().filter(|way| !known.contains(way));
        let new: Vec<ENode> = new.collect();
        assert!(found > 0, "{}", rule.name);
        assert!(
            new.iter().any(|&way| is_kind(rule, way)),
            "{}: {new:?}",
            rule.name
        );
        for way in new {
            let hit = classes.find(&classes.way_print(way));
            assert!(hit.is_some_and(|hit| hit.class == target), "{}", rule.name);
        }
    }
}

/// A class is a value up to sign: its sums and differences are one kind.
fn is_kind(rule: &Rule, way: ENode) -> bool {
    let product = rule.to.starts_with("(*");
    product == matches!(way, ENode::Product(..))
}
