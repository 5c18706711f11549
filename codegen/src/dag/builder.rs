//! Folds and shares as a graph grows.

use dalembert_model::number::{Exact, Rational};
use dalembert_model::scalar::Scalar;
use rustc_hash::FxHashMap;

use super::{Dag, Edge, Fingerprint, Id, Node, Points, signed};
use crate::dag::{Counts, Input, Operation};
use crate::function::Argument;

/// Products of constants with more monomials stay two operations: they would grow without end.
const MAX_TERMS: usize = 1_000;

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Folding {
    /// Zeros, ones, constants, signs and syntactically equal nodes.
    #[default]
    Syntactic,
    /// Also nodes with equal, opposite or constant fingerprints.
    Semantic,
}

#[derive(Debug, Default)]
pub(crate) struct Builder {
    dag: Dag,
    prints: Vec<Fingerprint>,
    folding: Folding,
    known: FxHashMap<Node, Id>,
    by_print: FxHashMap<Fingerprint, Edge>,
    /// Values where every angle, position and rate is zero and the damping one, as far as they were
    /// asked for.
    at_rest: FxHashMap<Id, Option<Exact>>,
    asked: Counts,
}

impl Builder {
    pub(crate) fn new(folding: Folding) -> Builder {
        Builder {
            folding,
            ..Builder::default()
        }
    }

    /// The formula as executed, before any folding but that of constants.
    pub(crate) fn asked(&self) -> Counts {
        self.asked
    }

    pub(crate) fn finish(mut self, outputs: Vec<Edge>) -> Dag {
        self.dag.outputs = outputs;
        self.dag
    }

    pub(crate) fn print(&self, edge: Edge) -> Fingerprint {
        signed(&self.prints[edge.index()], edge.negative)
    }

    pub(crate) fn constant(&mut self, constant: &Exact) -> Edge {
        let negative = constant.leads_negative();
        let size = signed(constant, negative);
        self.leaf(Node::Constant(size)).negated_if(negative)
    }

    pub(crate) fn zero(&mut self) -> Edge {
        self.constant(&Exact::zero())
    }

    pub(crate) fn input(&mut self, input: Input) -> Edge {
        self.leaf(Node::Input(input))
    }

    fn leaf(&mut self, node: Node) -> Edge {
        match self.known.get(&node) {
            Some(&known) => known.into(),
            None => {
                let print = node.leaf_print();
                self.intern(node, print)
            }
        }
    }

    /// A divisor vanishes in no state in which the program has values.
    pub(crate) fn apply(&mut self, operation: Operation, a: Edge, b: Edge) -> Edge {
        match operation {
            Operation::Add => self.add(a, b),
            Operation::Sub => self.sub(a, b),
            Operation::Mul | Operation::Fused => self.mul(a, b),
            Operation::Div => self.div(a, b),
        }
    }

    pub(crate) fn exact(&self, edge: Edge) -> Option<Exact> {
        Some(signed(self.size(edge)?, edge.negative))
    }

    fn size(&self, edge: Edge) -> Option<&Exact> {
        match self.dag.node(edge.node) {
            Node::Constant(constant) => Some(constant),
            _ => None,
        }
    }

    pub(crate) fn add(&mut self, a: Edge, b: Edge) -> Edge {
        let constants = [a, b].map(|edge| self.size(edge));
        let adds = a.negative == b.negative;
        if let [Some(x), Some(y)] = constants {
            let sum = if adds { x.add(y) } else { x.sub(y) };
            return self.constant(&sum).negated_if(a.negative);
        }
        let [x_is_zero, y_is_zero] = constants.map(|x| x.is_some_and(Scalar::is_zero));
        self.asked.add += 1;
        if x_is_zero {
            return b;
        }
        if y_is_zero {
            return a;
        }
        if a == b.negated_if(true) {
            return self.zero();
        }
        let [a, b] = if a.node <= b.node { [a, b] } else { [b, a] };
        let operation = if adds { Operation::Add } else { Operation::Sub };
        self.operation(operation, a.node, b.node)
            .negated_if(a.negative)
    }

    pub(crate) fn sub(&mut self, a: Edge, b: Edge) -> Edge {
        self.add(a, b.negated_if(true))
    }

    pub(crate) fn mul(&mut self, a: Edge, b: Edge) -> Edge {
        let [x, y] = [a, b].map(|edge| self.size(edge).cloned());
        self.asked.mul += usize::from(x.is_none() || y.is_none());
        let product = match (x, y) {
            (Some(x), Some(y)) => self.constant(&x.mul(&y)),
            (Some(x), None) => self.scale(x, b.node),
            (None, Some(y)) => self.scale(y, a.node),
            (None, None) => {
                let [a, b] = [a.node.min(b.node), a.node.max(b.node)];
                self.operation(Operation::Mul, a, b)
            }
        };
        product.negated_if(a.negative != b.negative)
    }

