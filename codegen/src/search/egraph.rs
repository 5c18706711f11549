//! The e-graph of one function: every equality that the search knows.
//!
//! It is egg's, with fingerprints as its analysis. A class is a value up to sign; an e-node
//! computes it from the canonical values of other classes. E-nodes with equal prints are united
//! as the second one is added, so congruence has nothing left to unite, and the root of a class
//! is its first e-node for good.

use dalembert_model::scalar::Scalar;
use egg::{
    Analysis, DidMerge, EGraph, Id as Class, Pattern, SearchMatches, Searcher, define_language,
};
use rustc_hash::FxHashMap;

use crate::dag::{Builder, Dag, Edge, Fingerprint, Folding, Node};
use crate::program::Operation;

define_language! {
    /// An operation on two classes, or a leaf by its place in the list of leaves.
    pub enum ENode {
        "+" = Add([Class; 2]),
        "-" = Sub([Class; 2]),
        "*" = Mul([Class; 2]),
        "/" = Div([Class; 2]),
        Leaf(u32),
    }
}

/// One way to compute a class. Operands ascend, except those of a quotient.
pub(super) type Way = (Operation, [Class; 2]);

#[inline]
pub(super) fn way(op: Operation, [a, b]: [Class; 2]) -> Way {
    match op != Operation::Div && b < a {
        true => (op, [b, a]),
        false => (op, [a, b]),
    }
}

impl ENode {
    pub(super) fn way(&self) -> Option<Way> {
        match *self {
            ENode::Add(ends) => Some((Operation::Add, ends)),
            ENode::Sub(ends) => Some((Operation::Sub, ends)),
            ENode::Mul(ends) => Some((Operation::Mul, ends)),
            ENode::Div(ends) => Some((Operation::Div, ends)),
            ENode::Leaf(_) => None,
        }
    }

    fn from_way((operation, ends): Way) -> ENode {
        match operation {
            Operation::Add => ENode::Add(ends),
            Operation::Sub => ENode::Sub(ends),
            Operation::Mul | Operation::Fused => ENode::Mul(ends),
            Operation::Div => ENode::Div(ends),
        }
    }
}

#[derive(Clone, Default)]
pub(super) struct Prints {
    prints: Vec<Fingerprint>,
    leaf: Vec<Option<u32>>,
    leaves: Vec<(Node, Fingerprint)>,
    by_print: FxHashMap<Fingerprint, Class>,
    roots: Vec<Class>,
}

impl Analysis<ENode> for Prints {
    type Data = ();

    fn make(egraph: &mut EGraph<ENode, Self>, node: &ENode, _: Class) {
        let analysis = &mut egraph.analysis;
        let (print, leaf) = match (node, node.way()) {
            (_, Some(way)) => (analysis.way_print(way), None),
            (ENode::Leaf(leaf), _) => (analysis.leaves[*leaf as usize].1, Some(*leaf)),
            _ => (Fingerprint::zero(), None),
        };
        analysis.prints.push(print.canonical().0);
        analysis.leaf.push(leaf);
    }

    fn merge(&mut self, (): &mut (), (): ()) -> DidMerge {
        DidMerge(false, false)
    }

    fn modify(egraph: &mut EGraph<ENode, Self>, id: Class) {
        let analysis = &mut egraph.analysis;
        let print = analysis.prints[usize::from(id)];
        let root = *analysis.by_print.entry(print).or_insert(id);
        match root == id {
            true if analysis.roots.last() < Some(&id) => analysis.roots.push(id),
            true => {
                if let Some(leaf) = analysis.leaf[usize::from(id)] {
                    egraph[id].nodes = vec![ENode::Leaf(leaf)];
                }
            }
            false => {
                let leaf = analysis.leaf[usize::from(id)];
                let known = &mut analysis.leaf[usize::from(root)];
                *known = known.or(leaf);
                egraph.union(root, id);
            }
        }
    }
}

impl Prints {
    fn way_print(&self, (operation, ends): Way) -> Fingerprint {
        let print = |id: Class| &self.prints[usize::from(id)];
        operation.apply(print(ends[0]), print(ends[1]))
    }
}

/// A graph with the fingerprints of its leaves: rounds of a search read the same graphs.
pub(super) struct LeafPrints<'a> {
    dag: &'a Dag,
    prints: Vec<Fingerprint>,
}

