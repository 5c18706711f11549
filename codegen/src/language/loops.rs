//! The loops over lanes of a function, between the operations that lanes share.
//!
//! ```text
//! let k1 = [                          const numbers, one a lane
//!     [0.0955, -0.0955],
//! ];
//! let u1 = [                          what is read of other parts
//!     [qd[6], qd[9]],
//! ];
//! let mut w1 = [[0.0; 2]; 1];         what others read
//! for l in 0..2 {
//!     let t1 = u1[0][l] * k1[0][l];
//!     w1[0][l] = t1;                  at once: fewer values are alive
//! }
//! let t3 = w1[0][0] + w1[0][1];
//! ```
//!
//! A name is that of lane 0. Each lane has the results that the same operations have alone, in any
//! order of the lanes.

use std::collections::HashMap;

use super::dialect::{Dialect, Lines};
use super::names::float;
use super::{Language, list};
use crate::dag::fusion::Fusion;
use crate::dag::{Id, Node};
use crate::program::{Code, Input, Loop, Operation};

/// Operations in the order of the text: those between loops, or a loop.
pub(super) enum Piece {
    /// Nodes that stand for themselves.
    Shared(Vec<Id>),
    Lanes(LoopText),
}

impl Piece {
    /// Returns the first node that it computes; none if it computes none.
    pub(super) fn first(&self) -> Option<Id> {
        match self {
            Piece::Shared(ids) => ids.first().copied(),
            Piece::Lanes(lanes) => Some(lanes.first),
        }
    }
}

pub(super) struct LoopText {
    /// Its first node, which may be a product in the line of a sum.
    pub first: Id,
    /// The arrays that it reads and writes.
    pub before: Vec<String>,
    pub head: String,
    /// The nodes of lane 0, with their lines: an operation, and a store if others read its value.
    pub rows: Vec<(Id, Vec<String>)>,
    /// Its arrays of values that differ from lane to lane, and of values that others read.
    pub read: Option<String>,
    pub written: Option<String>,
}

/// Names values of loops as what is outside of these reads them, and returns the pieces.
pub(super) fn pieces<'c>(dialect: Dialect, code: &'c Code) -> (Lines<'c, Input>, Vec<Piece>) {
    let mut lines = Lines::new(dialect, code);
    let ids: Vec<Id> = code.dag.operations().map(|(id, ..)| id).collect();
    let mut pieces = Vec::new();
    let mut done = 0;
    let places = places(code, &ids);
    for (number, block) in (1..).zip(&code.loops) {
        pieces.push(Piece::Shared(ids[done..block.first].to_vec()));
        let writer = LoopWriter {
            dialect,
            code,
            ids: &ids,
            places: &places,
            block,
            number,
            exports: exports(code, &ids, block),
            arrays: [Vec::new(), Vec::new()],
        };
        let exports = writer.exports.clone();
        pieces.push(Piece::Lanes(writer.write(&lines)));
        for (place, (row, is_negative)) in exports.into_iter().enumerate() {
            for lane in 0..block.lanes {
                let id = ids[block.first + lane * block.rows + row];
                lines.name(id, format!("w{number}[{place}][{lane}]"), is_negative);
            }
        }
        done = block.end();
    }
    pieces.push(Piece::Shared(ids[done..].to_vec()));
    (lines, pieces)
}

/// Returns the loop, lane and row of each node that is in a loop.
fn places(code: &Code, ids: &[Id]) -> HashMap<Id, (usize, usize, usize)> {
    let mut places = HashMap::new();
    for (number, block) in (1..).zip(&code.loops) {
        for (index, id) in ids[block.first..block.end()].iter().enumerate() {
            places.insert(*id, (number, index / block.rows, index % block.rows));
        }
    }
    places
}

