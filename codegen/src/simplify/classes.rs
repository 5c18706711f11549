//! The e-graph of one function: every equality that the search knows.
//!
//! It is egg's, with fingerprints as its analysis. A class is a value up to sign, an
//! e-node computes it from the canonical values of other classes. E-nodes of equal
//! prints are united as the second one is added, so congruence has nothing left to
//! unite, and the root of a class is its first e-node for good.
//!
//! Formulations, [`rules`](super::rules) and [`discover`](super::discover) add e-nodes;
//! [`extract`](super::extract) chooses one for each class that the outputs need.

use std::fmt;

use dalembert_model::number::Exact;
use dalembert_model::scalar::Scalar;
use egg::{Analysis, DidMerge, FromOp, Id, Language, Pattern, SearchMatches, Searcher};
use rustc_hash::FxHashMap;

use crate::graph::{Builder, Edge, Fingerprint, Folding, Graph, Node, NodeId, Points, Value};
use crate::program::Input;

/// A class: its root in the e-graph.
pub(crate) type ClassId = Id;

/// The operator of a [`Way`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) enum Operator {
    /// Returns a + b
    Sum,
    /// Returns a − b
    Difference,
    /// Returns a · b
    Product,
    /// a / b; these come from formulas, and from rules that keep the divisor.
    Quotient,
}

/// An operation that computes a class from two others.
///
/// The operands stand for their canonical prints, and the result for the class up to
/// sign: signs are found again when a graph is built. Operands ascend, but for those of
/// a quotient.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) struct Way {
    /// The operator.
    pub operator: Operator,
    /// Returns the operands.
    pub operands: [ClassId; 2],
}

impl Way {
    /// An operation on two classes. Discovery makes one for each pair that it looks at.
    #[inline]
    pub(crate) fn new(operator: Operator, [a, b]: [ClassId; 2]) -> Way {
        let operands = match operator != Operator::Quotient && b < a {
            true => [b, a],
            false => [a, b],
        };
        Way { operator, operands }
    }
}

impl Operator {
    /// Returns the print of the result for operands with these prints.
    pub(super) fn print(self, [a, b]: [&Fingerprint; 2]) -> Fingerprint {
        match self {
            Operator::Sum => a.add(b),
            Operator::Difference => a.sub(b),
            Operator::Product => a.mul(b),
            Operator::Quotient => a.div(b),
        }
    }
}

/// An e-node.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) enum ENode {
    /// An operation.
    Way(Way),
    /// A value that costs nothing, by its index.
    Leaf(u32),
}

impl ENode {
    /// Returns the operator; none of a leaf.
    pub(super) fn operator(&self) -> Option<Operator> {
        match self {
            ENode::Way(way) => Some(way.operator),
            ENode::Leaf(_) => None,
        }
    }
}

impl Language for ENode {
    type Discriminant = Option<Operator>;

    /// Up to sign, sums and differences are one kind.
    fn discriminant(&self) -> Option<Operator> {
        match self.operator() {
            Some(Operator::Difference) => Some(Operator::Sum),
            operator => operator,
        }
    }

    fn matches(&self, other: &Self) -> bool {
        self.discriminant() == other.discriminant()
    }

    fn children(&self) -> &[Id] {
        match self {
            ENode::Way(way) => &way.operands,
            ENode::Leaf(_) => &[],
        }
    }

    fn children_mut(&mut self) -> &mut [Id] {
        match self {
            ENode::Way(way) => &mut way.operands,
            ENode::Leaf(_) => &mut [],
        }
    }
}

/// The words of patterns.
const OPERATORS: [(&str, Operator); 3] = [
    ("±", Operator::Sum),
    ("*", Operator::Product),
    ("/", Operator::Quotient),
];

impl fmt::Display for ENode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let word = |(_, operator): &&(&str, Operator)| self.discriminant() == Some(*operator);
        let found = OPERATORS.iter().find(word);
        f.write_str(found.map_or("leaf", |(word, _)| word))
    }
}

impl FromOp for ENode {
    type Error = String;

    fn from_op(op: &str, children: Vec<Id>) -> Result<Self, String> {
        let operator = OPERATORS.iter().find(|(word, _)| *word == op);
        let operands = <[Id; 2]>::try_from(children);
        let (Some(&(_, operator)), Ok(operands)) = (operator, operands) else {
            return Err(format!("expected ±, * or / of two operands, got `{op}`"));
        };
        Ok(ENode::Way(Way { operator, operands }))
    }
}

/// A value that costs nothing.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Leaf {
    /// An exact constant.
    Constant(Exact),
    /// Returns an input.
    Input(Input),
}

/// What is known of a class.
#[derive(Clone, Copy, Debug)]
struct Known {
    /// Its canonical print.
    print: Fingerprint,
    /// The leaf that it is, if it is one.
    leaf: Option<u32>,
}

