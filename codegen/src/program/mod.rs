//! Straight-line code, and what it is made of.
//!
//! Takes a `Dag`; returns a [`Program`], whose constants are exact, and [`Code`], whose constants a
//! [`ScalarType`] has rounded.

pub(crate) mod code;
mod difference;
pub(crate) mod kernel;
pub(crate) mod machine;
pub(crate) mod scalar_type;
pub(crate) mod steps;

use std::collections::BTreeMap;

use dalembert_model::number::Exact;
use dalembert_model::scalar::Scalar;

pub use crate::dag::{Counts, Input, Operation};
use crate::dag::{Dag, Edge, Id, Node};
use crate::function::{Argument, Function, RegressorColumns, Sizes};
pub(crate) use code::Speed;
pub use code::{Code, Pair};
pub(crate) use kernel::SinCosUse;
pub use machine::Library;
pub use scalar_type::{Literal, ScalarType};
pub use steps::{Operand, Output, Step, Steps};

/// A straight-line program with exact constants, which proofs are about. [`Code`] is the same with
/// the constants rounded, as they are printed.
#[derive(Clone, Debug, PartialEq)]
pub struct Program {
    /// The function that the program computes.
    pub function: Function,
    /// n, the number of joints: the length of q.
    pub joints: usize,
    /// The coordinates of a base that floats: six, or none.
    pub floating: usize,
    /// The joints with which the limbs of a base that floats begin, a bit each.
    pub limbs: u64,
    /// The coordinates that the results are over, zero-based, in their order.
    pub rows: Vec<usize>,
    /// The arguments there are, in order.
    pub arguments: Vec<Argument>,
    /// The number of entries of the load; zero where the load is neither argument nor result.
    pub load: usize,
    /// The links whose bodies are an argument.
    pub bodies: usize,
    /// The rows of the table.
    pub table: usize,
    /// The coordinates of which r = 1/√(q̇² + w²) is read, ascending.
    pub speeds: Vec<Speed>,
    /// The arithmetic in the order of the code, each leaf before the first operation that reads it,
    /// and the results in the order of the function's quantities.
    pub dag: Dag,
    /// Operations that the text has in loops, in their order.
    pub loops: Vec<Loop>,
}

/// Operations that are the same for several lanes: a lane's rows stand together, lanes in order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Loop {
    /// The first, among all operations.
    pub first: usize,
    /// The operations of a lane.
    pub rows: usize,
    /// The number of lanes.
    pub lanes: usize,
}

impl Loop {
    /// Returns the operation behind the last.
    pub fn end(&self) -> usize {
        self.first + self.rows * self.lanes
    }

    /// Returns the lane and the row of an operation; none of one that is not in the loop.
    pub(crate) fn place(&self, operation: usize) -> Option<[usize; 2]> {
        let inside = operation.checked_sub(self.first)?;
        (operation < self.end()).then_some([inside / self.rows, inside % self.rows])
    }
}

impl Program {
    /// Creates what a function of a whole robot begins with: no operation, no result.
    pub fn empty(function: Function, robot: Sizes) -> Program {
        Program {
            function,
            joints: robot.joints,
            floating: robot.floating,
            limbs: robot.limbs,
            rows: (0..robot.coordinates()).collect(),
            arguments: function.arguments(),
            load: 0,
            bodies: robot.bodies,
            table: robot.table,
            speeds: Vec::new(),
            dag: Dag::default(),
            loops: Vec::new(),
        }
    }

    /// Returns the program of another graph with the same arguments and results, in print order.
    #[must_use]
    pub fn with_graph(&self, graph: &Dag) -> Program {
        self.with_code(graph.scheduled())
    }

    /// The operations keep their order, and are in no loop. A constant that is a result has its own sign.
    #[must_use]
    pub(crate) fn with_code(&self, mut graph: Dag) -> Program {
        for edge in &mut graph.outputs {
            if let (true, Node::Constant(constant)) = (edge.negative, &graph.nodes[edge.index()]) {
                let constant = Node::Constant(constant.neg());
                *edge = Edge::from(graph.nodes.len() as Id);
                graph.nodes.push(constant);
            }
        }
        let program = Program {
            rows: self.rows.clone(),
            arguments: self.arguments.clone(),
            dag: graph.map(Exact::clone, |input| *input),
            speeds: Vec::new(),
            loops: Vec::new(),
            ..*self
        };
        program.with_speeds(self.speeds.clone())
    }

    /// `function` may have another name or order; `None` if it has a result that is missing here.
    pub(crate) fn as_function(&self, function: Function) -> Option<Program> {
        let sizes = self.sizes();
        let mut rest = self.dag.outputs.as_slice();
        let mut results = Vec::new();
        for quantity in self.function.quantities() {
            let (edges, others) = rest.split_at_checked(quantity.len(sizes))?;
            results.push((quantity, edges));
            rest = others;
        }
        let mut program = self.clone();
        program.function = function;
        program.dag.outputs.clear();
        for wanted in function.quantities() {
            let (_, edges) = results.iter().find(|(quantity, _)| *quantity == wanted)?;
            program.dag.outputs.extend_from_slice(edges);
        }
        Some(program)
    }

