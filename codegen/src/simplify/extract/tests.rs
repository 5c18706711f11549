//! The search, against all choices there are.

use super::*;
use crate::graph::pattern::graph;
use crate::random::Random;
use crate::simplify::classes::{ClassId, Operator};

const MODEL: CostModel = CostModel::OPERATIONS;
const SCHEDULE: Schedule = Schedule {
    moves: 2_000,
    hot: 2.0,
    cold: 0.05,
};

/// Returns what the outputs cost by a choice, found from nothing but the choice;
/// `None` where it goes in a circle.
fn cost_of(classes: &Classes, choice: &[Option<Way>]) -> Option<u64> {
    fn visit(
        classes: &Classes,
        choice: &[Option<Way>],
        id: ClassId,
        state: &mut [u8],
    ) -> Option<u64> {
        match state[usize::from(id)] {
            2 => return Some(0),
            1 => return None,
            _ => {}
        }
        if classes.leaf(id).is_some() {
            return Some(0);
        }
        state[usize::from(id)] = 1;
        let way = choice[usize::from(id)]?;
        let mut cost = MODEL.way(way.operator);
        for operand in way.operands {
            cost += visit(classes, choice, operand, state)?;
        }
        state[usize::from(id)] = 2;
        Some(cost)
    }
    let mut state = vec![0; classes.bound()];
    let outputs = classes.outputs.iter().flatten();
    let costs = outputs.map(|output| visit(classes, choice, output.class, &mut state));
    costs.sum()
}

/// The least cost over all choices.
fn least(classes: &Classes) -> u64 {
    let ids = classes.ids().iter();
    let ways: Vec<Vec<Way>> = ids.map(|&id| classes.ways_of(id).collect()).collect();
    let count: usize = ways.iter().map(|ways| ways.len().max(1)).product();
    assert!((2..100_000).contains(&count), "{count} choices");
    let cost = |mut index: usize| {
        let mut choice: Choice = vec![None; classes.bound()];
        for (&id, ways) in classes.ids().iter().zip(&ways) {
            choice[usize::from(id)] = ways.get(index % ways.len().max(1)).copied();
            index /= ways.len().max(1);
        }
        cost_of(classes, &choice)
    };
    (0..count)
        .filter_map(cost)
        .min()
        .expect("the program that came in is one")
}

/// Formulas of the same values, the first ones the outputs.
fn classes(outputs: &[&str], others: &[&str]) -> (Classes, Choice) {
    let mut classes = Classes::default();
    let (_, program) = classes.begin(&graph(outputs));
    classes.absorb(&graph(others));
    (classes, program)
}

#[test]
fn finds_the_cheapest_of_all_programs() {
    let cases = [
        classes(
            &["(+ (* ?a ?b) (* ?a ?c))", "(* ?d (+ ?b ?c))"],
            &["(* ?a (+ ?b ?c))", "(+ (* ?d ?b) (* ?d ?c))"],
        ),
        // Sharing decides: a·b and a·c are wanted anyway.
        classes(
            &["(* ?a (+ ?b ?c))", "(* ?a ?b)", "(* ?a ?c)"],
            &["(+ (* ?a ?b) (* ?a ?c))"],
        ),
        classes(
            &[
                "(- (* ?a ?a) (* ?b ?b))",
                "(+ ?a ?b)",
                "(* (+ ?a ?b) (- ?c (+ ?a ?b)))",
            ],
            &[
                "(* (+ ?a ?b) (- ?a ?b))",
                "(- (* (+ ?a ?b) ?c) (* (+ ?a ?b) (+ ?a ?b)))",
            ],
        ),
    ];
    for (classes, program) in &cases {
        let start = cost_of(classes, program).unwrap();
        let mut search = Extraction::new(classes, program, MODEL);
        assert_eq!(
            search.cost(),
            start,
            "the price of the program that came in"
        );
        search.anneal(SCHEDULE, &mut Random::new(7));
        let found = search.choice();
        assert_eq!(
            cost_of(classes, &found),
            Some(search.cost()),
            "the price that it keeps"
        );
        assert_eq!(search.cost(), least(classes));
    }
}

#[test]
fn a_way_in_a_circle_is_never_taken() {
    // b·c from y − a, y from a + b·c: each is a way for the other.
    let (mut classes, program) = classes(&["(+ ?a (* ?b ?c))", "(* ?b ?c)"], &[]);
    let [y, product] = [0, 1].map(|i| classes.outputs[i].unwrap().class);
    let sum = classes.ways_of(y).next().unwrap();
    let a = sum.operands.into_iter().find(|&id| id != product).unwrap();
    for operator in [Operator::Sum, Operator::Difference] {
        classes.add_to(product, Way::new(operator, [y, a]));
    }
    assert_eq!(classes.ways_of(product).count(), 2);
    let mut search = Extraction::new(&classes, &program, MODEL);
    for seed in 0..20 {
        search.anneal(SCHEDULE, &mut Random::new(seed));
        assert!(cost_of(&classes, &search.choice()).is_some());
    }
    assert_eq!(search.cost(), MODEL.mul + MODEL.add);
}

#[test]
fn the_same_seed_gives_the_same_program() {
    let (classes, program) = classes(
        &["(+ (+ (* ?a ?b) (* ?a ?c)) (* ?d ?d))", "(* ?d (+ ?b ?c))"],
        &["(+ (* ?a (+ ?b ?c)) (* ?d ?d))", "(+ (* ?d ?b) (* ?d ?c))"],
    );
    let run = || {
        let mut search = Extraction::new(&classes, &program, MODEL);
        search.anneal(SCHEDULE, &mut Random::new(11));
        search.climb();
        (search.cost(), search.choice())
    };
    assert_eq!(run(), run());
}