/// Lists the rows that something outside of a loop reads, ascending; and if only results do, and all
/// of them the negative, which the loop then stores.
fn exports(code: &Code, ids: &[Id], block: &Loop) -> Vec<(usize, bool)> {
    let rows = (0..block.rows).cycle();
    let places = ids[block.first..block.end()].iter().copied().zip(rows);
    let inside: HashMap<Id, usize> = places.collect();
    // Reads of the value, and of its negative.
    let mut reads = vec![[false; 2]; block.rows];
    let mut mark_read = |id: &Id, is_negative: bool| {
        if let Some(row) = inside.get(id) {
            reads[*row][usize::from(is_negative)] = true;
        }
    };
    for (id, _, operands) in code.dag.operations() {
        for operand in operands.iter().filter(|_| !inside.contains_key(&id)) {
            mark_read(operand, false);
        }
    }
    for edge in &code.dag.outputs {
        mark_read(&edge.node, edge.negative);
    }
    let mut exports = Vec::new();
    for (row, reads) in reads.into_iter().enumerate() {
        if reads != [false; 2] {
            exports.push((row, reads == [false, true]));
        }
    }
    exports
}

struct LoopWriter<'a> {
    dialect: Dialect,
    code: &'a Code,
    ids: &'a [Id],
    places: &'a HashMap<Id, (usize, usize, usize)>,
    block: &'a Loop,
    number: usize,
    exports: Vec<(usize, bool)>,
    /// Numbers and other values that differ from lane to lane.
    arrays: [Vec<Vec<Id>>; 2],
}

impl LoopWriter<'_> {
    fn write(mut self, lines: &Lines<'_, Input>) -> LoopText {
        let stores = self.stores();
        let mut rows = Vec::new();
        for (row, store) in stores.into_iter().enumerate() {
            let computed = self.row(row, lines);
            rows.extend(computed.map(|(id, line)| (id, [Some(line), store].into_iter().flatten())));
        }
        let rows = rows.into_iter().map(|(id, lines)| (id, lines.collect()));
        let number = self.number;
        let mut before = Vec::new();
        for (letter, array) in ["k", "u"].into_iter().zip(&self.arrays) {
            let values = |ids: &Vec<Id>| list(ids.iter().map(|id| lines.operand(*id)));
            let rows: Vec<String> = array.iter().map(values).collect();
            let kind = (letter, number);
            before.extend(self.dialect.array(kind, self.block.lanes, &rows));
        }
        let read = (!self.arrays[1].is_empty()).then(|| format!("u{number}"));
        let written = (!self.exports.is_empty()).then(|| format!("w{number}"));
        let sizes = [self.exports.len(), self.block.lanes];
        let empty = |name: &String| self.dialect.empty_array(name, sizes);
        before.extend(written.iter().map(empty));
        LoopText {
            first: self.ids[self.block.first],
            before,
            head: self.dialect.lanes(self.block.lanes),
            rows: rows.collect(),
            read,
            written,
        }
    }

    /// Returns for each row the line that stores its value, if something outside of the loop reads it.
    fn stores(&self) -> Vec<Option<String>> {
        let mut stores = vec![None; self.block.rows];
        for (place, (row, is_negative)) in self.exports.iter().enumerate() {
            let (number, name) = (self.number, self.name(*row));
            let sign = if *is_negative { "-" } else { "" };
            stores[*row] = Some(format!("w{number}[{place}][l] = {sign}{name};"));
        }
        stores
    }

    fn name(&self, row: usize) -> String {
        format!("t{}", self.block.first + row + 1)
    }

    /// Returns the line of a row; none of a product that is part of a sum's.
    fn row(&mut self, row: usize, lines: &Lines<'_, Input>) -> Option<(Id, String)> {
        let dag = &self.code.dag;
        let of_lane = |lane: usize| self.ids[self.block.first + lane * self.block.rows + row];
        let nodes: Vec<Id> = (0..self.block.lanes).map(of_lane).collect();
        let Node::Apply(operation, _) = *dag.node(nodes[0]) else {
            return None;
        };
        let fusions: Vec<Fusion> = nodes.iter().filter_map(|id| dag.fusion(*id)).collect();
        let value = match fusions.first() {
            _ if operation == Operation::Fused => return None,
            None => {
                let operands = nodes.iter().filter_map(|id| dag.node(*id).operands());
                let operands: Vec<[Id; 2]> = operands.collect();
                let [left, right] = [0, 1].map(|side| {
                    let lanes = operands.iter().map(|pair| pair[side]).collect();
                    self.operand(lanes, lines)
                });
                self.dialect.operation(operation, &left, &right)
            }
            Some(first) => {
                let factors = [0, 1].map(|side| {
                    let lanes = fusions.iter().map(|fusion| fusion.factors[side]).collect();
                    self.operand(lanes, lines)
                });
                let addend = fusions.iter().map(|fusion| fusion.addend).collect();
                let addend = self.operand(addend, lines);
                self.dialect.fused_sum(first, factors, &addend)
            }
        };
        Some((nodes[0], self.dialect.declare(&self.name(row), &value)))
    }

    fn operand(&mut self, lanes: Vec<Id>, lines: &Lines<'_, Input>) -> String {
        let first = self.places.get(&lanes[0]);
        if let Some((number, 0, row)) = first {
            // Each lane's, of the same row of this loop or of one before it.
            let is_aligned = (lanes.iter().enumerate())
                .all(|(lane, id)| self.places.get(id) == Some(&(*number, lane, *row)));
            if is_aligned && *number == self.number {
                return self.name(*row);
            }
            if is_aligned {
                let name = lines.operand(lanes[0]);
                return name.strip_suffix("[0]").unwrap_or(&name).to_owned() + "[l]";
            }
        }
        if lanes.iter().all(|id| *id == lanes[0]) {
            return lines.operand(lanes[0]);
        }
        let is_number = |id: &Id| matches!(self.code.dag.node(*id), Node::Constant(_));
        let kind = usize::from(!lanes.iter().all(is_number));
        let array = &mut self.arrays[kind];
        let known = array.iter().position(|known| *known == lanes);
        let place = known.unwrap_or(array.len());
        if known.is_none() {
            array.push(lanes);
        }
        let letter = ["k", "u"][kind];
        format!("{letter}{}[{place}][l]", self.number)
    }
}

