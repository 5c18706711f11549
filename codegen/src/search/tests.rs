//! The search against the field, and against all choices that there are.

use egg::Id as Class;

use super::egraph::{Choice, Classes, LeafPrints, Signed, Way, way};
use super::extract::{Extraction, Schedule};
use super::order::Order;
use super::rules::{self, RULES};
use super::{discover, price_of};
use crate::dag::pattern::graph;
use crate::dag::{Builder, Dag, Folding};
use crate::program::Operation;
use crate::random::Random;

use Operation::{Add, Mul, Sub};

fn begun(outputs: &[&str]) -> Classes {
    let mut classes = Classes::default();
    classes.begin(&graph(outputs));
    classes
}

fn class_of(classes: &Classes, output: usize) -> (Class, bool) {
    classes.outputs[output].expect("no output of these tests is zero")
}

fn ways_of(classes: &Classes, class: Class) -> Vec<Way> {
    let ways = classes.ways().filter(|(id, _)| *id == class);
    ways.map(|(_, way)| way).collect()
}

#[test]
fn equal_and_opposite_values_are_one_class() {
    let classes = begun(&["(* ?a (+ ?b ?c))", "(+ (* ?a ?b) (* ?a ?c))"]);
    assert_eq!(class_of(&classes, 0), class_of(&classes, 1));
    let ways = ways_of(&classes, class_of(&classes, 0).0);
    let operations = ways.iter().map(|way| way.0);
    assert_eq!(operations.collect::<Vec<_>>(), [Mul, Add]);
    let classes = begun(&["(- (* ?b ?c) (* ?a ?c))", "(* (- ?a ?b) ?c)"]);
    let [first, second] = [0, 1].map(|output| class_of(&classes, output));
    assert_eq!(first.0, second.0);
    assert_ne!(first.1, second.1);
    let classes = begun(&["(- (* ?a (+ ?b ?c)) (+ (* ?a ?b) (* ?a ?c)))"]);
    assert_eq!(classes.outputs, [None], "what is zero at every point");
}

#[test]
fn a_class_takes_no_way_through_itself_and_none_twice() {
    let mut classes = begun(&["(* ?a ?b)"]);
    let id = class_of(&classes, 0).0;
    let [a, b] = ways_of(&classes, id)[0].1;
    let size = classes.bound();
    assert_eq!(classes.add(way(Mul, [b, a])), Some((id, false)));
    classes.add(way(Add, [a, id]));
    assert_eq!(ways_of(&classes, id).len(), 1);
    assert_eq!(classes.bound(), size + 1, "the sum alone is new");
}

#[test]
fn every_choice_of_ways_gives_the_same_values() {
    let dag = graph(&[
        "(* ?a (+ ?b ?c))",
        "(- (* ?c ?d) (* ?b ?d))",
        "(+ (* ?a ?b) (* ?a ?c))",
        "(* ?d (- ?b ?c))",
    ]);
    let mut classes = Classes::default();
    classes.begin(&dag);
    let prints = |dag: &Dag| {
        let mut builder = Builder::new(Folding::Semantic);
        let results = builder.results(dag).into_iter();
        results.map(|edge| builder.print(edge)).collect::<Vec<_>>()
    };
    let expected = prints(&dag);
    let same: Vec<bool> = choices(&classes)
        .map(|choice| prints(&classes.graph(&choice)) == expected)
        .collect();
    assert!(same.len() >= 4 && !same.contains(&false), "{same:?}");
}

fn choices(classes: &Classes) -> impl Iterator<Item = Choice> {
    let with_ways = |&id: &Class| (id, ways_of(classes, id));
    let ways: Vec<(Class, Vec<Way>)> = classes.ids().iter().map(with_ways).collect();
    let count: usize = ways.iter().map(|(_, ways)| ways.len().max(1)).product();
    assert!(count < 100_000, "{count} choices");
    (0..count).map(move |mut index| {
        let mut choice: Choice = vec![None; classes.bound()];
        for (id, ways) in &ways {
            choice[usize::from(*id)] = ways.get(index % ways.len().max(1)).copied();
            index /= ways.len().max(1);
        }
        choice
    })
}

#[test]
fn every_rule_adds_its_right_side() {
    for (name, left, outer, _) in RULES {
        let orders = ["abc", "acb", "bac", "bca", "cab", "cba"];
        let texts = rules::signed(left).into_iter();
        for (text, order) in texts.flat_map(|text| orders.map(|order| (text.clone(), order))) {
            let renamed = |letter: char| {
                let place = "abc".find(letter);
                place.map_or(letter, |place| char::from(order.as_bytes()[place]))
            };
            let text: String = text.chars().map(renamed).collect();
            let mut classes = begun(&[&text]);
            let output = class_of(&classes, 0).0;
            let before = ways_of(&classes, output);
            rules::saturate(&mut classes, 1);
            let ways = ways_of(&classes, output);
            let mut new = ways.iter().filter(|way| !before.contains(way));
            let is_right = |way: &Way| outer.contains(&way.0);
            assert!(new.any(is_right), "{name}, {text}: {ways:?}");
            for way in ways {
                let class = classes.find(&classes.way_print(way));
                assert_eq!(class.map(|class| class.0), Some(output), "{name}, {text}");
            }
        }
    }
}

