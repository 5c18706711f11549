//! The search, against all choices there are.

use super::*;
use crate::graph::rules::pattern::graph;
use crate::random::Random;

const MODEL: CostModel = CostModel::OPERATIONS;
const SCHEDULE: Schedule = Schedule {
    moves: 2_000,
    hot: 2.0,
    cold: 0.05,
};

/// Returns what the outputs cost by a choice, found from nothing but the choice;
/// `None` where it goes in a circle.
fn cost_of(classes: &Classes, choice: &[Option<ENode>]) -> Option<u64> {
    fn visit(
        classes: &Classes,
        choice: &[Option<ENode>],
        id: ClassId,
        state: &mut [u8],
    ) -> Option<u64> {
        match state[id as usize] {
            2 => return Some(0),
            1 => return None,
            _ => {}
        }
        if classes.get(id).leaf.is_some() {
            return Some(0);
        }
        state[id as usize] = 1;
        let way = choice[id as usize]?;
        let mut cost = MODEL.way(way);
        for operand in way.operands() {
            cost += visit(classes, choice, operand, state)?;
        }
        state[id as usize] = 2;
        Some(cost)
    }
    let mut state = vec![0; classes.len()];
    let outputs = classes.outputs.iter().flatten();
    let costs = outputs.map(|output| visit(classes, choice, output.class, &mut state));
    costs.sum()
}

/// The least cost over all choices.
fn least(classes: &Classes) -> u64 {
    let ways: Vec<&[ENode]> = (0..classes.len() as ClassId)
        .map(|id| classes.get(id).ways.as_slice())
        .collect();
    let count: usize = ways.iter().map(|ways| ways.len().max(1)).product();
    assert!((2..100_000).contains(&count), "{count} choices");
    let cost = |mut index: usize| {
        let choice = ways.iter().map(|ways| {
            let way = ways.get(index % ways.len().max(1)).copied();
            index /= ways.len().max(1);
            way
        });
        cost_of(classes, &choice.collect::<Vec<_>>())
    };
    (0..count)
        .filter_map(cost)
        .min()
        .expect("the program that came in is one")
}

/// Formulas of the same values, the first ones the outputs.
fn classes(outputs: &[&str], others: &[&str]) -> Classes {
    let mut classes = Classes::new(&graph(outputs));
    classes.absorb(&graph(others));
    classes
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
    for classes in &cases {
        let program = classes.program();
        let start = cost_of(classes, &program).unwrap();
        let mut search = Extraction::new(classes, &program, MODEL);
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
    let mut classes = Classes::new(&graph(&["(+ ?a (* ?b ?c))", "(* ?b ?c)"]));
    let [y, product] = [0, 1].map(|i| classes.outputs[i].unwrap().class);
    let sum = classes.get(y).ways[0];
    let a = sum
        .operands()
        .into_iter()
        .find(|&id| id != product)
        .unwrap();
    assert!(classes.add_way(product, ENode::Difference(y, a)));
    let program = classes.program();
    let mut search = Extraction::new(&classes, &program, MODEL);
    for seed in 0..20 {
        search.anneal(SCHEDULE, &mut Random::new(seed));
        assert!(cost_of(&classes, &search.choice()).is_some());
    }
    assert_eq!(search.cost(), MODEL.mul + MODEL.add);
}

#[test]
fn the_same_seed_gives_the_same_program() {
    let classes = classes(
        &["(+ (+ (* ?a ?b) (* ?a ?c)) (* ?d ?d))", "(* ?d (+ ?b ?c))"],
        &["(+ (* ?a (+ ?b ?c)) (* ?d ?d))", "(+ (* ?d ?b) (* ?d ?c))"],
    );
    let program = classes.program();
    let run = || {
        let mut search = Extraction::new(&classes, &program, MODEL);
        search.anneal(SCHEDULE, &mut Random::new(11));
        search.climb();
        (search.cost(), search.choice())
    };
    assert_eq!(run(), run());
}
