//! Classes, against all choices of ways.

use super::*;
use crate::graph::pattern::graph;
use crate::graph::{Builder, Edge, Folding, Graph};

fn begun(graph: &Graph) -> Classes {
    let mut classes = Classes::default();
    classes.begin(graph);
    classes
}

fn class_of(classes: &Classes, output: usize) -> Signed {
    classes.outputs[output].expect("no output of these tests is zero")
}

#[test]
fn equal_values_are_one_class_with_a_way_for_each_formula() {
    let classes = begun(&graph(&["(* ?a (+ ?b ?c))", "(+ (* ?a ?b) (* ?a ?c))"]));
    let (first, second) = (class_of(&classes, 0), class_of(&classes, 1));
    assert_eq!(first, second);
    let operators = classes.ways_of(first.class).map(|way| way.operator);
    assert_eq!(
        operators.collect::<Vec<_>>(),
        [Operator::Product, Operator::Sum]
    );
}

#[test]
fn opposite_values_are_one_class_and_the_outputs_keep_their_signs() {
    let classes = begun(&graph(&[
        "(- ?a ?b)",
        "(- (* ?b ?c) (* ?a ?c))",
        "(* (- ?a ?b) ?c)",
    ]));
    let (second, third) = (class_of(&classes, 1), class_of(&classes, 2));
    assert_eq!(second.class, third.class);
    assert_ne!(second.negative, third.negative);
}

#[test]
fn what_is_zero_at_every_point_is_no_class() {
    let classes = begun(&graph(&["(- (* ?a (+ ?b ?c)) (+ (* ?a ?b) (* ?a ?c)))"]));
    assert_eq!(classes.outputs, [None]);
}

#[test]
fn an_operation_on_two_constants_makes_a_leaf_of_its_class() {
    let mut classes = Classes::default();
    let constant = |number: i64| {
        Exact::from(dalembert_model::number::Rational::from_integer(
            number.into(),
        ))
    };
    let ids = [3, 4].map(|number| classes.add_constant(&constant(number)).unwrap().class);
    for operator in [Operator::Sum, Operator::Difference, Operator::Product] {
        let value = classes.add(Way::new(operator, ids)).unwrap();
        assert_eq!(
            classes.ways_of(value.class).count(),
            0,
            "a leaf needs no way"
        );
        let Some(leaf @ Leaf::Constant(_)) = classes.leaf(value.class) else {
            panic!("an operation on two constants gives a constant");
        };
        assert_eq!(leaf_print(leaf), *classes.print(value.class));
    }
}

#[test]
fn a_class_takes_no_way_through_itself_and_none_twice() {
    let mut classes = begun(&graph(&["(* ?a ?b)"]));
    let id = class_of(&classes, 0).class;
    let [a, b] = classes.ways_of(id).next().unwrap().operands;
    let size = classes.size();
    // The same, operands exchanged.
    assert_eq!(
        classes
            .add(Way::new(Operator::Product, [b, a]))
            .unwrap()
            .class,
        id
    );
    assert_eq!(classes.size(), size);
    // a·b + (a·b)·0 through a class that is no zero: only a way without itself counts.
    classes.add(Way::new(Operator::Sum, [a, id]));
    assert_eq!(classes.ways_of(id).count(), 1);
}

#[test]
fn every_choice_of_ways_gives_the_same_values() {
    let graph = graph(&[
        "(* ?a (+ ?b ?c))",
        "(- (* ?c ?d) (* ?b ?d))",
        "(+ (* ?a ?b) (* ?a ?c))",
        "(* ?d (- ?b ?c))",
    ]);
    let classes = begun(&graph);
    let ways = |id: usize| classes.ways_of(Id::from(id)).collect::<Vec<Way>>();
    let roots: Vec<usize> = classes.ids().iter().map(|&id| usize::from(id)).collect();
    let choices: usize = roots.iter().map(|&id| ways(id).len().max(1)).product();
    assert!(choices >= 4, "several programs: {choices}");
    let prints = |graph: &Graph| {
        let mut builder = Builder::new(Folding::Semantic);
        let values = graph.replay(&mut builder);
        let output = |edge: &Edge| {
            let value = builder.negate_if(&values[edge.node().index()], edge.is_negative());
            builder.print(&value)
        };
        graph.outputs.iter().map(output).collect::<Vec<_>>()
    };
    let expected = prints(&graph);
    for mut choice in 0..choices {
        let mut chosen: Choice = vec![None; classes.bound()];
        for &id in &roots {
            let ways = ways(id);
            chosen[id] = ways.get(choice % ways.len().max(1)).copied();
            choice /= ways.len().max(1);
        }
        assert_eq!(prints(&classes.graph(&chosen)), expected);
    }
}
