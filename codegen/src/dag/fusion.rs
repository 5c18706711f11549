//! Products that are fused with a sum: `a.mul_add(b, c)`, one operation that rounds once.
//!
//! A fused product is a node of its own ([`Operation::Fused`]) whose value is not rounded. One sum
//! or difference reads it, and nothing else, and both are one line of the text. So whatever is
//! exact, a proof or a derivative, takes it for the product that it is; whatever rounds leaves its
//! rounding out; and only machines, which cannot hold the exact product, compute the two nodes as
//! one.

use dalembert_model::number::Rounded;
use dalembert_model::scalar::Scalar;

use super::{Dag, Edge, Id, Node, Operation, signed};

/// A sum or a difference with the fused product that it takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fusion {
    pub factors: [Id; 2],
    pub negative: bool,
    pub addend: Id,
    pub minus: bool,
}

impl Fusion {
    /// Computes the sum in a scalar, from the values of the factors and the addend.
    #[inline]
    pub fn apply<S: Scalar>(&self, [left, right]: [&S; 2], addend: &S) -> S {
        signed(left, self.negative).mul_add(right, &signed(addend, self.minus))
    }
}

impl<C, I> Dag<C, I> {
    /// Returns the fused product that a node takes, if it is a sum or a difference with one.
    #[inline]
    pub fn fusion(&self, id: Id) -> Option<Fusion> {
        let (is_sum, [left, right]) = match *self.node(id) {
            Node::Apply(Operation::Add, operands) => (true, operands),
            Node::Apply(Operation::Sub, operands) => (false, operands),
            _ => return None,
        };
        let factors = |id: Id| match *self.node(id) {
            Node::Apply(Operation::Fused, factors) => Some(factors),
            _ => None,
        };
        let (factors, addend, is_left) = match (factors(left), factors(right)) {
            (Some(factors), _) => (factors, right, true),
            (None, Some(factors)) => (factors, left, false),
            (None, None) => return None,
        };
        Some(Fusion {
            factors,
            negative: !is_sum && !is_left,
            addend,
            minus: !is_sum && is_left,
        })
    }

    /// Returns the length of the longest chain of operations; a fused multiply-add counts as one.
    pub fn depth(&self) -> usize {
        let mut depths = vec![0; self.nodes.len()];
        for (id, operation, operands) in self.operations() {
            let [a, b] = operands.map(|id| depths[id as usize]);
            depths[id as usize] = a.max(b) + usize::from(operation != Operation::Fused);
        }
        depths.into_iter().max().unwrap_or(0)
    }
}

impl Dag {
    /// Returns the code with its products fused: each that a single sum or difference reads, and
    /// nothing else, one a sum. A sum of two takes the one with the longer chain of operations
    /// behind its factors, since its own operation is the one that the chain no longer has, and of equal
    /// ones the left. The choice at one sum leaves those at others as they are: so there are as few
    /// operations and as short chains as there can be. A sum with a negative literal takes none,
    /// whose sign a text could not tell from a difference's, nor is a product of two literals
    /// taken. A product stands right before its sum. Fused code stays as it is.
    ///
    /// `keep` drops products from the list of those that each sum takes.
    #[must_use]
    pub(crate) fn fused_where(&self, keep: impl FnOnce(&mut [Option<Id>])) -> Dag {
        let mut taken = self.taken();
        keep(&mut taken);
        let mut nodes: Vec<Node> = Vec::with_capacity(self.nodes.len());
        let mut places: Vec<Id> = vec![0; self.nodes.len()];
        for (node, id) in self.nodes.iter().zip(0..) {
            if taken.contains(&Some(id)) {
                continue;
            }
            let node = match *node {
                Node::Apply(operation, mut operands) => {
                    if let Some(product) = taken[id as usize]
                        && let Node::Apply(_, [x, y]) = *self.node(product)
                    {
                        // `mul_add` is a method of the left factor: a literal stands on the right.
                        let factors = if self.is_constant(x) { [y, x] } else { [x, y] };
                        let factors = factors.map(|id| places[id as usize]);
                        places[product as usize] = nodes.len() as Id;
                        nodes.push(Node::Apply(Operation::Fused, factors));
                        if operation == Operation::Add && operands[1] == product {
                            operands.reverse();
                        }
                    }
                    Node::Apply(operation, operands.map(|id| places[id as usize]))
                }
                ref leaf => leaf.clone(),
            };
            places[id as usize] = nodes.len() as Id;
            nodes.push(node);
        }
        let moved = |edge: &Edge| edge.at(places[edge.index()]);
        let outputs = self.outputs.iter().map(moved).collect();
        Dag { nodes, outputs }
    }

    fn is_constant(&self, id: Id) -> bool {
        matches!(self.node(id), Node::Constant(_))
    }

    fn taken(&self) -> Vec<Option<Id>> {
        let reads = self.reads();
        let mut taken = vec![None; self.nodes.len()];
        let mut chain = vec![0usize; self.nodes.len()];
        for (id, operation, [a, b]) in self.operations() {
            let longest = |ends: &[Id]| {
                let chains = ends.iter().map(|id| chain[*id as usize]);
                chains.max().unwrap_or(0)
            };
            // The operations behind its factors, those behind the sum that takes it, the product.
            let candidate = |product: Id, addend: Id| match *self.node(product) {
                Node::Apply(Operation::Mul | Operation::Fused, [x, y])
                    if reads[product as usize] == 1
                        && !self.is_negative(addend)
                        && !(self.is_constant(x) && self.is_constant(y)) =>
                {
                    Some((longest(&[x, y]), longest(&[x, y, addend]), product))
                }
                _ => None,
            };
            let fusion = match operation {
                Operation::Add | Operation::Sub => match (candidate(a, b), candidate(b, a)) {
                    (Some(left), Some(right)) if right.0 > left.0 => Some(right),
                    (left, right) => left.or(right),
                },
                Operation::Mul | Operation::Fused | Operation::Div => None,
            };
            let before = fusion.map_or_else(|| longest(&[a, b]), |(_, before, _)| before);
            taken[id as usize] = fusion.map(|(.., product)| product);
            chain[id as usize] = 1 + before;
        }
        taken
    }

    fn is_negative(&self, id: Id) -> bool {
        matches!(self.node(id), Node::Constant(value) if f64::nearest(value) < 0.0)
    }
}
