//! The parts of a rolled graph: what all lanes share and what each class of limbs computes, in turns.
//! Each is a graph that is searched by itself.

use std::collections::BTreeMap;

use dalembert_model::number::Exact;
use rustc_hash::{FxHashMap, FxHashSet};

use super::rolled::{Content, LaneOperand, LimbRows};
use super::structure::{Limbs, OPAQUE, tuple_input};
use crate::dag::{Builder, Dag, Edge, Folding, Id, Node};
use crate::function::Argument;
use crate::program::Input;

/// A value of another part.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Import {
    Shared(Id),
    /// A row, in the reader's lane.
    Row(usize),
    Lane(usize, usize),
}

#[derive(Clone, Debug)]
pub(super) struct Part {
    /// The class whose lanes compute it; none of what they share.
    pub class: Option<usize>,
    /// As lane 0 computes it. Its inputs are the function's, entries of tuples and imports.
    pub graph: Dag,
    pub exports: Vec<LaneOperand>,
}

pub(super) struct Parts {
    pub parts: Vec<Part>,
    pub imports: Vec<Import>,
    /// The numbers of each row that is constant, one a lane.
    pub constants: Vec<Option<Vec<Exact>>>,
}

impl Parts {
    pub(super) fn import(&self, input: Input) -> Option<Import> {
        let Input::Entry(Argument::Load, entry) = input else {
            return None;
        };
        self.imports.get(entry.checked_sub(OPAQUE)?).copied()
    }

    pub(super) fn of(rolled: &LimbRows<'_>, limbs: &mut Limbs, base: usize) -> Parts {
        let constants = rolled.constants(limbs);
        let phases = Phases::of(rolled, &constants);
        let mut contents: BTreeMap<(usize, Option<usize>), Vec<LaneOperand>> = BTreeMap::new();
        let is_operation = |id: Id| rolled.dag.node(id).operands().is_some();
        let reads = rolled.dag.reads();
        for id in (0..rolled.dag.nodes.len() as Id).filter(|&id| is_operation(id)) {
            if reads[id as usize] > 0 && rolled.member(id).is_none() {
                let place = (phases.shared[id as usize], None);
                let values = contents.entry(place).or_default();
                values.push(LaneOperand::Shared(id));
            }
        }
        for (index, row) in rolled.rows.iter().enumerate() {
            if matches!(row.content, Content::Apply(..)) && constants[index].is_none() {
                let place = (phases.rows[index], Some(row.class));
                let values = contents.entry(place).or_default();
                values.push(LaneOperand::Row(index));
            }
        }
        let exported = exported(rolled, &phases);
        let mut parts = Parts {
            parts: Vec::new(),
            imports: Vec::new(),
            constants,
        };
        let mut places = FxHashMap::default();
        for ((_, class), mut exports) in contents {
            let mut writer = PartWriter {
                rolled,
                limbs: &mut *limbs,
                base,
                constants: &parts.constants,
                imports: &mut parts.imports,
                places: &mut places,
                builder: Builder::new(Folding::Syntactic),
                known: FxHashMap::default(),
            };
            for &value in &exports {
                writer.write(value);
            }
            exports.retain(|value| exported.contains(value));
            let outputs = exports.iter().map(|value| writer.known[value]).collect();
            let graph = writer.builder.finish(outputs);
            parts.parts.push(Part {
                class,
                graph,
                exports,
            });
        }
        parts
    }
}

/// The values that other parts or results read.
fn exported(rolled: &LimbRows<'_>, phases: &Phases) -> FxHashSet<LaneOperand> {
    let value = |id: Id| match rolled.member(id) {
        Some(member) => LaneOperand::Row(member.row),
        None => LaneOperand::Shared(id),
    };
    // Even for what lanes share, odd for rows.
    let phase = |value: LaneOperand| match value {
        LaneOperand::Row(row) => phases.rows[row],
        LaneOperand::Shared(id) => phases.shared[id as usize],
    };
    let mut exported = FxHashSet::default();
    for edge in &rolled.dag.outputs {
        exported.insert(value(edge.node));
    }
    let reads = rolled.dag.reads();
    for (id, node) in (0..).zip(&rolled.dag.nodes) {
        let Some(operands) = node.operands().filter(|_| reads[id as usize] > 0) else {
            continue;
        };
        let others = operands.map(value).into_iter();
        exported.extend(others.filter(|other| phase(*other) != phase(value(id))));
    }
    exported
}

/// Even phases are of what lanes share, odd ones of lanes; each reads those before it.
struct Phases {
    shared: Vec<usize>,
    rows: Vec<usize>,
}

