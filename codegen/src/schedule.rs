//! From a graph to straight-line code, and back.

use dalembert_model::scalar::Scalar;
use rustc_hash::FxHashMap;

use crate::dag::{Dag, Edge, Id, Node};
use crate::function::Function;
use crate::program::{Operand, Output, Program, Step};
use crate::scene::SceneRobot;

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
    pub fn in_scene(scene_robot: &SceneRobot, function: Function, graph: &Dag) -> Program {
        let empty = Program {
            rows: scene_robot.rows().to_vec(),
            arguments: scene_robot.arguments(function),
            load: scene_robot.sizes(function).load,
            speeds: scene_robot.speeds(),
            ..Program::empty(function, scene_robot.joints().len())
        };
        empty.with_graph(graph)
    }

    /// Returns the graph of the program.
    pub(crate) fn graph(&self) -> Dag {
        let mut graph = Dag {
            nodes: Vec::new(),
            outputs: Vec::new(),
        };
        let mut leaves: FxHashMap<Node, Id> = FxHashMap::default();
        let mut places: Vec<Id> = Vec::with_capacity(self.steps.len());
        let mut place = |operand: &Operand, places: &[Id], graph: &mut Dag| {
            let leaf = match operand {
                Operand::Step(step) => return places[*step],
                Operand::Constant(constant) => Node::Constant(constant.clone()),
                Operand::Input(input) => Node::Input(*input),
            };
            *leaves.entry(leaf).or_insert_with_key(|leaf| {
                graph.nodes.push(leaf.clone());
                graph.nodes.len() as Id - 1
            })
        };
        for step in &self.steps {
            let [a, b] = [&step.left, &step.right].map(|own| place(own, &places, &mut graph));
            places.push(graph.nodes.len() as Id);
            graph.nodes.push(Node::Apply(step.operation, [a, b]));
        }
        for output in &self.outputs {
            let node = place(&output.value, &places, &mut graph);
            graph.outputs.push(Edge {
                node,
                negative: output.negative,
            });
        }
        graph
    }

    /// Returns the same function with the same arguments and results, by another
    /// graph.
    #[must_use]
    pub fn with_graph(&self, graph: &Dag) -> Program {
        let graph = graph.scheduled();
        let mut place = vec![usize::MAX; graph.nodes.len()];
        let mut steps = Vec::new();
        let operand = |id: Id, place: &[usize]| match graph.node(id) {
            Node::Constant(constant) => Operand::Constant(constant.clone()),
            Node::Input(input) => Operand::Input(*input),
            Node::Apply(..) => Operand::Step(place[id as usize]),
        };
        for (index, node) in graph.nodes.iter().enumerate() {
            if let Node::Apply(operation, operands) = node {
                let [left, right] = operands.map(|id| operand(id, &place));
                place[index] = steps.len();
                steps.push(Step {
                    operation: *operation,
                    left,
                    right,
                });
            }
        }
        let outputs = graph
            .outputs
            .iter()
            .map(|edge| match graph.node(edge.node) {
                Node::Constant(constant) if edge.negative => {
                    Output::of(Operand::Constant(constant.neg()))
                }
                _ => Output {
                    negative: edge.negative,
                    value: operand(edge.node, &place),
                },
            });
        let outputs = outputs.collect();
        let mut program = Program {
            trig: Vec::new(),
            speeds: Vec::new(),
            steps,
            outputs,
            rows: self.rows.clone(),
            arguments: self.arguments.clone(),
            ..*self
        };
        program.collect_trig();
        program.with_speeds(self.speeds.clone())
    }
}
