//! Classes of equal values and the ways to compute each.
//!
//! A class is a fingerprint up to sign. Everything that finds a way to
//! compute a class adds it here: other formulations, the e-graph, the search.
//! [`extract`](super::extract) then chooses one way for each class.

use dalembert_model::number::Exact;
use dalembert_model::scalar::Scalar;
use rustc_hash::FxHashMap;

use crate::graph::{Builder, Edge, Fingerprint, Folding, Graph, Node, Points, Value};
use crate::program::Input;

/// The index of a class.
pub(crate) type ClassId = u32;

/// One way to compute a class from two others; operands ascending.
///
/// The operands stand for their canonical prints, and the result for the
/// class up to sign: signs are found again when a graph is built.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) enum ENode {
    /// a + b
    Sum(ClassId, ClassId),
    /// a − b
    Difference(ClassId, ClassId),
    /// a · b
    Product(ClassId, ClassId),
    /// a / b; these come from formulas alone, so every divisor is one of
    /// theirs.
    Quotient(ClassId, ClassId),
}

impl ENode {
    /// Returns the operands.
    pub(crate) fn operands(self) -> [ClassId; 2] {
        match self {
            ENode::Sum(a, b)
            | ENode::Difference(a, b)
            | ENode::Product(a, b)
            | ENode::Quotient(a, b) => [a, b],
        }
    }

    fn ordered(self) -> ENode {
        match self {
            ENode::Sum(a, b) if b < a => ENode::Sum(b, a),
            ENode::Difference(a, b) if b < a => ENode::Difference(b, a),
            ENode::Product(a, b) if b < a => ENode::Product(b, a),
            way => way,
        }
    }
}

/// A value that costs nothing.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Leaf {
    /// An exact constant.
    Constant(Exact),
    /// An input.
    Input(Input),
}

/// A class up to sign.
#[derive(Clone, Debug)]
pub(crate) struct Class {
    /// The canonical print.
    pub print: Fingerprint,
    /// The leaf that it is, if it is one: then there are no ways.
    pub leaf: Option<Leaf>,
    /// The ways to compute it, in the order they were found.
    pub ways: Vec<ENode>,
}

/// A class with a sign.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Signed {
    /// The class.
    pub class: ClassId,
    /// Whether the value is the negated canonical one.
    pub negative: bool,
}

/// All classes of one function.
#[derive(Clone, Debug, Default)]
pub(crate) struct Classes {
    classes: Vec<Class>,
    by_print: FxHashMap<Fingerprint, ClassId>,
    /// The function's results; `None` is zero.
    pub outputs: Vec<Option<Signed>>,
}

impl Classes {
    /// Returns the classes of a graph, which also gives the outputs.
    pub(crate) fn new(graph: &Graph) -> Classes {
        let mut classes = Classes::default();
        let values = classes.absorb(graph);
        classes.outputs = graph
            .outputs
            .iter()
            .map(|&edge| signed(&values, edge))
            .collect();
        classes
    }

    /// Returns the first way of each class: of a fresh [`Classes::new`] the program
    /// that the graph was, since a merged graph computes each class once.
    pub(crate) fn program(&self) -> Vec<Option<ENode>> {
        self.classes
            .iter()
            .map(|class| class.ways.first().copied())
            .collect()
    }

    /// Returns how many classes there are.
    pub(crate) fn len(&self) -> usize {
        self.classes.len()
    }

    /// Returns a class.
    pub(crate) fn get(&self, id: ClassId) -> &Class {
        &self.classes[id as usize]
    }

    /// Returns the class of a print, and whether the print is its negative.
    pub(crate) fn find(&self, print: &Fingerprint) -> Option<Signed> {
        let (canonical, negative) = print.canonical();
        let &class = self.by_print.get(&canonical)?;
        Some(Signed { class, negative })
    }

    /// Returns the class of a print, made if it is new.
    pub(crate) fn intern(&mut self, print: &Fingerprint) -> Signed {
        let (canonical, negative) = print.canonical();
        let classes = &mut self.classes;
        let class = *self.by_print.entry(canonical).or_insert_with(|| {
            classes.push(Class {
                print: canonical,
                leaf: None,
                ways: Vec::new(),
            });
            (classes.len() - 1) as ClassId
        });
        Signed { class, negative }
    }

    /// Declares a class to be a leaf: it needs no operation any more.
    pub(crate) fn set_leaf(&mut self, id: ClassId, leaf: Leaf) {
        let class = &mut self.classes[id as usize];
        class.ways.clear();
        class.leaf.get_or_insert(leaf);
    }

