//! Sums over limbs, of which each limb adds up its terms first: as a lane.

use std::collections::BTreeMap;

use super::rolled::LimbRows;
use crate::dag::{Builder, Dag, Edge, Folding, Id, Node};
use crate::program::Operation;

/// Returns a graph of the same results: a limb's terms in a shared sum are a sum by themselves.
pub(super) fn by_limbs(rolled: &LimbRows<'_>) -> Dag {
    let dag = rolled.dag;
    let reads = dag.reads();
    let is_sum = |id: Id| {
        let node = dag.node(id);
        let is_addition = matches!(node, Node::Apply(Operation::Add | Operation::Sub, _));
        is_addition && rolled.member(id).is_none()
    };
    // A sum that one other sum alone reads is part of it.
    let mut is_part = vec![false; dag.nodes.len()];
    for id in (0..dag.nodes.len() as Id).filter(|&id| is_sum(id) && reads[id as usize] > 0) {
        for operand in dag.node(id).operands().into_iter().flatten() {
            is_part[operand as usize] |= is_sum(operand) && reads[operand as usize] == 1;
        }
    }
    let mut builder = Builder::new(Folding::Syntactic);
    let mut edges: Vec<Edge> = Vec::with_capacity(dag.nodes.len());
    for (id, node) in (0..).zip(&dag.nodes) {
        let edge = match node {
            _ if reads[id as usize] == 0 || is_part[id as usize] => builder.zero(),
            Node::Constant(constant) => builder.constant(constant),
            Node::Input(input) => builder.input(*input),
            Node::Apply(..) if is_sum(id) => {
                sum(&mut builder, rolled, &edges, &terms(dag, &is_part, id))
            }
            Node::Apply(operation, [a, b]) => {
                builder.apply(*operation, edges[*a as usize], edges[*b as usize])
            }
        };
        edges.push(edge);
    }
    let output = |edge: &Edge| edges[edge.index()].negated_if(edge.negative);
    builder.finish(dag.outputs.iter().map(output).collect())
}

/// Lists the terms of a sum in their order, each with whether it is subtracted.
fn terms(dag: &Dag, is_part: &[bool], root: Id) -> Vec<(Id, bool)> {
    let mut terms = Vec::new();
    let mut pending = vec![(root, false)];
    while let Some((id, negative)) = pending.pop() {
        match dag.node(id) {
            Node::Apply(operation, [a, b]) if id == root || is_part[id as usize] => {
                pending.push((*b, negative != (*operation == Operation::Sub)));
                pending.push((*a, negative));
            }
            _ => terms.push((id, negative)),
        }
    }
    terms
}

fn sum(builder: &mut Builder, rolled: &LimbRows<'_>, edges: &[Edge], terms: &[(Id, bool)]) -> Edge {
    let mut limbs: BTreeMap<(usize, usize), Vec<(usize, Edge)>> = BTreeMap::new();
    let mut summands = Vec::new();
    for (id, negative) in terms {
        let edge = edges[*id as usize].negated_if(*negative);
        match rolled.member(*id) {
            Some(member) => {
                let class = rolled.rows[member.row].class;
                let place = limbs.entry((class, member.lane)).or_default();
                place.push((member.row, edge));
            }
            None => summands.push(edge),
        }
    }
    for mut terms in limbs.into_values() {
        terms.sort_by_key(|(row, _)| *row);
        let edges = terms.into_iter().map(|(_, edge)| edge);
        summands.extend(edges.reduce(|sum, edge| builder.add(sum, edge)));
    }
    let total = (summands.into_iter()).reduce(|sum, edge| builder.add(sum, edge));
    total.unwrap_or_else(|| builder.zero())
}
