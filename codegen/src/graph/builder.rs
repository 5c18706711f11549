//! Smart constructors: folding and sharing as a graph grows.

use dalembert_model::number::{Exact, Rational};
use dalembert_model::scalar::Scalar;
use rustc_hash::FxHashMap;

use super::{Edge, Fingerprint, Graph, Node, NodeId, Points};
use crate::program::{Counts, Input};

/// Products of constants with more monomials stay two operations: long
/// polynomials in odd angles would grow without end.
const MAX_FOLDED: usize = 1_000;

/// How much a builder recognises.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Folding {
    /// Zeros, ones, constants, signs and syntactically equal nodes.
    Syntactic,
    /// Also nodes with equal, opposite or constant fingerprints.
    Semantic,
}

/// The value of an expression: a constant needs no graph.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Value {
    /// An exact constant.
    Constant(Exact),
    /// A node with a sign.
    Edge(Edge),
}

impl Value {
    /// Returns the constant zero.
    pub fn zero() -> Self {
        Value::Constant(Exact::zero())
    }
    fn as_constant(&self) -> Option<&Exact> {
        match self {
            Value::Constant(c) => Some(c),
            Value::Edge(_) => None,
        }
    }
}

/// A graph under construction.
pub struct Builder {
    graph: Graph,
    prints: Vec<Fingerprint>,
    folding: Folding,
    points: Points,
    by_node: FxHashMap<Node, NodeId>,
    by_constant: FxHashMap<Exact, NodeId>,
    /// Canonical print → the edge that has it (semantic folding only).
    by_print: FxHashMap<Fingerprint, Edge>,
    at_rest: FxHashMap<NodeId, Option<Exact>>,
    /// Operations asked for, before any folding but that of constants.
    asked: Counts,
}

impl Builder {
    /// Returns an empty graph.
    pub fn new(folding: Folding) -> Self {
        Builder {
            graph: Graph::default(),
            prints: Vec::new(),
            folding,
            points: Points::SEARCH,
            by_node: FxHashMap::default(),
            by_constant: FxHashMap::default(),
            by_print: FxHashMap::default(),
            at_rest: FxHashMap::default(),
            asked: Counts::default(),
        }
    }

    /// Operations asked for so far: the formula as executed, before folding.
    pub fn asked(&self) -> Counts {
        self.asked
    }

    /// Returns the finished graph with these outputs.
    pub fn finish(mut self, outputs: &[Value]) -> Graph {
        let outputs = outputs.iter().map(|value| self.edge(value)).collect();
        self.graph.outputs = outputs;
        self.graph
    }

    /// Returns the print of a value.
    pub fn print(&mut self, value: &Value) -> Fingerprint {
        let edge = self.edge(value);
        self.edge_print(edge)
    }

    /// Returns the value with this print, if the builder has met one.
    pub fn find(&self, print: &Fingerprint) -> Option<Value> {
        let (canonical, negative) = print.canonical();
        let edge = self.by_print.get(&canonical)?;
        Some(Value::Edge(edge.negated_if(negative)))
    }

    fn edge_print(&self, edge: Edge) -> Fingerprint {
        self.prints[edge.node().index()].negate_if(edge.is_negative())
    }

    /// Returns an input.
    pub fn input(&mut self, input: Input) -> Value {
        let print = self.points.input(input);
        Value::Edge(self.intern(Node::Input(input), print, false))
    }

    /// Returns a + b
    pub fn add(&mut self, a: &Value, b: &Value) -> Value {
        if a.as_constant().is_none() || b.as_constant().is_none() {
            self.asked.add += 1;
        }
        match (a.as_constant(), b.as_constant()) {
            (Some(x), Some(y)) => return Value::Constant(x.add(y)),
            (Some(x), None) if x.is_zero() => return b.clone(),
            (None, Some(y)) if y.is_zero() => return a.clone(),
            _ => {}
        }
        let (a, b) = (self.edge(a), self.edge(b));
        if a == b.negated_if(true) {
            return Value::zero();
        }
        let (first, second) = if a.node() <= b.node() { (a, b) } else { (b, a) };
        let negative = first.is_negative();
        let node = if negative == second.is_negative() {
            Node::Sum(first.node(), second.node())
        } else {
            Node::Difference(first.node(), second.node())
        };
        self.operation(node, negative)
    }

    /// Returns a − b
    pub fn sub(&mut self, a: &Value, b: &Value) -> Value {
        let b = self.negate_if(b, true);
        self.add(a, &b)
    }