    /// Returns the program with its products fused; in loops those that all lanes fuse.
    #[must_use]
    pub fn fused(&self) -> Program {
        let cells = self.cells();
        let fused = self.dag.fused_where(|taken| {
            let is_within = |sum: Id, product: Id| {
                let [cell, other] = [sum, product].map(|id| cells[id as usize]);
                cell.0 == other.0 && cell.1 == other.1
            };
            for (sum, product) in (0..).zip(taken.iter_mut()) {
                *product = product.filter(|product| is_within(sum, *product));
            }
            let ids: Vec<Id> = self.dag.operations().map(|(id, ..)| id).collect();
            for block in &self.loops {
                for row in 0..block.rows {
                    let of_lane = |lane: usize| ids[block.first + lane * block.rows + row];
                    let lanes: Vec<Id> = (0..block.lanes).map(of_lane).collect();
                    let product = |id: &Id| taken[*id as usize].map(|node| cells[node as usize].2);
                    if lanes.iter().any(|id| product(id) != product(&lanes[0])) {
                        lanes.iter().for_each(|id| taken[*id as usize] = None);
                    }
                }
            }
        });
        // A product stands in front of its sum, in the same lane: loops are as long as they were.
        let mut program = self.with_code(fused);
        program.loops.clone_from(&self.loops);
        program
    }

    /// Lists for each node the loop, or the part between two, that it is in, its lane and its row.
    fn cells(&self) -> Vec<(usize, usize, usize)> {
        let mut cells = vec![(0, 0, 0); self.dag.nodes.len()];
        for (place, (id, ..)) in self.dag.operations().enumerate() {
            let before = self.loops.partition_point(|block| block.end() <= place);
            let inside = self.loops.get(before).and_then(|block| block.place(place));
            cells[id as usize] = match inside {
                Some([lane, row]) => (2 * before + 1, lane, row),
                None => (2 * before, 0, place),
            };
        }
        cells
    }

    #[must_use]
    pub(crate) fn with_speeds(self, speeds: Vec<Speed>) -> Program {
        let speeds = self.read_speeds(speeds);
        Program { speeds, ..self }
    }

    pub(crate) fn read_speeds(&self, mut speeds: Vec<Speed>) -> Vec<Speed> {
        let is_read = |joint_speed: &Speed| {
            let speed = Input::PerSpeed(joint_speed.coordinate);
            self.dag.inputs().any(|input| *input == speed)
        };
        speeds.retain(is_read);
        speeds
    }

    /// Lists the sines and cosines that it reads, joints ascending, as a library computes them.
    pub fn trig(&self) -> Vec<Pair> {
        let mut needs: BTreeMap<usize, SinCosUse> = BTreeMap::new();
        for input in self.dag.inputs() {
            match *input {
                Input::Sin(joint) => needs.entry(joint).or_default().sin = true,
                Input::Cos(joint) => needs.entry(joint).or_default().cos = true,
                Input::PerSpeed(_) | Input::Entry(..) => {}
            }
        }
        let pair = |(joint, need)| Pair {
            joint,
            need,
            kernel: None,
        };
        needs.into_iter().map(pair).collect()
    }

    /// True if the lanes of each loop have the same operations, on values of their lane or of others.
    pub(crate) fn has_lanes(&self) -> bool {
        let operations: Vec<_> = self.dag.operations().collect();
        let places: BTreeMap<Id, usize> = operations.iter().map(|(id, ..)| *id).zip(0..).collect();
        let mut done = 0;
        self.loops.iter().all(|block| {
            let lanes = block.rows.checked_mul(block.lanes);
            let end = lanes.and_then(|lanes| lanes.checked_add(block.first));
            let is_there = end.is_some_and(|end| end <= operations.len());
            if !is_there || block.first < done || block.rows == 0 || block.lanes < 2 {
                return false;
            }
            done = block.end();
            // The row that an operand is in the lane; nothing of another lane.
            let within = |id: &Id, lane: usize| {
                let place = places.get(id).and_then(|place| block.place(*place));
                place.map(|[other, row]| (other == lane).then_some(row))
            };
            (0..block.rows).all(|row| {
                let (_, operation, operands) = &operations[block.first + row];
                let first_rows = operands.each_ref().map(|id| within(id, 0));
                (1..block.lanes).all(|lane| {
                    let (_, other, others) = &operations[block.first + lane * block.rows + row];
                    // None reads a value of another lane.
                    let rows = others.each_ref().map(|id| within(id, lane));
                    other == operation && rows == first_rows && !rows.contains(&Some(None))
                })
            })
        })
    }

    /// Counts the operations.
    pub fn counts(&self) -> Counts {
        let counts = Counts {
            sincos: self.trig().len(),
            ..self.dag.arithmetic()
        };
        counts.with_speeds(self.speeds.len())
    }

    /// Returns the numbers that the lengths of results follow from; the number of base
    /// parameters is derived from the number of results.
    pub fn sizes(&self) -> Sizes {
        let whole = Sizes {
            load: self.load,
            bodies: self.bodies,
            table: self.table,
            ..Sizes::floating(self.floating, self.joints, self.limbs)
        };
        let mut sizes = whole.over(&self.rows);
        if let RegressorColumns::Base(_) = self.function.columns() {
            // The other results of a bundle have known lengths.
            let others = self.function.outputs(sizes);
            sizes.base = self.dag.outputs.len().saturating_sub(others) / self.rows.len().max(1);
        }
        sizes
    }

    /// True if the program divides.
    pub fn divides(&self) -> bool {
        self.has(Operation::Div)
    }

    /// True if the program has fused products.
    pub fn fuses(&self) -> bool {
        self.has(Operation::Fused)
    }

    fn has(&self, operation: Operation) -> bool {
        self.dag.operations().any(|(_, op, _)| op == operation)
    }
}

pub(crate) fn has_inertia(program: &Program) -> bool {
    let mut quantities = program.function.quantities().iter();
    quantities.any(|quantity| quantity.facts().definite)
}