/// The analysis: what is known of each class, and the class of each print.
#[derive(Clone, Debug, Default)]
struct Fingerprints {
    leaves: Vec<Leaf>,
    by_print: FxHashMap<Fingerprint, ClassId>,
    /// The classes, first made first.
    roots: Vec<ClassId>,
}

impl Analysis<ENode> for Fingerprints {
    type Data = Known;

    fn make(egraph: &mut egg::EGraph<ENode, Self>, node: &ENode, _: Id) -> Known {
        let (print, leaf) = match *node {
            ENode::Leaf(leaf) => {
                let print = leaf_print(&egraph.analysis.leaves[leaf as usize]);
                (print, Some(leaf))
            }
            ENode::Way(way) => {
                let operands = way.operands.each_ref().map(|id| &egraph[*id].data.print);
                (way.operator.print(operands), None)
            }
        };
        let print = print.canonical().0;
        Known { print, leaf }
    }

    fn merge(&mut self, known: &mut Known, new: Known) -> DidMerge {
        // Only classes of equal prints are united, and no print depends on which of them is
        // a leaf.
        known.leaf = known.leaf.or(new.leaf);
        DidMerge(false, false)
    }

    /// Unites the class of a new e-node with the one that has its print.
    fn modify(egraph: &mut egg::EGraph<ENode, Self>, id: Id) {
        let print = egraph[id].data.print;
        match egraph.analysis.by_print.get(&print) {
            None => {
                egraph.analysis.by_print.insert(print, id);
                egraph.analysis.roots.push(id);
            }
            Some(&known) if known != id => {
                egraph.union(known, id);
            }
            Some(_) => {
                // A leaf needs no operation any more.
                if let Some(leaf) = egraph[id].data.leaf {
                    egraph[id].nodes = vec![ENode::Leaf(leaf)];
                }
            }
        }
    }
}

/// The print of a leaf. One that has none is zero, as are the values that it is read for:
/// the proof refuses what comes of it.
fn leaf_print(leaf: &Leaf) -> Fingerprint {
    match leaf {
        Leaf::Constant(constant) => Points::SEARCH
            .constant(constant)
            .unwrap_or_else(Fingerprint::zero),
        Leaf::Input(input) => Points::SEARCH.input(*input),
    }
}

/// A class with a sign.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Signed {
    /// The class.
    pub class: ClassId,
    /// Whether the value is the negated canonical one.
    pub negative: bool,
}

/// A program: how each class is computed, by the index of the class.
pub(crate) type Choice = Vec<Option<Way>>;

/// All classes of one function.
#[derive(Clone, Debug, Default)]
pub(crate) struct Classes {
    egraph: egg::EGraph<ENode, Fingerprints>,
    /// The function's results; `None` is zero.
    pub outputs: Vec<Option<Signed>>,
}

impl Classes {
    /// Adds a program, which gives the outputs; returns its classes, operands before their
    /// users, and how it computes them.
    pub(crate) fn begin(&mut self, graph: &Graph) -> (Vec<ClassId>, Choice) {
        let values = self.absorb(graph);
        let outputs = graph.outputs.iter();
        self.outputs = outputs.map(|&edge| signed(&values, edge)).collect();
        let (mut own, mut choice) = (Vec::new(), vec![None; self.bound()]);
        let mut seen = vec![false; self.bound()];
        for (node, value) in graph.nodes.iter().zip(&values) {
            let Some(class) = value.map(|value| value.class) else {
                continue;
            };
            if std::mem::replace(&mut seen[usize::from(class)], true) {
                continue;
            }
            own.push(class);
            let Some((operator, [a, b])) = operation(node) else {
                continue;
            };
            if let (Some(x), Some(y)) = (values[a.index()], values[b.index()])
                && self.leaf(class).is_none()
            {
                choice[usize::from(class)] = Some(way(operator, x, y).0);
            }
        }
        (own, choice)
    }

    /// The classes, first made first.
    pub(crate) fn ids(&self) -> &[ClassId] {
        &self.egraph.analysis.roots
    }

    /// Returns a number above the index of every class.
    pub(crate) fn bound(&self) -> usize {
        self.egraph.nodes().len()
    }

    /// Returns the number of e-nodes.
    pub(crate) fn size(&self) -> usize {
        self.egraph.total_size()
    }

    /// Returns the canonical print of a class.
    pub(crate) fn print(&self, id: ClassId) -> &Fingerprint {
        &self.egraph[id].data.print
    }

    /// Returns the leaf that a class is, if it is one: then there are no ways.
    pub(crate) fn leaf(&self, id: ClassId) -> Option<&Leaf> {
        let leaf = self.egraph[id].data.leaf?;
        self.egraph.analysis.leaves.get(leaf as usize)
    }