impl<'a> LeafPrints<'a> {
    pub(super) fn new(dag: &'a Dag) -> LeafPrints<'a> {
        let prints = dag.nodes.iter().map(Node::leaf_print).collect();
        LeafPrints { dag, prints }
    }
}

/// A class with a sign; the value zero has none.
pub(super) type Signed = Option<(Class, bool)>;

fn flip(value: Signed, negative: bool) -> Signed {
    value.map(|(class, sign)| (class, sign != negative))
}

pub(super) type Choice = Vec<Option<Way>>;

/// Operations that differ in signs alone.
pub(super) type Kind = &'static [Operation];
pub(super) const SUM: Kind = &[Operation::Add, Operation::Sub];
pub(super) const PRODUCT: Kind = &[Operation::Mul];

#[derive(Default)]
pub(super) struct Classes {
    egraph: EGraph<ENode, Prints>,
    pub(super) outputs: Vec<Signed>,
}

impl Classes {
    pub(super) fn ids(&self) -> &[Class] {
        &self.egraph.analysis.roots
    }

    pub(super) fn bound(&self) -> usize {
        self.egraph.nodes().len()
    }

    pub(super) fn print(&self, class: Class) -> &Fingerprint {
        &self.egraph.analysis.prints[usize::from(class)]
    }

    pub(super) fn way_print(&self, way: Way) -> Fingerprint {
        self.egraph.analysis.way_print(way)
    }

    /// Returns the leaf that a class is: then it has no ways.
    pub(super) fn leaf(&self, class: Class) -> Option<&Node> {
        let analysis = &self.egraph.analysis;
        analysis.leaf[usize::from(class)].map(|leaf| &analysis.leaves[leaf as usize].0)
    }

    pub(super) fn find(&self, print: &Fingerprint) -> Signed {
        let (canonical, negative) = print.canonical();
        let class = self.egraph.analysis.by_print.get(&canonical)?;
        Some((*class, negative))
    }

    pub(super) fn ways(&self) -> impl Iterator<Item = (Class, Way)> {
        let nodes = self.egraph.nodes().iter().enumerate();
        nodes.filter_map(|(place, node)| {
            let class = self.egraph.find(Class::from(place));
            let way = node.way().filter(|_| self.leaf(class).is_none())?;
            Some((class, way))
        })
    }