#[test]
fn finds_every_kind_of_hidden_way() {
    for (is_pair, formula, operation) in [
        (true, "(- (+ ?a (+ ?b ?c)) ?c)", Add),
        (true, "(- (+ ?a ?c) (+ ?b ?c))", Sub),
        (true, "(- (* ?a (+ ?b ?c)) (* ?a ?c))", Mul),
        (false, "(- (+ (* ?a ?b) (+ ?c ?c)) ?c)", Add),
        (false, "(- (+ (* ?a ?b) ?c) (+ ?c ?c))", Sub),
        (false, "(+ (* ?a ?c) (* ?b ?c))", Mul),
    ] {
        let mut classes = begun(&[formula, "?a", "?b", "?c"]);
        let ids: Vec<Class> = (0..4).map(|output| class_of(&classes, output).0).collect();
        let (target, inputs) = (ids[0], &ids[1..]);
        let known = ways_of(&classes, target);
        match is_pair {
            true => discover::pairs(&mut classes, inputs),
            // The first of the pairs with one key is taken: that of the inputs.
            false => discover::resubstitute(&mut classes, &[inputs, &[target]].concat()),
        }
        let mut new = ways_of(&classes, target);
        new.retain(|way| !known.contains(way));
        let is_kind = |way: &Way| (way.0 == Mul) == (operation == Mul);
        assert!(new.iter().any(is_kind), "{formula}: {new:?}");
        for way in new {
            let class: Signed = classes.find(&classes.way_print(way));
            assert_eq!(class.map(|class| class.0), Some(target), "{formula}");
        }
    }
}

const SCHEDULE: Schedule = Schedule::hot(2_000);

fn classes(outputs: &[&str], others: &[&str]) -> (Classes, Choice) {
    let mut classes = Classes::default();
    let (_, choice) = classes.begin(&graph(outputs));
    classes.absorb(&LeafPrints::new(&graph(others)));
    (classes, choice)
}

fn cost_of(classes: &Classes, choice: &Choice) -> Option<u64> {
    fn visit(classes: &Classes, choice: &Choice, id: Class, state: &mut [u8]) -> Option<u64> {
        let place = usize::from(id);
        match state[place] {
            1 => return None,
            2 => return Some(0),
            _ if classes.leaf(id).is_some() => return Some(0),
            _ => state[place] = 1,
        }
        let (operation, ends) = choice[place]?;
        let mut cost = price_of(operation);
        for end in ends {
            cost += visit(classes, choice, end, state)?;
        }
        state[place] = 2;
        Some(cost)
    }
    let mut state = vec![0; classes.bound()];
    let outputs = classes.outputs.iter().flatten();
    let costs = outputs.map(|output| visit(classes, choice, output.0, &mut state));
    costs.sum()
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
    for (classes, choice) in &cases {
        let mut extraction = Extraction::new(classes, choice);
        assert_eq!(Some(extraction.cost), cost_of(classes, choice));
        extraction.climb();
        extraction.anneal(SCHEDULE, &mut Random::new(7));
        let cost = cost_of(classes, &extraction.choice());
        assert_eq!(cost, Some(extraction.cost), "the price that it keeps");
        let least = choices(classes).filter_map(|choice| cost_of(classes, &choice));
        assert_eq!(cost, least.min());
    }
}

#[test]
fn a_way_in_a_circle_is_never_taken() {
    // b·c from y − a, y from a + b·c: each is a way for the other.
    let (mut classes, choice) = classes(&["(+ ?a (* ?b ?c))", "(* ?b ?c)"], &[]);
    let [y, product] = [0, 1].map(|output| class_of(&classes, output).0);
    let [first, second] = ways_of(&classes, y)[0].1;
    let a = if first == product { second } else { first };
    for operation in [Add, Sub] {
        classes.offer(way(operation, [y, a]), Some(product));
    }
    assert_eq!(ways_of(&classes, product).len(), 2);
    let mut extraction = Extraction::new(&classes, &choice);
    for seed in 0..20 {
        extraction.anneal(SCHEDULE, &mut Random::new(seed));
        assert!(cost_of(&classes, &extraction.choice()).is_some());
    }
    assert_eq!(extraction.cost, price_of(Mul) + price_of(Add));
}

#[test]
fn order_agrees_with_a_search_of_everything() {
    const CLASSES: usize = 40;
    // Class 0 is what leaves read.
    let reaches = |chosen: &[[u32; 2]], from: u32, class: u32| {
        let (mut marks, mut stack) = (vec![false; CLASSES], vec![from]);
        while let Some(id) = stack.pop() {
            if !std::mem::replace(&mut marks[id as usize], true) && id != 0 {
                stack.extend(chosen[id as usize]);
            }
        }
        marks[class as usize]
    };
    let mut random = Random::new(5);
    let mut chosen = vec![[0; 2]; CLASSES];
    let mut order = Order::new(CLASSES);
    order.sort(|id| chosen[id as usize]);
    let mut said = [0; 2];
    for round in 0..20_000 {
        let mut draw = || 1 + random.below(CLASSES - 1) as u32;
        let (class, reads) = (draw(), [draw(), draw()]);
        if round % 7 == 0 {
            chosen[class as usize] = [0; 2];
            continue;
        }
        let expected = !reads.iter().any(|&id| reaches(&chosen, id, class));
        let admitted = order.admits(class, reads, |id| chosen[id as usize]);
        assert_eq!(admitted, expected, "round {round}");
        said[usize::from(admitted)] += 1;
        if admitted {
            chosen[class as usize] = reads;
        }
    }
    assert!(said.iter().all(|&count| count > 1_000), "{said:?}");
}
