//! The folds of builders, as tables of patterns; derivatives backwards and forwards.

use dalembert_model::scalar::Scalar;
use dalembert_model::scalar::dual::Dual;
use dalembert_model::scalar::field::Field;

use super::pattern::{Leaf, evaluate};
use super::{Builder, Dag, Edge, Folding, Id, Node, Operation};
use crate::random::Random;

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

/// Every builder folds these too; they save no operation.
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

/// The right side first: by fingerprint it is the value that is known.
fn sides((from, to): &(&str, &str), folding: Folding) -> [Edge; 2] {
    let mut builder = Builder::new(folding);
    let [to, from] = [to, from].map(|side| evaluate(side, &mut builder, Leaf::edge));
    [from, to]
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

fn drawn(random: &mut Random) -> Dag<u64, usize> {
    let mut nodes: Vec<Node<u64, usize>> = (0..3).map(Node::Input).collect();
    nodes.extend([2, 3].map(|c| Node::Constant(c + random.bits() % 1000)));
    for _ in 0..2 + random.below(12) {
        let operation = Operation::ALL[random.below(5)];
        let operands = [(); 2].map(|()| random.below(nodes.len()) as Id);
        nodes.push(Node::Apply(operation, operands));
    }
    let outputs = Vec::new();
    Dag { nodes, outputs }
}

#[test]
fn the_backward_pass_agrees_with_duals() {
    let (mut random, mut compared) = (Random::new(0xadd), 0);
    for _ in 0..200 {
        let dag = drawn(&mut random);
        let inputs = [(); 3].map(|()| Field::new(random.bits() >> 8));
        let constant = |c: &u64| Field::new(*c);
        let values = dag.values(&(constant, |input: usize| inputs[input]));
        // Where a divisor is zero there is no derivative.
        let mut divisors = dag
            .operations()
            .filter(|operation| operation.1 == Operation::Div);
        if divisors.any(|(_, _, [_, by])| values[by as usize] == Field::zero()) {
            continue;
        }
        for moving in 0..3 {
            let input = |input: usize| Dual {
                value: inputs[input],
                rate: Field::new(u64::from(input == moving)),
            };
            let forward = dag.values(&(|c: &u64| Dual::constant(Field::new(*c)), input));
            let mut adjoints = Vec::new();
            for (top, node) in forward.iter().enumerate() {
                dag.adjoints(top as Id, &values, &mut adjoints);
                let slope = adjoints.get(moving).copied().unwrap_or_else(Field::zero);
                assert_eq!(slope, node.rate, "node {top} of {dag:?}");
                compared += 1;
            }
        }
    }
    assert!(compared > 3000, "{compared}");
}