    /// All are sought at once: egg puts every class in order before it can be searched.
    pub(super) fn matches<'p>(
        &mut self,
        patterns: impl Iterator<Item = &'p Pattern<ENode>>,
    ) -> Vec<Vec<SearchMatches<'p, ENode>>> {
        self.egraph.rebuild();
        patterns.map(|rule| rule.search(&self.egraph)).collect()
    }

    fn add_leaf(&mut self, leaf: &Node, print: &Fingerprint) -> Signed {
        if *print == Fingerprint::zero() {
            return None;
        }
        let (_, negative) = print.canonical();
        match self.find(print) {
            Some(known) if self.leaf(known.0).is_some() => Some(known),
            _ => {
                // The class stands for its canonical value.
                let leaf = match leaf {
                    Node::Constant(c) if negative => Node::Constant(c.neg()),
                    leaf => leaf.clone(),
                };
                let leaf = (leaf, print.canonical().0);
                self.egraph.analysis.leaves.push(leaf);
                let index = self.egraph.analysis.leaves.len() as u32 - 1;
                Some((self.egraph.add(ENode::Leaf(index)), negative))
            }
        }
    }

    pub(super) fn add(&mut self, way: Way) -> Signed {
        let print = self.way_print(way);
        self.add_printed(way, &print, self.find(&print))
    }

    fn add_printed(&mut self, way: Way, print: &Fingerprint, known: Signed) -> Signed {
        if let (Some(Node::Constant(a)), Some(Node::Constant(b))) =
            (self.leaf(way.1[0]), self.leaf(way.1[1]))
            && let Some(constant) = way.0.exactly(a, b)
        {
            let leaf = Node::Constant(constant);
            return self.add_leaf(&leaf, &leaf.leaf_print());
        }
        match known {
            _ if *print == Fingerprint::zero() => None,
            // A leaf needs no way, and no value of its own helps.
            Some((class, _)) if way.1.contains(&class) || self.leaf(class).is_some() => known,
            _ => Some((self.egraph.add(ENode::from_way(way)), print.canonical().1)),
        }
    }

    /// Adds a way if it computes a class that is known; this one, if one is given.
    pub(super) fn offer(&mut self, way: Way, class: Option<Class>) {
        let print = self.way_print(way);
        let known = self.find(&print);
        if known.is_some_and(|(id, _)| class.is_none_or(|class| class == id)) {
            self.add_printed(way, &print, known);
        }
    }

    pub(super) fn absorb(&mut self, graph: &LeafPrints) -> (Vec<Signed>, Choice) {
        let LeafPrints { dag, prints } = graph;
        let mut values: Vec<Signed> = Vec::with_capacity(dag.nodes.len());
        let mut choice: Choice = Vec::new();
        for (node, print) in dag.nodes.iter().zip(prints) {
            let Node::Apply(op, ends) = node else {
                values.push(self.add_leaf(node, print));
                continue;
            };
            let (x, y) = (values[ends[0] as usize], values[ends[1] as usize]);
            values.push(match (op, x, y) {
                (_, Some((a, s)), Some((b, t))) => {
                    let (op, negative) = match op {
                        Operation::Add | Operation::Sub if (s == t) == (*op == Operation::Add) => {
                            (Operation::Add, s)
                        }
                        Operation::Add | Operation::Sub => (Operation::Sub, s),
                        op => (*op, s != t),
                    };
                    let way = way(op, [a, b]);
                    // b − a is the opposite of a − b.
                    let swapped = op == Operation::Sub && way.1[0] != a;
                    let value = flip(self.add(way), negative != swapped);
                    if let Some((class, _)) = value {
                        choice.resize(self.bound(), None);
                        choice[usize::from(class)].get_or_insert(way);
                    }
                    value
                }
                (Operation::Add | Operation::Sub, x, None) => x,
                (Operation::Add, None, y) => y,
                (Operation::Sub, None, y) => flip(y, true),
                _ => None,
            });
        }
        choice.resize(self.bound(), None);
        (values, choice)
    }

    pub(super) fn begin(&mut self, dag: &Dag) -> (Vec<Class>, Choice) {
        let (values, choice) = self.absorb(&LeafPrints::new(dag));
        let output = |edge: &Edge| flip(values[edge.index()], edge.negative);
        self.outputs = dag.outputs.iter().map(output).collect();
        let mut classes: Vec<Class> = values.into_iter().flatten().map(|value| value.0).collect();
        let mut marks = vec![false; self.bound()];
        classes.retain(|class| !std::mem::replace(&mut marks[usize::from(*class)], true));
        (classes, choice)
    }

    /// The ways must not go in circles.
    pub(super) fn graph(&self, choice: &Choice) -> Dag {
        let mut builder = Builder::new(Folding::Semantic);
        let mut edges: Vec<Option<Edge>> = vec![None; self.bound()];
        let mut pending: Vec<Class> = self.outputs.iter().flatten().map(|o| o.0).collect();
        while let Some(&class) = pending.last() {
            let place = usize::from(class);
            let edge = match (self.leaf(class), choice[place]) {
                _ if edges[place].is_some() => None,
                (Some(Node::Input(input)), _) => Some(builder.input(*input)),
                (Some(Node::Constant(constant)), _) => Some(builder.constant(constant)),
                (_, Some((operation, ends))) => match ends.map(|id| edges[usize::from(id)]) {
                    [Some(a), Some(b)] => Some(builder.apply(operation, a, b)),
                    _ => {
                        let is_missing = |id: &Class| edges[usize::from(*id)].is_none();
                        pending.extend(ends.into_iter().filter(is_missing));
                        continue;
                    }
                },
                _ => Some(builder.zero()),
            };
            // The edge is the class up to sign; make it the canonical one.
            if let Some(edge) = edge {
                edges[place] = Some(edge.negated_if(builder.print(edge) != *self.print(class)));
            }
            pending.pop();
        }
        let zero = builder.zero();
        let edge = |&(class, negative): &(Class, bool)| {
            let edge = edges[usize::from(class)].unwrap_or(zero);
            edge.negated_if(negative)
        };
        let output = |output: &Signed| output.as_ref().map_or(zero, edge);
        builder.finish(self.outputs.iter().map(output).collect())
    }

    /// Adds (b ∘ c) ∘ a to the ways of the class, with those signs that give it; b ∘ c may be new.
    pub(super) fn nest(&mut self, class: Class, [outer, inner]: [Kind; 2], [a, b, c]: [Class; 3]) {
        for &op in inner {
            let inner = way(op, [b, c]);
            let value = self.way_print(inner).canonical().0;
            for &op in outer {
                let whole = op.apply(&value, self.print(a)).canonical().0;
                if whole == *self.print(class)
                    && let Some((middle, _)) = self.add(inner)
                {
                    self.offer(way(op, [middle, a]), Some(class));
                }
            }
        }
    }
}
