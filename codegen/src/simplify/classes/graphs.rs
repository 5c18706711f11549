//! From graphs to e-nodes, and back.

use dalembert_model::number::Exact;

use super::{Choice, ClassId, Classes, Leaf, Operator, Signed, Way};
use crate::graph::{Builder, Edge, Fingerprint, Folding, Graph, Node, NodeId, Points, Value};

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