    /// Returns every way and the class that it computes, in the order they were found.
    pub(crate) fn ways(&self) -> impl Iterator<Item = (ClassId, Way)> {
        let nodes = self.egraph.nodes().iter().enumerate();
        nodes.filter_map(move |(place, node)| {
            let ENode::Way(way) = node else { return None };
            let class = self.egraph.find(ClassId::from(place));
            self.leaf(class).is_none().then_some((class, *way))
        })
    }

    /// Returns the ways to compute one class.
    #[cfg(test)]
    pub(crate) fn ways_of(&self, id: ClassId) -> impl Iterator<Item = Way> {
        let ways = self.ways().filter(move |(class, _)| *class == id);
        ways.map(|(_, way)| way)
    }

    /// Returns the class of a print, and whether the print is its negative.
    pub(crate) fn find(&self, print: &Fingerprint) -> Option<Signed> {
        let (canonical, negative) = print.canonical();
        let &class = self.egraph.analysis.by_print.get(&canonical)?;
        Some(Signed { class, negative })
    }

    /// Adds a leaf and returns its class: it needs no operation any more.
    pub(crate) fn add_leaf(&mut self, leaf: Leaf) -> Signed {
        let print = leaf_print(&leaf);
        if let Some(known) = self.find(&print)
            && self.leaf(known.class).is_some()
        {
            return known;
        }
        let (_, negative) = print.canonical();
        // The class stands for its canonical value.
        let leaf = match leaf {
            Leaf::Constant(constant) if negative => Leaf::Constant(constant.neg()),
            leaf => leaf,
        };
        let leaves = &mut self.egraph.analysis.leaves;
        leaves.push(leaf);
        let node = ENode::Leaf(leaves.len() as u32 - 1);
        let class = self.egraph.add(node);
        Signed { class, negative }
    }

    /// Adds a way to compute a class, and returns the class with the sign of the result;
    /// `None` of what is zero.
    pub(crate) fn add(&mut self, way: Way) -> Option<Signed> {
        if let Some(constant) = self.folded(way) {
            return match constant.is_zero() {
                true => None,
                false => Some(self.add_leaf(Leaf::Constant(constant))),
            };
        }
        let print = self.way_print(way);
        if print == Fingerprint::zero() {
            return None;
        }
        match self.find(&print) {
            Some(known) if self.is_done(known.class, way) => Some(known),
            _ => {
                let (_, negative) = print.canonical();
                let class = self.egraph.add(ENode::Way(way));
                Some(Signed { class, negative })
            }
        }
    }

    /// Returns whether a way is none for a class: a leaf needs none, and no value of its own
    /// helps.
    fn is_done(&self, class: ClassId, way: Way) -> bool {
        way.operands.contains(&class) || self.leaf(class).is_some()
    }

    /// Adds a way to compute a class, if it is one.
    pub(crate) fn add_to(&mut self, class: ClassId, way: Way) {
        let hit = self.find(&self.way_print(way));
        if hit.is_some_and(|hit| hit.class == class) {
            self.add(way);
        }
    }

    /// Returns the value of an operation on two constants.
    fn folded(&self, way: Way) -> Option<Exact> {
        let constant = |id| match self.leaf(id)? {
            Leaf::Constant(constant) => Some(constant),
            Leaf::Input(_) => None,
        };
        let (a, b) = (constant(way.operands[0])?, constant(way.operands[1])?);
        Some(match way.operator {
            Operator::Sum => a.add(b),
            Operator::Difference => a.sub(b),
            Operator::Product => a.mul(b),
            Operator::Quotient => return a.divide(b.as_rational()?),
        })
    }

    /// Returns the print of a way's result.
    pub(crate) fn way_print(&self, way: Way) -> Fingerprint {
        way.operator.print(way.operands.map(|id| self.print(id)))
    }