    /// Returns a · b
    pub fn mul(&mut self, a: &Value, b: &Value) -> Value {
        let (constant, other) = match (a, b) {
            (Value::Constant(x), Value::Constant(y)) => return Value::Constant(x.mul(y)),
            (Value::Constant(x), Value::Edge(e)) | (Value::Edge(e), Value::Constant(x)) => (x, *e),
            (Value::Edge(a), Value::Edge(b)) => {
                self.asked.mul += 1;
                return self.product(*a, *b);
            }
        };
        self.asked.mul += 1;
        self.scale(constant, other)
    }

    /// Returns a / b, where b vanishes in no state in which the program has values: a
    /// divisor of a formula's own.
    pub fn div(&mut self, a: &Value, b: &Value) -> Value {
        if let Value::Constant(divisor) = b {
            let divisor = divisor.as_rational();
            if let Some(inverse) = divisor.and_then(|x| Exact::one().divide(x)) {
                return self.mul(a, &Value::Constant(inverse));
            }
        }
        if a.as_constant().is_some_and(Exact::is_zero) {
            return Value::zero();
        }
        self.asked.div += 1;
        let (a, b) = (self.edge(a), self.edge(b));
        let negative = a.is_negative() != b.is_negative();
        if a.node() == b.node() {
            let one = Value::Constant(Exact::one());
            return self.negate_if(&one, negative);
        }
        self.operation(Node::Quotient(a.node(), b.node()), negative)
    }

    /// Returns constant · edge
    fn scale(&mut self, constant: &Exact, edge: Edge) -> Value {
        if constant.is_zero() {
            return Value::zero();
        }
        if constant.leads_negative() {
            return self.scale(&constant.neg(), edge.negated_if(true));
        }
        if constant.is_one() {
            return Value::Edge(edge);
        }
        // c·(d·x) = (c·d)·x: one operation, and the inner one may die.
        if let Node::Product(a, b) = self.graph.node(edge.node()) {
            for (factor, rest) in [(a, b), (b, a)] {
                if let Node::Constant(inner) = self.graph.node(factor) {
                    let inner = &self.graph.constants[inner as usize];
                    if constant.terms() * inner.terms() > MAX_FOLDED {
                        break;
                    }
                    let folded = constant.mul(inner);
                    return self.scale(&folded, rest.signed(edge.is_negative()));
                }
            }
        }
        // 2·x is an addition, which is no dearer and never inexact.
        if constant.as_rational() == Some(&Rational::from_integer(2.into())) {
            let node = Node::Sum(edge.node(), edge.node());
            return self.operation(node, edge.is_negative());
        }
        let constant = self.edge(&Value::Constant(constant.clone()));
        self.product(constant, edge)
    }

    fn product(&mut self, a: Edge, b: Edge) -> Value {
        let negative = a.is_negative() != b.is_negative();
        let (a, b) = (a.node().min(b.node()), a.node().max(b.node()));
        self.operation(Node::Product(a, b), negative)
    }

    /// Returns the value, negated if `negative`: free.
    pub fn negate_if(&mut self, value: &Value, negative: bool) -> Value {
        match value {
            Value::Constant(c) if negative => Value::Constant(c.neg()),
            Value::Edge(edge) => Value::Edge(edge.negated_if(negative)),
            constant => constant.clone(),
        }
    }

    fn operation(&mut self, node: Node, negative: bool) -> Value {
        if let Some(id) = self.by_node.get(&node) {
            return Value::Edge(id.signed(negative));
        }
        let Some([a, b]) = node.operands() else {
            return Value::zero(); // leaves are interned by `input` and `edge`
        };
        let (x, y) = (&self.prints[a.index()], &self.prints[b.index()]);
        let print = match node {
            Node::Sum(..) => x.add(y),
            Node::Difference(..) => x.sub(y),
            Node::Quotient(..) => x.div(y),
            _ => x.mul(y),
        };
        if self.folding == Folding::Semantic {
            if print == Fingerprint::zero() {
                return Value::zero();
            }
            if let Some(known) = self.find(&print) {
                return self.constant_or(self.negate_if_edge(known, negative));
            }
            if print.is_constant()
                && let Some(value) = self.constant_value(node, &print)
            {
                return Value::Constant(if negative { value.neg() } else { value });
            }
        }
        Value::Edge(self.intern(node, print, negative))
    }