    /// Adds a way to compute a class; whether it was new.
    pub(crate) fn add_way(&mut self, id: ClassId, way: ENode) -> bool {
        let way = way.ordered();
        if let Some(constant) = self.folded(way) {
            // Up to sign it is the class, which stands for its canonical value.
            let print = Points::SEARCH.constant(&constant);
            let negative = print.is_some_and(|print| print.canonical().1);
            let value = if negative { constant.neg() } else { constant };
            self.set_leaf(id, Leaf::Constant(value));
            return false;
        }
        let class = &mut self.classes[id as usize];
        if class.leaf.is_some() || way.operands().contains(&id) || class.ways.contains(&way) {
            return false;
        }
        class.ways.push(way);
        true
    }

    /// Returns the value of an operation on two constants.
    fn folded(&self, way: ENode) -> Option<Exact> {
        let [a, b] = way.operands().map(|id| match &self.get(id).leaf {
            Some(Leaf::Constant(constant)) => Some(constant),
            _ => None,
        });
        let (a, b) = (a?, b?);
        Some(match way {
            ENode::Sum(..) => a.add(b),
            ENode::Difference(..) => a.sub(b),
            ENode::Product(..) => a.mul(b),
            ENode::Quotient(..) => return a.divide(b.as_rational()?),
        })
    }

    /// Returns the print of a way's result.
    pub(crate) fn way_print(&self, way: ENode) -> Fingerprint {
        let [a, b] = way.operands().map(|id| self.get(id).print);
        match way {
            ENode::Sum(..) => a.add(&b),
            ENode::Difference(..) => a.sub(&b),
            ENode::Product(..) => a.mul(&b),
            ENode::Quotient(..) => a.div(&b),
        }
    }

    /// Adds every node of a graph as a way to compute its class. Returns each
    /// node's class; `None` is zero.
    pub(crate) fn absorb(&mut self, graph: &Graph) -> Vec<Option<Signed>> {
        let points = Points::SEARCH;
        let mut prints: Vec<Fingerprint> = Vec::with_capacity(graph.nodes.len());
        let mut values = Vec::with_capacity(graph.nodes.len());
        for node in &graph.nodes {
            let of = |id: crate::graph::NodeId| &prints[id.index()];
            let print = match *node {
                Node::Constant(c) => points
                    .constant(&graph.constants[c as usize])
                    .unwrap_or_else(Fingerprint::zero),
                Node::Input(input) => points.input(input),
                Node::Sum(a, b) => of(a).add(of(b)),
                Node::Difference(a, b) => of(a).sub(of(b)),
                Node::Product(a, b) => of(a).mul(of(b)),
                Node::Quotient(a, b) => of(a).div(of(b)),
            };
            prints.push(print);
            values.push(self.value_of(graph, node, &print, &values));
        }
        values
    }

    fn value_of(
        &mut self,
        graph: &Graph,
        node: &Node,
        print: &Fingerprint,
        values: &[Option<Signed>],
    ) -> Option<Signed> {
        if *print == Fingerprint::zero() {
            return None;
        }
        let value = self.intern(print);
        match *node {
            Node::Constant(c) => {
                let constant = graph.constants[c as usize].clone();
                // The leaf is the canonical value, the edge may be its negative.
                let leaf = if value.negative {
                    constant.neg()
                } else {
                    constant
                };
                self.set_leaf(value.class, Leaf::Constant(leaf));
            }
            Node::Input(input) => self.set_leaf(value.class, Leaf::Input(input)),
            Node::Sum(a, b)
            | Node::Difference(a, b)
            | Node::Product(a, b)
            | Node::Quotient(a, b) => {
                if let (Some(x), Some(y)) = (values[a.index()], values[b.index()]) {
                    let same = x.negative == y.negative;
                    let way = match node {
                        Node::Product(..) => ENode::Product(x.class, y.class),
                        Node::Quotient(..) => ENode::Quotient(x.class, y.class),
                        Node::Sum(..) if same => ENode::Sum(x.class, y.class),
                        Node::Difference(..) if !same => ENode::Sum(x.class, y.class),
                        _ => ENode::Difference(x.class, y.class),
                    };
                    self.add_way(value.class, way);
                }
            }
        }
        Some(value)
    }