    /// Returns where each of the patterns matches.
    pub(super) fn matches<'a>(
        &mut self,
        patterns: impl Iterator<Item = &'a Pattern<ENode>>,
    ) -> Vec<Vec<SearchMatches<'a, ENode>>> {
        self.egraph.rebuild();
        patterns
            .map(|pattern| pattern.search(&self.egraph))
            .collect()
    }

    /// Adds every node of a graph as a way to compute its class. Returns each node's class;
    /// `None` is zero.
    pub(crate) fn absorb(&mut self, graph: &Graph) -> Vec<Option<Signed>> {
        let mut values: Vec<Option<Signed>> = Vec::with_capacity(graph.nodes.len());
        for node in &graph.nodes {
            let value = match node {
                Node::Constant(c) => self.add_constant(&graph.constants[*c as usize]),
                Node::Input(input) => Some(self.add_leaf(Leaf::Input(*input))),
                _ => operation(node).and_then(|(operator, operands)| {
                    self.apply(operator, operands.map(|id| values[id.index()]))
                }),
            };
            values.push(value);
        }
        values
    }

    /// Adds a constant; `None` where the prints cannot tell it from zero.
    pub(crate) fn add_constant(&mut self, constant: &Exact) -> Option<Signed> {
        let print = Points::SEARCH.constant(constant)?;
        let leaf = || Leaf::Constant(constant.clone());
        (print != Fingerprint::zero()).then(|| self.add_leaf(leaf()))
    }

    /// Adds an operation on signed values, of which `None` is zero.
    fn apply(&mut self, operator: Operator, operands: [Option<Signed>; 2]) -> Option<Signed> {
        let (x, y) = match (operator, operands) {
            (_, [Some(x), Some(y)]) => (x, y),
            (Operator::Sum | Operator::Difference, [Some(x), None]) => return Some(x),
            (Operator::Sum, [None, y]) => return y,
            (Operator::Difference, [None, y]) => return y.map(|y| y.negated_if(true)),
            _ => return None,
        };
        let (way, negative) = way(operator, x, y);
        Some(self.add(way)?.negated_if(negative))
    }

    /// Builds the graph that computes the outputs by the chosen ways.
    ///
    /// The choice must be acyclic below the outputs and name a way for each class that
    /// they need; classes beyond its end have no way.
    pub(crate) fn graph(&self, choice: &[Option<Way>]) -> Graph {
        let mut builder = Builder::new(Folding::Semantic);
        let mut values: Vec<Option<Value>> = vec![None; self.bound()];
        let mut pending: Vec<ClassId> = Vec::new();
        for output in self.outputs.iter().flatten() {
            pending.push(output.class);
            while let Some(&id) = pending.last() {
                let place = usize::from(id);
                if values[place].is_some() {
                    pending.pop();
                    continue;
                }
                let value = match (self.leaf(id), choice.get(place).copied().flatten()) {
                    (Some(Leaf::Constant(c)), _) => Value::Constant(c.clone()),
                    (Some(Leaf::Input(input)), _) => builder.input(*input),
                    (None, Some(way)) => {
                        let [x, y] = way.operands.map(|id| values[usize::from(id)].as_ref());
                        let (Some(x), Some(y)) = (x, y) else {
                            let operands = way.operands.into_iter();
                            pending
                                .extend(operands.filter(|&id| values[usize::from(id)].is_none()));
                            continue;
                        };
                        match way.operator {
                            Operator::Sum => builder.add(x, y),
                            Operator::Difference => builder.sub(x, y),
                            Operator::Product => builder.mul(x, y),
                            Operator::Quotient => builder.div(x, y),
                        }
                    }
                    (None, None) => Value::zero(),
                };
                // The value is the class up to sign; make it the canonical one.
                let negative = builder.print(&value) != *self.print(id);
                values[place] = Some(builder.negate_if(&value, negative));
                pending.pop();
            }
        }
        let outputs = self.outputs.iter().map(|output| match output {
            None => Value::zero(),
            Some(signed) => match &values[usize::from(signed.class)] {
                Some(value) => builder.negate_if(value, signed.negative),
                None => Value::zero(),
            },
        });
        let outputs: Vec<Value> = outputs.collect();
        builder.finish(&outputs)
    }
}

impl Signed {
    fn negated_if(self, negative: bool) -> Signed {
        Signed {
            negative: self.negative != negative,
            ..self
        }
    }
}

fn signed(values: &[Option<Signed>], edge: Edge) -> Option<Signed> {
    let value = values[edge.node().index()]?;
    Some(value.negated_if(edge.is_negative()))
}

/// Returns the operation of a node; none of a leaf.
fn operation(node: &Node) -> Option<(Operator, [NodeId; 2])> {
    let operator = match node {
        Node::Constant(_) | Node::Input(_) => return None,
        Node::Sum(..) => Operator::Sum,
        Node::Difference(..) => Operator::Difference,
        Node::Product(..) => Operator::Product,
        Node::Quotient(..) => Operator::Quotient,
    };
    Some((operator, node.operands()?))
}

/// Returns an operation on signed values as one on canonical values, and whether it gives
/// the negative.
fn way(operator: Operator, x: Signed, y: Signed) -> (Way, bool) {
    let same = x.negative == y.negative;
    let (operator, negative) = match operator {
        Operator::Sum if same => (Operator::Sum, x.negative),
        Operator::Difference if !same => (Operator::Sum, x.negative),
        Operator::Sum | Operator::Difference => (Operator::Difference, x.negative),
        Operator::Product | Operator::Quotient => (operator, !same),
    };
    let way = Way::new(operator, [x.class, y.class]);
    // b − a is the opposite of a − b.
    let is_flipped = operator == Operator::Difference && way.operands[0] != x.class;
    (way, negative != is_flipped)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::pattern::graph;

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
}