    fn scale(&mut self, x: Exact, node: Id) -> Edge {
        if x.is_zero() {
            return self.constant(&x);
        }
        if x.leads_negative() {
            return self.scale(x.neg(), node).negated_if(true);
        }
        if x.is_one() {
            return node.into();
        }
        // c·(d·y) = (c·d)·y: one operation, and the inner one may die.
        if let Node::Apply(Operation::Mul, [a, b]) = *self.dag.node(node) {
            for (factor, rest) in [(a, b), (b, a)] {
                if let Node::Constant(inner) = self.dag.node(factor)
                    && x.terms() * inner.terms() <= MAX_TERMS
                {
                    let folded = x.mul(inner);
                    return self.scale(folded, rest);
                }
            }
        }
        // 2·y = y + y is no dearer and never inexact.
        match x.as_rational() == Some(&Rational::from_integer(2.into())) {
            true => self.operation(Operation::Add, node, node),
            false => {
                let x = self.constant(&x).node;
                self.operation(Operation::Mul, x.min(node), x.max(node))
            }
        }
    }

    pub(crate) fn div(&mut self, a: Edge, b: Edge) -> Edge {
        let divisor = self.exact(b);
        let inverse = divisor.and_then(|y| Exact::one().divide(y.as_rational()?));
        if let Some(inverse) = inverse {
            let inverse = self.constant(&inverse);
            return self.mul(a, inverse);
        }
        if self.size(a).is_some_and(Scalar::is_zero) {
            return a;
        }
        self.asked.div += 1;
        let quotient = match a.node == b.node {
            true => self.constant(&Exact::one()),
            false => self.operation(Operation::Div, a.node, b.node),
        };
        quotient.negated_if(a.negative != b.negative)
    }

    fn operation(&mut self, operation: Operation, a: Id, b: Id) -> Edge {
        let node = Node::Apply(operation, [a, b]);
        if let Some(&known) = self.known.get(&node) {
            return known.into();
        }
        let print = operation.apply(&self.prints[a as usize], &self.prints[b as usize]);
        if self.folding == Folding::Semantic {
            if print == Fingerprint::zero() {
                return self.zero();
            }
            let (canonical, negative) = print.canonical();
            if let Some(edge) = self.by_print.get(&canonical) {
                return edge.negated_if(negative);
            }
            // Confirmed: a chance hit of the print would differ.
            if print.is_constant()
                && let Some(value) = self.value_at_rest(operation, a, b)
                && Points::SEARCH.constant(&value) == Some(print)
            {
                return self.constant(&value);
            }
        }
        self.intern(node, print)
    }

    /// An operation that does not depend on the state has its value where every angle, position and
    /// rate is zero, and the damping, which divides, is one. `None` if a divisor is zero there, or
    /// not a rational number.
    fn value_at_rest(&mut self, operation: Operation, a: Id, b: Id) -> Option<Exact> {
        // Only for what is asked for: at rest, long constants of odd angles multiply.
        let mut pending = vec![a, b];
        while let Some(&id) = pending.last() {
            let value = match self.dag.node(id) {
                _ if self.at_rest.contains_key(&id) => None,
                Node::Constant(constant) => Some(Some(constant.clone())),
                Node::Input(Input::Cos(_) | Input::Entry(Argument::Damping, _)) => {
                    Some(Some(Exact::one()))
                }
                Node::Input(_) => Some(Some(Exact::zero())),
                Node::Apply(op, operands) => {
                    let missing = operands.iter().filter(|id| !self.at_rest.contains_key(id));
                    let before = pending.len();
                    pending.extend(missing);
                    if pending.len() > before {
                        continue;
                    }
                    Some(self.at_rest(*op, *operands))
                }
            };
            pending.pop();
            if let Some(value) = value {
                self.at_rest.insert(id, value);
            }
        }
        self.at_rest(operation, [a, b])
    }

    fn at_rest(&self, operation: Operation, operands: [Id; 2]) -> Option<Exact> {
        let [x, y] = operands.map(|id| self.at_rest.get(&id)?.as_ref());
        operation.exactly(x?, y?)
    }

    fn intern(&mut self, node: Node, print: Fingerprint) -> Edge {
        let edge = Edge::from(self.dag.nodes.len() as Id);
        self.known.insert(node.clone(), edge.node);
        self.dag.nodes.push(node);
        self.prints.push(print);
        let (canonical, negative) = print.canonical();
        let canonical = self.by_print.entry(canonical);
        canonical.or_insert(edge.negated_if(negative));
        edge
    }

    pub(crate) fn results(&mut self, dag: &Dag) -> Vec<Edge> {
        let mut edges: Vec<Edge> = Vec::with_capacity(dag.nodes.len());
        for (node, reads) in dag.nodes.iter().zip(dag.reads()) {
            let edge = match node {
                _ if reads == 0 => self.zero(),
                Node::Constant(constant) => self.constant(constant),
                Node::Input(input) => self.input(*input),
                Node::Apply(operation, [a, b]) => {
                    self.apply(*operation, edges[*a as usize], edges[*b as usize])
                }
            };
            edges.push(edge);
        }
        let result = |edge: &Edge| edges[edge.index()].negated_if(edge.negative);
        dag.outputs.iter().map(result).collect()
    }
}
