//! From a graph to straight-line code: sines and cosines first, once for each
//! angle, then arithmetic in an order that keeps few values alive.

use std::collections::BTreeMap;

use dalembert_model::number::Exact;

use crate::function::{Argument, Function};
use crate::graph::{AngleSum, Counts, Edge, Graph, Input, Node, NodeId};
use crate::scene::Setting;

/// Straight-line code with exact constants: what is proved and emitted.
#[derive(Clone, Debug, PartialEq)]
pub struct Program {
    /// What it computes.
    pub function: Function,
    /// n: the length of every argument.
    pub joints: usize,
    /// The joints that the results are over, zero-based, in their order.
    pub rows: Vec<usize>,
    /// The arguments there are, in order.
    pub arguments: Vec<Argument>,
    /// The angles whose sine or cosine it needs, ascending.
    pub trig: Vec<Trig>,
    /// The arithmetic, operands before users.
    pub steps: Vec<Step>,
    /// The results in the order of the function's quantities.
    pub outputs: Vec<Output>,
}

/// One sine/cosine evaluation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Trig {
    /// The angle.
    pub angle: AngleSum,
    /// Whether the sine is needed.
    pub sin: bool,
    /// Whether the cosine is needed.
    pub cos: bool,
}

/// One operation.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// What is done.
    pub operation: Operation,
    /// Left operand.
    pub left: Operand,
    /// Right operand.
    pub right: Operand,
}

/// The operations of emitted code.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Operation {
    /// left + right
    Add,
    /// left − right
    Sub,
    /// left · right
    Mul,
}

/// What a step reads.
#[derive(Clone, Debug, PartialEq)]
pub enum Operand {
    /// An input.
    Input(Input),
    /// An exact constant, rounded once when it is printed.
    Constant(Exact),
    /// The result of an earlier step.
    Step(usize),
}

/// A result, negated or not: negation is free.
#[derive(Clone, Debug, PartialEq)]
pub struct Output {
    /// Whether it is negated.
    pub negative: bool,
    /// The value.
    pub value: Operand,
}

impl Operation {
    /// Its symbol in Rust.
    pub fn symbol(self) -> char {
        match self {
            Operation::Add => '+',
            Operation::Sub => '-',
            Operation::Mul => '*',
        }
    }
}

impl Program {
    /// Straight-line code for the graph of a function of a whole robot.
    pub fn new(function: Function, joints: usize, graph: &Graph) -> Program {
        let empty = Program {
            function,
            joints,
            rows: (0..joints).collect(),
            arguments: function.arguments().to_vec(),
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

    /// Lists the sines and cosines that steps and outputs read.
    pub(crate) fn collect_trig(&mut self) {
        let mut trig: BTreeMap<AngleSum, Trig> = BTreeMap::new();
        let operands = self.steps.iter().flat_map(|step| [&step.left, &step.right]);
        for operand in operands.chain(self.outputs.iter().map(|output| &output.value)) {
            if let Operand::Input(input) = operand {
                note_trig(&mut trig, *input);
            }
        }
        self.trig = trig.into_values().collect();
    }

    /// What it costs.
    pub fn counts(&self) -> Counts {
        let mul = self
            .steps
            .iter()
            .filter(|step| step.operation == Operation::Mul)
            .count();
        let angles: usize = self.trig.iter().map(|t| t.angle.additions()).sum();
        Counts {
            mul,
            add: self.steps.len() - mul + angles,
            div: 0,
            sincos: self.trig.len(),
            ..Counts::default()
        }
    }
}

fn note_trig(trig: &mut BTreeMap<AngleSum, Trig>, input: Input) {
    if let Some(angle) = input.angle() {
        let entry = trig.entry(angle).or_insert(Trig {
            angle,
            sin: false,
            cos: false,
        });
        match input {
            Input::Sin(_) => entry.sin = true,
            _ => entry.cos = true,
        }
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
    // A constant reads best on the right; a − b keeps its order.
    let swap = operation != Operation::Sub && matches!(left, Operand::Constant(_));
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
