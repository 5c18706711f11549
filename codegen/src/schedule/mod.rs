//! From a graph to straight-line code: arithmetic in an order that keeps few
//! values alive.

use crate::function::Function;
use crate::graph::{Edge, Graph, Node, NodeId};
use crate::program::{Operand, Operation, Output, Program, Step};
use crate::scene::Setting;

impl Program {
    /// Straight-line code for the graph of a function of a whole robot.
    pub fn new(function: Function, joints: usize, graph: &Graph) -> Program {
        let empty = Program {
            function,
            joints,
            rows: (0..joints).collect(),
            arguments: function.arguments(),
            trig: Vec::new(),
            steps: Vec::new(),
            outputs: Vec::new(),
        };
        empty.with_graph(graph)
    }

    /// Straight-line code for the graph of a function in a setting.
    pub fn in_setting(setting: &Setting, function: Function, graph: &Graph) -> Program {
        let empty = Program {
            function,
            joints: setting.joints().len(),
            rows: setting.rows().to_vec(),
            arguments: setting.arguments(function),
            trig: Vec::new(),
            steps: Vec::new(),
            outputs: Vec::new(),
        };
        empty.with_graph(graph)
    }

    /// The same function with the same arguments and results, by another
    /// graph.
    #[must_use]
    pub fn with_graph(&self, graph: &Graph) -> Program {
        let order = evaluation_order(graph);
        let mut place: Vec<Option<usize>> = vec![None; graph.nodes.len()];
        let mut steps = Vec::new();
        for id in order {
            match graph.node(id) {
                Node::Input(_) | Node::Constant(_) => {}
                Node::Sum(a, b) => steps.push(step(graph, &place, Operation::Add, a, b)),
                Node::Difference(a, b) => steps.push(step(graph, &place, Operation::Sub, a, b)),
                Node::Product(a, b) => steps.push(step(graph, &place, Operation::Mul, a, b)),
                Node::Quotient(a, b) => steps.push(step(graph, &place, Operation::Div, a, b)),
            }
            if graph.node(id).operands().is_some() {
                place[id.index()] = Some(steps.len() - 1);
            }
        }
        let outputs = graph
            .outputs
            .iter()
            .map(|&edge| output(graph, &place, edge))
            .collect();
        let mut program = Program {
            function: self.function,
            joints: self.joints,
            rows: self.rows.clone(),
            arguments: self.arguments.clone(),
            trig: Vec::new(),
            steps,
            outputs,
        };
        program.collect_trig();
        program
    }
}

fn operand(graph: &Graph, place: &[Option<usize>], id: NodeId) -> Operand {
    match graph.node(id) {
        Node::Constant(c) => Operand::Constant(graph.constants[c as usize].clone()),
        Node::Input(input) => Operand::Input(input),
        // The order is topological, so every operation has its place.
        _ => Operand::Step(place[id.index()].unwrap_or(usize::MAX)),
    }
}

fn step(
    graph: &Graph,
    place: &[Option<usize>],
    operation: Operation,
    a: NodeId,
    b: NodeId,
) -> Step {
    let (left, right) = (operand(graph, place, a), operand(graph, place, b));
    // A constant reads best on the right; a − b and a / b keep their order.
    let commutes = matches!(operation, Operation::Add | Operation::Mul);
    let swap = commutes && matches!(left, Operand::Constant(_));
    let (left, right) = if swap { (right, left) } else { (left, right) };
    Step {
        operation,
        left,
        right,
    }
}

fn output(graph: &Graph, place: &[Option<usize>], edge: Edge) -> Output {
    use dalembert_model::scalar::Scalar;
    match operand(graph, place, edge.node()) {
        Operand::Constant(c) if edge.is_negative() => Output {
            negative: false,
            value: Operand::Constant(c.neg()),
        },
        value => Output {
            negative: edge.is_negative(),
            value,
        },
    }
}

/// Depth first from the outputs, the operand that needs more operations
/// first: its temporaries are dead before the other's live.
fn evaluation_order(graph: &Graph) -> Vec<NodeId> {
    let mut weight = vec![0u64; graph.nodes.len()];
    for (index, node) in graph.nodes.iter().enumerate() {
        if let Some([a, b]) = node.operands() {
            weight[index] = weight[a.index()]
                .saturating_add(weight[b.index()])
                .saturating_add(1);
        }
    }
    let mut order = Vec::new();
    let mut done = vec![false; graph.nodes.len()];
    let mut stack: Vec<(NodeId, bool)> = Vec::new();
    for output in &graph.outputs {
        stack.push((output.node(), false));
        while let Some((id, operands_done)) = stack.pop() {
            if done[id.index()] {
                continue;
            }
            match graph.node(id).operands() {
                Some([a, b]) if !operands_done => {
                    stack.push((id, true));
                    let (first, second) = if weight[a.index()] >= weight[b.index()] {
                        (a, b)
                    } else {
                        (b, a)
                    };
                    stack.push((second, false));
                    stack.push((first, false));
                }
                _ => {
                    done[id.index()] = true;
                    order.push(id);
                }
            }
        }
    }
    order
}
