//! One program of the parts: each lane after the other computes what lane 0 does.

use dalembert_model::number::Exact;
use dalembert_model::scalar::Scalar;
use rustc_hash::FxHashMap;

use super::parts::{Import, Part, Parts};
use super::rolled::{LaneOperand, LimbRows};
use super::structure::Limbs;
use crate::dag::{Dag, Edge, Id, Node, Writer};
use crate::program::{Input, Loop, Operation};

pub(super) struct Composer<'a, 'd> {
    rolled: &'a LimbRows<'d>,
    limbs: &'a Limbs,
    parts: &'a Parts,
    base: usize,
    writer: Writer<Exact, Input>,
    operations: usize,
    shared: FxHashMap<Id, Edge>,
    rows: FxHashMap<usize, Vec<Edge>>,
    loops: Vec<Loop>,
}

impl<'a, 'd> Composer<'a, 'd> {
    pub(super) fn new(
        rolled: &'a LimbRows<'d>,
        limbs: &'a Limbs,
        parts: &'a Parts,
        base: usize,
    ) -> Composer<'a, 'd> {
        Composer {
            rolled,
            limbs,
            parts,
            base,
            writer: Writer::default(),
            operations: 0,
            shared: FxHashMap::default(),
            rows: FxHashMap::default(),
            loops: Vec::new(),
        }
    }

    pub(super) fn compose(mut self) -> (Dag, Vec<Loop>) {
        for part in &self.parts.parts {
            match part.class {
                None => self.part(part, None),
                Some(class) => self.lanes(part, class),
            }
        }
        let results = &self.rolled.dag.outputs;
        let output = |edge: &Edge| self.result(edge.node).negated_if(edge.negative);
        let outputs = results.iter().map(output).collect();
        (self.writer.finish(outputs), self.loops)
    }

    fn lanes(&mut self, part: &Part, class: usize) {
        let (first, lanes) = (self.operations, self.limbs.classes[class].len());
        for lane in 0..lanes {
            self.part(part, Some((class, lane)));
        }
        let rows = (self.operations - first) / lanes;
        if rows > 0 {
            self.loops.push(Loop { first, rows, lanes });
        }
    }

    fn result(&mut self, id: Id) -> Edge {
        match (self.rolled.dag.node(id), self.rolled.member(id)) {
            (Node::Input(input), _) => {
                let number = self.limbs.number(*input).cloned();
                let leaf = number.map_or(Node::Input(*input), Node::Constant);
                self.writer.leaf(leaf).into()
            }
            (leaf @ Node::Constant(_), _) => self.writer.leaf(leaf.clone()).into(),
            (_, Some(member)) => match &self.parts.constants[member.row] {
                Some(numbers) => {
                    let number = Node::Constant(numbers[member.lane].clone());
                    let edge: Edge = self.writer.leaf(number).into();
                    edge.negated_if(member.negative)
                }
                None => self.rows[&member.row][member.lane].negated_if(member.negative),
            },
            (Node::Apply(..), None) => self.shared[&id],
        }
    }

    fn part(&mut self, part: &Part, lane: Option<(usize, usize)>) {
        let graph = &part.graph;
        let is_constant = self.constants(graph);
        let mut edges: Vec<Edge> = Vec::with_capacity(graph.nodes.len());
        let mut numbers: Vec<Option<Exact>> = Vec::with_capacity(graph.nodes.len());
        for (id, node) in graph.nodes.iter().enumerate() {
            let (edge, number) = match node {
                Node::Constant(constant) => (None, Some(constant.clone())),
                Node::Input(input) => self.input(*input, lane),
                Node::Apply(operation, [a, b]) => {
                    let [a, b] = [*a as usize, *b as usize];
                    let both = numbers[a].as_ref().zip(numbers[b].as_ref());
                    let exact = both.and_then(|(a, b)| operation.exactly(a, b));
                    let number = exact.filter(|_| is_constant[id]);
                    let apply = || self.apply(*operation, edges[a], edges[b]);
                    (number.is_none().then(apply), number)
                }
            };
            let edge = edge.unwrap_or_else(|| {
                let number = number.clone().unwrap_or_else(Exact::zero);
                self.writer.leaf(Node::Constant(number)).into()
            });
            edges.push(edge);
            numbers.push(number);
        }
        for (value, output) in part.exports.iter().zip(&graph.outputs) {
            let edge = edges[output.index()].negated_if(output.negative);
            match *value {
                LaneOperand::Shared(id) => {
                    self.shared.insert(id, edge);
                }
                LaneOperand::Row(row) => self.rows.entry(row).or_default().push(edge),
            }
        }
    }

    /// Tells of each node if it is a number in every lane: what one lane folds all do.
    fn constants(&self, graph: &Dag) -> Vec<bool> {
        let mut constants: Vec<bool> = Vec::with_capacity(graph.nodes.len());
        for node in &graph.nodes {
            constants.push(match node {
                Node::Constant(_) => true,
                Node::Input(input) => self.limbs.tuple_of(*input).is_some(),
                Node::Apply(Operation::Div, _) => false,
                Node::Apply(_, operands) => operands.iter().all(|id| constants[*id as usize]),
            });
        }
        constants
    }

    fn input(
        &mut self,
        input: Input,
        lane: Option<(usize, usize)>,
    ) -> (Option<Edge>, Option<Exact>) {
        if let Some(import) = self.parts.import(input) {
            let edge = match import {
                Import::Shared(id) => match self.shared.get(&id) {
                    Some(edge) => *edge,
                    None => self.result(id),
                },
                Import::Row(row) => self.rows[&row][lane.map_or(0, |(_, lane)| lane)],
                Import::Lane(row, lane) => self.rows[&row][lane],
            };
            return (Some(edge), None);
        }
        let lane_input = match lane {
            Some((class, lane)) => self.limbs.in_lane(input, class, lane, self.base),
            None => input,
        };
        if let Some(number) = self.limbs.number(lane_input) {
            return (None, Some(number.clone()));
        }
        (Some(self.writer.leaf(Node::Input(lane_input)).into()), None)
    }

    /// Signs are no operations: they pass to what reads the result.
    fn apply(&mut self, operation: Operation, a: Edge, b: Edge) -> Edge {
        use Operation::{Add, Div, Fused, Mul, Sub};
        let (operation, operands, negative) = match (operation, a.negative, b.negative) {
            (Mul | Fused | Div, _, _) => (operation, [a, b], a.negative != b.negative),
            (Add, false, false) | (Sub, false, true) => (Add, [a, b], false),
            (Add, false, true) | (Sub, false, false) => (Sub, [a, b], false),
            (Add, true, false) | (Sub, true, true) => (Sub, [b, a], false),
            (Add, true, true) | (Sub, true, false) => (Add, [a, b], true),
        };
        self.operations += 1;
        let node = self.writer.apply(operation, operands.map(|edge| edge.node));
        Edge::from(node).negated_if(negative)
    }
}
