//! Every reason, by perturbing what it names and what it does not.

use std::fs;

use dalembert_model::read::parse;
use dalembert_model::robot::Robot;

use super::*;
use dalembert_model::scalar::field::{Field, Points};

fn read(path: &str) -> Robot {
    let path = format!("{}/../../{path}.toml", env!("CARGO_MANIFEST_DIR"));
    parse(&fs::read_to_string(path).unwrap()).unwrap().robot
}

const ROBOTS: [&str; 9] = [
    "generated/robots/puma560",
    "generated/robots/stanford",
    "generated/robots/ur10",
    "generated/robots/panda",
    "codegen/tests/data/scara",
    "codegen/tests/data/gantry",
    "gallery/robots/iiwa14",
    "gallery/robots/g1_hand",
    "gallery/robots/panda_gripper",
];

/// Returns true if an entry vanishes where base parameters have these values.
fn vanishes(entry: &Polynomial, values: &[Field]) -> bool {
    let mut sums: BTreeMap<u128, Field> = BTreeMap::new();
    for (monomial, x) in entry.terms() {
        let index = monomial.symbols.parameter_index();
        let value = index.map_or(Field::ONE, |index| values[index]);
        let sum = sums.entry(monomial.motion).or_insert(Field::ZERO);
        *sum = sum.add(&value.mul(&x.residue()));
    }
    sums.values().all(is_zero)
}

#[test]
fn facts_are_needed_and_suffice() {
    let mut checked = 0;
    for path in ROBOTS {
        let robot = read(path);
        let setup = Setup::whole(&robot);
        let mut finder = Finder::new(&setup).unwrap();
        let arm_facts = finder.facts.clone();
        let in_numbers = finder.in_numbers.clone();
        for (entry, _) in entries(&in_numbers).iter().filter(|(_, x)| x.is_zero()) {
            let is_of_geometry = finder.zeros(&arm_facts).contains(entry);
            if !is_of_geometry || finder.zeros(&[]).contains(entry) {
                continue;
            }
            let kept = fewest(&arm_facts, |facts| finder.zeros(facts).contains(entry));
            // Other facts may be anything.
            assert!(finder.zeros(&kept).contains(entry), "{path}: {entry:?}");
            for fact in &kept {
                let is_zero = finder.zeros(&without(&kept, fact)).contains(entry);
                assert!(!is_zero, "{path}: {entry:?}, {fact:?}");
                checked += 1;
            }
        }
    }
    assert!(checked > 60, "{checked}");
}

#[test]
fn conditions_are_needed_and_suffice() {
    let mut checked = 0;
    let mut points = Points::new(5);
    for path in ROBOTS {
        let robot = read(path);
        let setup = Setup::whole(&robot);
        let finder = Finder::new(&setup).unwrap();
        let values: Vec<Field> = finder.values.iter().map(Number::residue).collect();
        let numbers = entries(&finder.in_numbers);
        let symbolic = entries(&finder.in_parameters);
        for ((entry, x), (_, polynomial)) in numbers.iter().zip(&symbolic) {
            if !x.is_zero() || polynomial.is_zero() {
                continue;
            }
            assert!(vanishes(polynomial, &values), "{path}: {entry:?}");
            let conditions = conditions(polynomial);
            for condition in &conditions {
                let mut changed = values.clone();
                let lead = *condition.last_key_value().unwrap().0;
                changed[lead] = changed[lead].add(&points.field());
                assert!(!vanishes(polynomial, &changed), "{path}: {entry:?}");
                checked += 1;
            }
            let mut changed = values.clone();
            for (parameter, value) in changed.iter_mut().enumerate() {
                let is_in = |condition: &Condition| condition.contains_key(&parameter);
                if !conditions.iter().any(is_in) {
                    *value = points.field();
                }
            }
            assert!(vanishes(polynomial, &changed), "{path}: {entry:?}");
        }
    }
    assert!(checked > 120, "{checked}");
}
