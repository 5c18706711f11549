//! A graph with the operations of limbs of one structure in rows: one operation in every lane.

use dalembert_model::number::Exact;
use rustc_hash::FxHashMap;

use super::structure::Limbs;
use crate::dag::{Dag, Id, Node};
use crate::program::{Input, Operation};

/// An operand, or a node as what it is for all lanes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(super) enum LaneOperand {
    Shared(Id),
    Row(usize),
}

/// The operation of a row, but for the signs of its members.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Content {
    /// As lane 0 reads it.
    Input(Input),
    Apply(Operation, [LaneOperand; 2]),
}

#[derive(Clone, Debug)]
pub(super) struct Row {
    pub class: usize,
    pub content: Content,
}

/// A node of a lane is the value of its row, or the negative.
#[derive(Clone, Copy, Debug)]
pub(super) struct Member {
    pub row: usize,
    pub lane: usize,
    pub negative: bool,
}

/// The node of each lane, if it is found, with whether it is the negative of the row's value.
type Fellows = Vec<Option<(Id, bool)>>;

#[derive(Debug)]
pub(super) struct LimbRows<'d> {
    pub dag: &'d Dag,
    pub rows: Vec<Row>,
    members: Vec<Option<Member>>,
}

impl<'d> LimbRows<'d> {
    /// Nodes that have no fellow in some lane are shared.
    pub(super) fn new(dag: &'d Dag, limbs: &Limbs, base: usize) -> LimbRows<'d> {
        let (rows, members) = (Vec::new(), vec![None; dag.nodes.len()]);
        let mut rolled = LimbRows { dag, rows, members };
        // Fellows are equally deep: their operands are fellows, or the same.
        for level in levels(dag) {
            rolled.level(&level, limbs, base);
        }
        rolled
    }

    fn level(&mut self, nodes: &[Id], limbs: &Limbs, base: usize) {
        let mut places: FxHashMap<(usize, Content), usize> = FxHashMap::default();
        let mut rows: Vec<(Row, Fellows)> = Vec::new();
        for &id in nodes {
            let slot = match self.dag.node(id) {
                Node::Constant(_) => None,
                Node::Input(input) => limbs
                    .lane_of(*input, base)
                    .map(|(place, input)| (place.class, place.lane, Content::Input(input), false)),
                Node::Apply(operation, operands) => self.content(*operation, *operands),
            };
            let Some((class, lane, content, negative)) = slot else {
                continue;
            };
            let place = *places.entry((class, content)).or_insert_with(|| {
                let lanes = limbs.classes[class].len();
                rows.push((Row { class, content }, vec![None; lanes]));
                rows.len() - 1
            });
            // A second node of the same value is shared.
            rows[place].1[lane].get_or_insert((id, negative));
        }
        for (row, members) in rows {
            let Some(members) = members.into_iter().collect::<Option<Vec<_>>>() else {
                continue;
            };
            for (lane, (id, negative)) in members.into_iter().enumerate() {
                let row = self.rows.len();
                self.members[id as usize] = Some(Member {
                    row,
                    lane,
                    negative,
                });
            }
            self.rows.push(row);
        }
    }

    /// Returns class, lane, content and sign of an operation whose operands are of one lane.
    fn content(
        &self,
        operation: Operation,
        operands: [Id; 2],
    ) -> Option<(usize, usize, Content, bool)> {
        let members = operands.map(|id| self.members[id as usize]);
        let place = |member: &Member| (self.rows[member.row].class, member.lane);
        let mut places = members.iter().flatten().map(place);
        let first = places.next()?;
        if places.any(|other| other != first) {
            return None;
        }
        let [mut a, mut b] = [0, 1].map(|side| match members[side] {
            Some(member) => (LaneOperand::Row(member.row), member.negative),
            None => (LaneOperand::Shared(operands[side]), false),
        });
        let (operation, negative) = match operation {
            Operation::Mul | Operation::Fused | Operation::Div => (operation, a.1 != b.1),
            Operation::Add | Operation::Sub => {
                b.1 ^= operation == Operation::Sub;
                if b.0 < a.0 {
                    (a, b) = (b, a);
                }
                match a.1 == b.1 {
                    true => (Operation::Add, a.1),
                    false => (Operation::Sub, a.1),
                }
            }
        };
        if operation.commutes() && b.0 < a.0 {
            (a, b) = (b, a);
        }
        let content = Content::Apply(operation, [a.0, b.0]);
        Some((first.0, first.1, content, negative))
    }

    pub(super) fn member(&self, id: Id) -> Option<Member> {
        self.members[id as usize]
    }

    /// Returns the numbers of each row, one a lane, where they follow from constants alone.
    pub(super) fn constants(&self, limbs: &Limbs) -> Vec<Option<Vec<Exact>>> {
        let mut constants: Vec<Option<Vec<Exact>>> = Vec::with_capacity(self.rows.len());
        for row in &self.rows {
            let value = |value: &LaneOperand, lane: usize| match *value {
                LaneOperand::Row(row) => Some(constants.get(row)?.as_ref()?[lane].clone()),
                LaneOperand::Shared(id) => match self.dag.node(id) {
                    Node::Constant(constant) => Some(constant.clone()),
                    _ => None,
                },
            };
            let number = |lane: usize| match &row.content {
                Content::Input(input) => {
                    Some(limbs.tuples[limbs.tuple_of(*input)?].1[lane].clone())
                }
                Content::Apply(operation, [a, b]) => {
                    operation.exactly(&value(a, lane)?, &value(b, lane)?)
                }
            };
            let lanes = limbs.classes[row.class].len();
            constants.push((0..lanes).map(number).collect());
        }
        constants
    }
}

/// Lists the nodes that are read by the operations between them and the leaves, at most.
fn levels(dag: &Dag) -> Vec<Vec<Id>> {
    let mut depths: Vec<usize> = Vec::with_capacity(dag.nodes.len());
    let mut levels: Vec<Vec<Id>> = Vec::new();
    for ((id, node), reads) in (0..).zip(&dag.nodes).zip(dag.reads()) {
        let operands = node.operands();
        let depth = operands.map_or(0, |[a, b]| 1 + depths[a as usize].max(depths[b as usize]));
        depths.push(depth);
        if levels.len() <= depth {
            levels.resize_with(depth + 1, Vec::new);
        }
        if reads > 0 {
            levels[depth].push(id);
        }
    }
    levels
}