    fn negate_if_edge(&self, value: Value, negative: bool) -> Value {
        match value {
            Value::Edge(edge) => Value::Edge(edge.negated_if(negative)),
            constant => constant,
        }
    }

    /// An edge to a constant becomes that constant.
    fn constant_or(&self, value: Value) -> Value {
        if let Value::Edge(edge) = value
            && let Node::Constant(c) = self.graph.node(edge.node())
        {
            let constant = &self.graph.constants[c as usize];
            return Value::Constant(if edge.is_negative() {
                constant.neg()
            } else {
                constant.clone()
            });
        }
        value
    }

    /// Returns the exact value of a node that does not depend on the state: its value
    /// at rest, where every angle, position and rate is zero.
    fn constant_value(&mut self, node: Node, print: &Fingerprint) -> Option<Exact> {
        let [a, b] = node.operands()?;
        let (x, y) = (self.rest(a), self.rest(b));
        let value = at_rest(node, &x?, &y?)?;
        // Confirmed: a chance hit of the print would differ here.
        (self.points.constant(&value).as_ref() == Some(print)).then_some(value)
    }

    /// Returns a node's value at rest; none where a divisor is no rational number
    /// there, or zero.
    fn rest(&mut self, id: NodeId) -> Option<Exact> {
        // Operands come first, so a pass in order needs no recursion.
        let mut pending = vec![id];
        while let Some(&top) = pending.last() {
            if self.at_rest.contains_key(&top) {
                pending.pop();
                continue;
            }
            let value = match self.graph.node(top) {
                Node::Constant(c) => Some(self.graph.constants[c as usize].clone()),
                Node::Input(Input::Cos(_)) => Some(Exact::one()),
                Node::Input(_) => Some(Exact::zero()),
                node @ (Node::Sum(a, b)
                | Node::Difference(a, b)
                | Node::Product(a, b)
                | Node::Quotient(a, b)) => {
                    let (Some(x), Some(y)) = (self.at_rest.get(&a), self.at_rest.get(&b)) else {
                        pending.extend([a, b]);
                        continue;
                    };
                    match (x, y) {
                        (Some(x), Some(y)) => at_rest(node, x, y),
                        _ => None,
                    }
                }
            };
            self.at_rest.insert(top, value);
            pending.pop();
        }
        self.at_rest[&id].clone()
    }

    /// Returns the edge of a value; constants are interned.
    pub fn edge(&mut self, value: &Value) -> Edge {
        let constant = match value {
            Value::Edge(edge) => return *edge,
            Value::Constant(constant) => constant,
        };
        let negative = constant.leads_negative();
        let magnitude = if negative {
            constant.neg()
        } else {
            constant.clone()
        };
        if let Some(id) = self.by_constant.get(&magnitude) {
            return id.signed(negative);
        }
        // A denominator divisible by the prime has no print; readers admit
        // decimals only, so this is for robots built by hand: such a constant
        // is told apart by its own index, and the proof will refuse it.
        let print = self
            .points
            .constant(&magnitude)
            .unwrap_or_else(Fingerprint::zero);
        let index = self.graph.constants.len() as u32;
        self.graph.constants.push(magnitude.clone());
        let id = NodeId::new(self.graph.nodes.len());
        self.graph.nodes.push(Node::Constant(index));
        self.prints.push(print);
        self.by_constant.insert(magnitude, id);
        let (canonical, flipped) = print.canonical();
        self.by_print.entry(canonical).or_insert(id.signed(flipped));
        id.signed(negative)
    }

    fn intern(&mut self, node: Node, print: Fingerprint, negative: bool) -> Edge {
        if let Some(id) = self.by_node.get(&node) {
            return id.signed(negative);
        }
        let id = NodeId::new(self.graph.nodes.len());
        self.graph.nodes.push(node);
        self.prints.push(print);
        self.by_node.insert(node, id);
        let (canonical, flipped) = print.canonical();
        self.by_print.entry(canonical).or_insert(id.signed(flipped));
        id.signed(negative)
    }
}

/// Returns the exact value of an operation; none of a quotient by what is no rational
/// number, or zero.
fn at_rest(node: Node, x: &Exact, y: &Exact) -> Option<Exact> {
    Some(match node {
        Node::Sum(..) => x.add(y),
        Node::Difference(..) => x.sub(y),
        Node::Quotient(..) => return x.divide(y.as_rational()?),
        _ => x.mul(y),
    })
}