impl Phases {
    fn of(rolled: &LimbRows<'_>, constants: &[Option<Vec<Exact>>]) -> Phases {
        let shared = vec![0; rolled.dag.nodes.len()];
        let rows = vec![1; rolled.rows.len()];
        let mut phases = Phases { shared, rows };
        loop {
            let mut is_stable = true;
            for (id, node) in (0..).zip(&rolled.dag.nodes) {
                let Some(operands) = node.operands() else {
                    continue;
                };
                let member = rolled.member(id);
                if member.is_some_and(|member| constants[member.row].is_some()) {
                    continue;
                }
                let phase = |operand: Id| {
                    let is_leaf = rolled.dag.node(operand).operands().is_none();
                    match (rolled.member(operand), member) {
                        (Some(other), _) if is_leaf || constants[other.row].is_some() => 0,
                        (Some(other), Some(_)) => phases.rows[other.row],
                        (Some(other), None) => phases.rows[other.row] + 1,
                        (None, None) => phases.shared[operand as usize],
                        (None, Some(_)) if is_leaf => 0,
                        (None, Some(_)) => phases.shared[operand as usize] + 1,
                    }
                };
                let [a, b] = operands.map(phase);
                let place = match member {
                    Some(member) => &mut phases.rows[member.row],
                    None => &mut phases.shared[id as usize],
                };
                if a.max(b) > *place {
                    *place = a.max(b);
                    is_stable = false;
                }
            }
            if is_stable {
                return phases;
            }
        }
    }
}

struct PartWriter<'a, 'd> {
    rolled: &'a LimbRows<'d>,
    limbs: &'a mut Limbs,
    base: usize,
    constants: &'a [Option<Vec<Exact>>],
    imports: &'a mut Vec<Import>,
    places: &'a mut FxHashMap<Import, usize>,
    builder: Builder,
    known: FxHashMap<LaneOperand, Edge>,
}

impl PartWriter<'_, '_> {
    fn write(&mut self, value: LaneOperand) {
        let (operation, operands) = match value {
            LaneOperand::Row(row) => match self.rolled.rows[row].content {
                Content::Apply(operation, operands) => (
                    operation,
                    operands.map(|operand| self.of_lane(operand, row)),
                ),
                Content::Input(_) => return,
            },
            LaneOperand::Shared(id) => match *self.rolled.dag.node(id) {
                Node::Apply(operation, operands) => {
                    (operation, operands.map(|operand| self.shared(operand)))
                }
                _ => return,
            },
        };
        let [a, b] = operands;
        let edge = self.builder.apply(operation, a, b);
        self.known.insert(value, edge);
    }

    fn import(&mut self, import: Import) -> Edge {
        let next = self.imports.len();
        let place = *self.places.entry(import).or_insert(next);
        if place == next {
            self.imports.push(import);
        }
        let input = Input::Entry(Argument::Load, OPAQUE + place);
        self.builder.input(input)
    }

    fn of_lane(&mut self, operand: LaneOperand, reader: usize) -> Edge {
        match operand {
            LaneOperand::Row(row) => {
                if let Some(numbers) = &self.constants[row] {
                    if numbers.iter().all(|number| *number == numbers[0]) {
                        return self.builder.constant(&numbers[0]);
                    }
                    let class = self.rolled.rows[reader].class;
                    let (tuple, is_negative) = self.limbs.tuple(class, numbers.clone());
                    let entry = self.builder.input(tuple_input(tuple, 0));
                    return entry.negated_if(is_negative);
                }
                match self.rolled.rows[row].content {
                    Content::Input(input) => self.builder.input(input),
                    Content::Apply(..) => match self.known.get(&operand) {
                        Some(edge) => *edge,
                        None => self.import(Import::Row(row)),
                    },
                }
            }
            LaneOperand::Shared(id) => match self.rolled.dag.node(id) {
                Node::Constant(constant) => self.builder.constant(constant),
                // An entry of a joint of the limbs would be taken for the lane's.
                Node::Input(input) if self.limbs.lane_of(*input, self.base).is_none() => {
                    self.builder.input(*input)
                }
                _ => self.import(Import::Shared(id)),
            },
        }
    }

    fn shared(&mut self, operand: Id) -> Edge {
        match (self.rolled.dag.node(operand), self.rolled.member(operand)) {
            (Node::Constant(constant), _) => self.builder.constant(constant),
            (node, Some(member)) => {
                if let Some(numbers) = &self.constants[member.row] {
                    let number = self.builder.constant(&numbers[member.lane]);
                    return number.negated_if(member.negative);
                }
                match node {
                    Node::Input(input) => self.builder.input(*input),
                    _ => {
                        let import = self.import(Import::Lane(member.row, member.lane));
                        import.negated_if(member.negative)
                    }
                }
            }
            (Node::Input(input), None) => self.builder.input(*input),
            (Node::Apply(..), None) => match self.known.get(&LaneOperand::Shared(operand)) {
                Some(edge) => *edge,
                None => self.import(Import::Shared(operand)),
            },
        }
    }
}