    /// Returns the graph that computes the outputs by the chosen ways.
    ///
    /// The choice must be acyclic below the outputs and name a way for each
    /// class that they need; classes beyond its end have no way.
    pub(crate) fn graph(&self, choice: &[Option<ENode>]) -> Graph {
        let mut builder = Builder::new(Folding::Semantic);
        let mut values: Vec<Option<Value>> = vec![None; self.len()];
        let mut pending: Vec<ClassId> = Vec::new();
        for output in self.outputs.iter().flatten() {
            pending.push(output.class);
            while let Some(&id) = pending.last() {
                if values[id as usize].is_some() {
                    pending.pop();
                    continue;
                }
                let class = self.get(id);
                let value = match (&class.leaf, choice.get(id as usize).copied().flatten()) {
                    (Some(Leaf::Constant(c)), _) => Value::Constant(c.clone()),
                    (Some(Leaf::Input(input)), _) => builder.input(*input),
                    (None, Some(way)) => {
                        let [a, b] = way.operands();
                        let (x, y) = (&values[a as usize], &values[b as usize]);
                        let (Some(x), Some(y)) = (x, y) else {
                            pending
                                .extend([a, b].iter().filter(|&&i| values[i as usize].is_none()));
                            continue;
                        };
                        match way {
                            ENode::Sum(..) => builder.add(x, y),
                            ENode::Difference(..) => builder.sub(x, y),
                            ENode::Product(..) => builder.mul(x, y),
                            ENode::Quotient(..) => builder.div(x, y),
                        }
                    }
                    (None, None) => Value::zero(),
                };
                // The value is the class up to sign; make it the canonical one.
                let negative = builder.print(&value) != class.print;
                values[id as usize] = Some(builder.negate_if(&value, negative));
                pending.pop();
            }
        }
        let outputs: Vec<Value> = self
            .outputs
            .iter()
            .map(|output| match output {
                None => Value::zero(),
                Some(signed) => match &values[signed.class as usize] {
                    Some(value) => builder.negate_if(value, signed.negative),
                    None => Value::zero(),
                },
            })
            .collect();
        builder.finish(&outputs)
    }
}

fn signed(values: &[Option<Signed>], edge: Edge) -> Option<Signed> {
    values[edge.node().index()].map(|value| Signed {
        class: value.class,
        negative: value.negative != edge.is_negative(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::rules::pattern::graph;

    fn class_of(classes: &Classes, output: usize) -> Signed {
        classes.outputs[output].expect("no output of these tests is zero")
    }

    #[test]
    fn equal_values_are_one_class_with_a_way_for_each_formula() {
        let classes = Classes::new(&graph(&["(* ?a (+ ?b ?c))", "(+ (* ?a ?b) (* ?a ?c))"]));
        let (first, second) = (class_of(&classes, 0), class_of(&classes, 1));
        assert_eq!(first, second);
        let ways = &classes.get(first.class).ways;
        assert!(matches!(
            ways.as_slice(),
            [ENode::Product(..), ENode::Sum(..)]
        ));
    }

    #[test]
    fn opposite_values_are_one_class_and_the_outputs_keep_their_signs() {
        let classes = Classes::new(&graph(&[
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
        let classes = Classes::new(&graph(&["(- (* ?a (+ ?b ?c)) (+ (* ?a ?b) (* ?a ?c)))"]));
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
        let points = Points::SEARCH;
        let ids = [3, 4].map(|number| {
            let class = classes
                .intern(&points.constant(&constant(number)).unwrap())
                .class;
            let leaf = match classes.get(class).print == points.constant(&constant(number)).unwrap()
            {
                true => constant(number),
                false => constant(-number),
            };
            classes.set_leaf(class, Leaf::Constant(leaf));
            class
        });
        let way = ENode::Product(ids[0], ids[1]);
        let product = classes.intern(&classes.way_print(way)).class;
        assert!(!classes.add_way(product, way), "a leaf needs no way");
        let Some(Leaf::Constant(leaf)) = &classes.get(product).leaf else {
            panic!("the product of two constants is a constant");
        };
        assert_eq!(points.constant(leaf), Some(classes.get(product).print));
    }

    #[test]
    fn a_class_takes_no_way_through_itself_and_none_twice() {
        let mut classes = Classes::new(&graph(&["(* ?a ?b)"]));
        let id = class_of(&classes, 0).class;
        let [a, b] = classes.get(id).ways[0].operands();
        assert!(!classes.add_way(id, ENode::Sum(a, id)));
        assert!(
            !classes.add_way(id, ENode::Product(b, a)),
            "the same way, operands exchanged"
        );
        assert_eq!(classes.get(id).ways.len(), 1);
    }

    #[test]
    fn every_choice_of_ways_gives_the_same_values() {
        let graph = graph(&[
            "(* ?a (+ ?b ?c))",
            "(- (* ?c ?d) (* ?b ?d))",
            "(+ (* ?a ?b) (* ?a ?c))",
            "(* ?d (- ?b ?c))",
        ]);
        let classes = Classes::new(&graph);
        let count = |id: usize| classes.get(id as ClassId).ways.len().max(1);
        let choices: usize = (0..classes.len()).map(count).product();
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
            let chosen = (0..classes.len()).map(|id| {
                let ways = &classes.get(id as ClassId).ways;
                let index = choice % ways.len().max(1);
                choice /= ways.len().max(1);
                ways.get(index).copied()
            });
            let chosen: Vec<Option<ENode>> = chosen.collect();
            assert_eq!(prints(&classes.graph(&chosen)), expected);
        }
    }
}