impl Dialect {
    /// Returns the lines of an array of rows that have a value a lane; none without rows.
    fn array(&self, (letter, number): (&str, usize), lanes: usize, rows: &[String]) -> Vec<String> {
        if rows.is_empty() {
            return Vec::new();
        }
        let (head, [open, close]) = match self.language {
            Language::Rust => (format!("let {letter}{number} ="), ["[", "]"]),
            Language::C | Language::Cuda => {
                let kind = match letter {
                    "k" => "static const ",
                    _ => "",
                };
                let array = format!("{letter}{number}[{}][{lanes}]", rows.len());
                let head = format!("{kind}{} {array} =", float(self.scalar));
                (head, ["{", "}"])
            }
        };
        let mut lines = vec![format!("{head} {open}")];
        let row = |values: &String| format!("    {open}{values}{close},");
        lines.extend(rows.iter().map(row));
        lines.push(format!("{close};"));
        lines
    }

    fn empty_array(&self, name: &str, [rows, lanes]: [usize; 2]) -> String {
        match self.language {
            Language::Rust => format!("let mut {name} = [[0.0; {lanes}]; {rows}];"),
            Language::C | Language::Cuda => {
                format!("{} {name}[{rows}][{lanes}];", float(self.scalar))
            }
        }
    }

    fn lanes(&self, lanes: usize) -> String {
        match self.language {
            Language::Rust => format!("for l in 0..{lanes} {{"),
            Language::C | Language::Cuda => format!("for (int l = 0; l < {lanes}; ++l) {{"),
        }
    }
}
