//! The order in which code is printed: one that keeps few values alive.

use super::{Dag, Edge, Id, Node};

impl<C: Clone, I: Clone> Dag<C, I> {
    /// Orders the live nodes as code is printed: depth first from the outputs, the operand with
    /// more operations first, so that its temporaries are dead before the other's live. A constant
    /// stands on the right of a sum or product.
    #[must_use]
    pub fn scheduled(&self) -> Dag<C, I> {
        let mut weight = vec![0u64; self.nodes.len()];
        for (index, node) in self.nodes.iter().enumerate() {
            if let Node::Apply(_, [a, b]) = node {
                let both = weight[*a as usize].saturating_add(weight[*b as usize]);
                weight[index] = both.saturating_add(1);
            }
        }
        let mut nodes: Vec<Node<C, I>> = Vec::new();
        let mut place: Vec<Option<Id>> = vec![None; self.nodes.len()];
        let mut stack: Vec<Id> = self.outputs.iter().rev().map(|edge| edge.node).collect();
        while let Some(&id) = stack.last() {
            let node = match self.node(id) {
                _ if place[id as usize].is_some() => None,
                Node::Apply(operation, operands) => {
                    let [a, b] = *operands;
                    let [Some(x), Some(y)] = operands.map(|id| place[id as usize]) else {
                        let first_is_long = weight[a as usize] >= weight[b as usize];
                        stack.extend(if first_is_long { [b, a] } else { [a, b] });
                        continue;
                    };
                    let is_constant = matches!(self.node(a), Node::Constant(_));
                    let swaps = operation.commutes() && is_constant;
                    Some(Node::Apply(*operation, if swaps { [y, x] } else { [x, y] }))
                }
                leaf => Some(leaf.clone()),
            };
            if let Some(node) = node {
                place[id as usize] = Some(nodes.len() as Id);
                nodes.push(node);
            }
            stack.pop();
        }
        // Every output was on the stack.
        let moved = |edge: &Edge| edge.at(place[edge.index()].unwrap_or_default());
        let outputs = self.outputs.iter().map(moved).collect();
        Dag { nodes, outputs }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dag::pattern::graph;
    use crate::dag::{Input, Operation};
    use crate::function::Argument;
    use Operation::{Add, Mul};

    fn operations(dag: &Dag) -> Vec<Operation> {
        dag.operations().map(|operation| operation.1).collect()
    }

    #[test]
    fn the_longer_operand_comes_first() {
        for text in [
            "(+ (* ?c ?d) (* (* (* ?a ?b) ?c) ?d))",
            "(+ (* (* (* ?a ?b) ?c) ?d) (* ?c ?d))",
        ] {
            let dag = graph(&[text]).scheduled();
            assert_eq!(operations(&dag), [Mul, Mul, Mul, Mul, Add]);
            let short = dag.nodes.iter().filter_map(Node::operands).nth(3);
            let is_leaf = |id: &Id| dag.node(*id).operands().is_none();
            assert!(short.is_some_and(|operands| operands.iter().all(is_leaf)));
        }
    }

    #[test]
    fn shared_once_and_dead_never() {
        let dag = graph(&["(+ (* ?a ?b) ?c)", "(- ?c (* ?a ?b))", "(* 3 ?a)"]).scheduled();
        assert_eq!(operations(&dag).len(), 4);
        for (index, node) in dag.nodes.iter().enumerate() {
            let operands = node.operands().into_iter().flatten();
            assert!(operands.into_iter().all(|id| (id as usize) < index));
        }
        let edge = dag.outputs[1];
        let [first, second] = dag.node(edge.node).operands().unwrap();
        let is_rate = |id| *dag.node(id) == Node::Input(Input::Entry(Argument::Velocity, 2));
        assert!(is_rate(if edge.negative { second } else { first }));
        let [_, right] = dag.node(dag.outputs[2].node).operands().unwrap();
        assert!(matches!(dag.node(right), Node::Constant(_)));
    }
}
