//! From a graph to straight-line code, and back.

use dalembert_model::scalar::Scalar;

use crate::dag::{Dag, Edge, Id, Node, Writer};
use crate::function::Function;
use crate::program::{Operand, Output, Program, Step};
use crate::setup::Task;

impl Program {
    /// Creates the program of a graph of a function of a whole robot.
    pub fn new(function: Function, joints: usize, graph: &Dag) -> Program {
        Program::empty(function, joints).with_graph(graph)
    }

    /// Creates what a function of a whole robot begins with: no step, no result.
    pub fn empty(function: Function, joints: usize) -> Program {
        Program {
            function,
            joints,
            rows: (0..joints).collect(),
            arguments: function.arguments(),
            load: 0,
            trig: Vec::new(),
            speeds: Vec::new(),
            steps: Vec::new(),
            outputs: Vec::new(),
        }
    }

    /// Creates the program of a graph of a function in a scene.
    pub fn in_scene(task: Task<'_>, graph: &Dag) -> Program {
        let Task { setup, function } = task;
        let empty = Program {
            rows: setup.rows().to_vec(),
            arguments: setup.arguments(function),
            load: setup.sizes(function).load,
            speeds: setup.speeds(),
            ..Program::empty(function, setup.joints().len())
        };
        empty.with_graph(graph)
    }

    /// Returns the graph of the program.
    pub fn graph(&self) -> Dag {
        let mut writer = Writer::default();
        let mut places: Vec<Id> = Vec::with_capacity(self.steps.len());
        let place = |operand: &Operand, places: &[Id], writer: &mut Writer<_, _>| match operand {
            Operand::Step(step) => places[*step],
            Operand::Constant(constant) => writer.leaf(Node::Constant(constant.clone())),
            Operand::Input(input) => writer.leaf(Node::Input(*input)),
        };
        for step in &self.steps {
            let operands = [&step.left, &step.right].map(|own| place(own, &places, &mut writer));
            places.push(writer.apply(step.operation, operands));
        }
        let outputs = self.outputs.iter().map(|output| Edge {
            node: place(&output.value, &places, &mut writer),
            negative: output.negative,
        });
        let outputs = outputs.collect();
        writer.finish(outputs)
    }

    /// Returns the same function with the same arguments and results, by another
    /// graph in the order in which code is printed.
    #[must_use]
    pub fn with_graph(&self, graph: &Dag) -> Program {
        self.with_code(&graph.scheduled())
    }

    /// Returns the same function with the same arguments and results, by another graph whose
    /// operations are in this order.
    #[must_use]
    pub(crate) fn with_code(&self, graph: &Dag) -> Program {
        let numbers = graph.numbers();
        let operand = |id: Id| match graph.node(id) {
            Node::Constant(constant) => Operand::Constant(constant.clone()),
            Node::Input(input) => Operand::Input(*input),
            // An operation has a number, from one.
            Node::Apply(..) => Operand::Step(numbers[id as usize].unwrap_or(1) - 1),
        };
        let steps = graph
            .operations()
            .map(|(_, operation, [left, right])| Step {
                operation,
                left: operand(left),
                right: operand(right),
            });
        let outputs = graph.outputs.iter();
        let outputs = outputs.map(|edge| match graph.node(edge.node) {
            Node::Constant(constant) if edge.negative => {
                Output::of(Operand::Constant(constant.neg()))
            }
            _ => Output {
                negative: edge.negative,
                value: operand(edge.node),
            },
        });
        let mut program = Program {
            trig: Vec::new(),
            speeds: Vec::new(),
            steps: steps.collect(),
            outputs: outputs.collect(),
            rows: self.rows.clone(),
            arguments: self.arguments.clone(),
            ..*self
        };
        program.collect_trig();
        program.with_speeds(self.speeds.clone())
    }
}
