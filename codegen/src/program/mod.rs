//! Straight-line code, and what it is made of.

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
use crate::function::{Argument, Columns, Function, Sizes};
pub(crate) use code::Speed;
pub use code::{Code, Pair};
pub use kernel::Need;
pub use machine::Library;
pub use scalar_type::{Literal, ScalarType};
pub use steps::{Operand, Output, Step, Steps};

/// Straight-line code with exact constants: what is proved and emitted.
#[derive(Clone, Debug, PartialEq)]
pub struct Program {
    /// The function that the program computes.
    pub function: Function,
    /// n, the number of joints: the length of q.
    pub joints: usize,
    /// The coordinates of a base that floats: six, or none.
    pub floating: usize,
    /// The coordinates that the results are over, zero-based, in their order.
    pub rows: Vec<usize>,
    /// The arguments there are, in order.
    pub arguments: Vec<Argument>,
    /// The number of entries of the load; zero where the load is neither argument nor result.
    pub load: usize,
    /// The coordinates of which r = 1/√(q̇² + w²) is read, ascending.
    pub speeds: Vec<Speed>,
    /// The arithmetic in the order of the code, each leaf before the first operation that reads it,
    /// and the results in the order of the function's quantities.
    pub dag: Dag,
}

impl Program {
    /// Creates what a function of a whole robot begins with: no operation, no result.
    pub fn empty(function: Function, robot: Sizes) -> Program {
        Program {
            function,
            joints: robot.joints,
            floating: robot.floating,
            rows: (0..robot.coordinates()).collect(),
            arguments: function.arguments(),
            load: 0,
            speeds: Vec::new(),
            dag: Dag::default(),
        }
    }

    /// Returns the program of another graph with the same arguments and results, in print order.
    #[must_use]
    pub fn with_graph(&self, graph: &Dag) -> Program {
        self.with_code(graph.scheduled())
    }

    /// The operations keep their order. A constant that is a result has its own sign.
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
            let (own, others) = rest.split_at_checked(quantity.len(sizes))?;
            results.push((quantity, own));
            rest = others;
        }
        let mut program = self.clone();
        program.function = function;
        program.dag.outputs.clear();
        for wanted in function.quantities() {
            let (_, own) = results.iter().find(|(quantity, _)| *quantity == wanted)?;
            program.dag.outputs.extend_from_slice(own);
        }
        Some(program)
    }

    /// Returns the program with its products fused.
    #[must_use]
    pub fn fused(&self) -> Program {
        self.with_code(self.dag.fused())
    }

    #[must_use]
    pub(crate) fn with_speeds(self, speeds: Vec<Speed>) -> Program {
        let speeds = self.read(speeds);
        Program { speeds, ..self }
    }

    pub(crate) fn read(&self, mut speeds: Vec<Speed>) -> Vec<Speed> {
        let is_read = |own: &Speed| {
            let speed = Input::PerSpeed(own.coordinate);
            self.dag.inputs().any(|input| *input == speed)
        };
        speeds.retain(is_read);
        speeds
    }

    /// Lists the sines and cosines that it reads, joints ascending, as a library computes them.
    pub fn trig(&self) -> Vec<Pair> {
        let mut needs: BTreeMap<usize, Need> = BTreeMap::new();
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

    /// Counts the operations.
    pub fn counts(&self) -> Counts {
        let own = Counts {
            sincos: self.trig().len(),
            ..self.dag.arithmetic()
        };
        own.with_speeds(self.speeds.len())
    }

    /// Returns the numbers that the lengths of results follow from; the number of base
    /// parameters is derived from the number of results.
    pub fn sizes(&self) -> Sizes {
        let rows = self.rows.len();
        let whole = Sizes {
            floating: self.floating,
            load: self.load,
            ..Sizes::whole(self.joints)
        };
        let mut sizes = whole.over(&self.rows);
        if let Columns::Base(_) = self.function.columns() {
            // What a bundle returns beside its regressor is of known lengths.
            let others = self.function.outputs(sizes);
            sizes.base = self.dag.outputs.len().saturating_sub(others) / rows.max(1);
        }
        sizes
    }

    /// Returns whether the program divides.
    pub fn divides(&self) -> bool {
        self.has(Operation::Div)
    }

    /// Returns whether the program has fused products.
    pub fn fuses(&self) -> bool {
        self.has(Operation::Fused)
    }

    fn has(&self, operation: Operation) -> bool {
        self.dag.operations().any(|(_, own, _)| own == operation)
    }
}

pub(crate) fn has_inertia(program: &Program) -> bool {
    let mut quantities = program.function.quantities().iter();
    quantities.any(|quantity| quantity.facts().definite)
}
