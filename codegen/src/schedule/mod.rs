//! From a graph to straight-line code: arithmetic in an order that keeps few
//! values alive.

use crate::function::Function;
use crate::graph::{Edge, Graph, Node, NodeId};
use crate::program::{Operand, Operation, Output, Program, Step};
use crate::scene::SceneRobot;

impl Program {
    /// Returns Straight-line code for the graph of a function of a whole robot.
    pub fn new(function: Function, joints: usize, graph: &Graph) -> Program {
        Program::empty(function, joints).with_graph(graph)
    }

    /// Returns what a function of a whole robot begins with: no step, no result.
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

    /// Returns Straight-line code for the graph of a function in a scene.
    pub fn in_scene(scene_robot: &SceneRobot, function: Function, graph: &Graph) -> Program {
        let empty = Program {
            rows: scene_robot.rows().to_vec(),
            arguments: scene_robot.arguments(function),
            load: scene_robot.sizes(function).load,
            speeds: scene_robot.speeds(),
            ..Program::empty(function, scene_robot.joints().len())
        };
        empty.with_graph(graph)
    }

    /// Returns the same function with the same arguments and results, by another
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
            load: self.load,
            trig: Vec::new(),
            speeds: Vec::new(),
            steps,
            outputs,
        };
        program.collect_trig();
        program.with_speeds(self.speeds.clone())
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

/// Orders the steps depth first from the outputs, the operand that needs more operations first:
/// its temporaries are dead before the other's live.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::function::Argument;
    use crate::graph::builder::Value;
    use crate::graph::{Builder, Folding};
    use crate::program::Input;
    use dalembert_model::number::Exact;
    use dalembert_model::scalar::Scalar;

    fn program(outputs: impl Fn(&mut Builder) -> Vec<Value>) -> Program {
        let mut builder = Builder::new(Folding::Syntactic);
        let outputs = outputs(&mut builder);
        let graph = builder.finish(&outputs);
        Program::new(Function::InverseDynamics, 4, &graph)
    }

    fn q(builder: &mut Builder, joint: usize) -> Value {
        builder.input(Input::Entry(Argument::Position, joint))
    }

    /// The longer operand is computed first, whichever side it stands on, so that
    /// two values are alive at most.
    #[test]
    fn the_longer_operand_comes_first() {
        for swapped in [false, true] {
            let program = program(|b| {
                let (q0, q1, q2, q3) = (q(b, 0), q(b, 1), q(b, 2), q(b, 3));
                let short = b.mul(&q2, &q3);
                let long = b.mul(&q0, &q1);
                let long = b.mul(&long, &q2);
                let long = b.mul(&long, &q3);
                vec![match swapped {
                    false => b.add(&short, &long),
                    true => b.add(&long, &short),
                }]
            });
            let operations: Vec<Operation> = program.steps.iter().map(|s| s.operation).collect();
            use Operation::{Add, Mul};
            assert_eq!(operations, [Mul, Mul, Mul, Mul, Add]);
            // The fourth step is the short one: it reads no other step.
            let reads = |operand: &Operand| matches!(operand, Operand::Step(_));
            let short = &program.steps[3];
            assert!(!reads(&short.left) && !reads(&short.right), "{short:?}");
        }
    }

    /// What two outputs share is computed once, what none needs not at all, and
    /// every step reads earlier ones only.
    #[test]
    fn shared_once_and_dead_never() {
        let program = program(|b| {
            let (q0, q1, q2) = (q(b, 0), q(b, 1), q(b, 2));
            let shared = b.mul(&q0, &q1);
            let _dead = b.mul(&shared, &shared);
            vec![b.add(&shared, &q2), b.sub(&q2, &shared)]
        });
        assert_eq!(program.steps.len(), 3);
        for (index, step) in program.steps.iter().enumerate() {
            for operand in [&step.left, &step.right] {
                assert!(!matches!(operand, Operand::Step(of) if *of >= index));
            }
        }
        // A difference keeps its order.
        let last = &program.steps[2];
        let order = (&last.left, &last.right);
        assert_eq!(
            order,
            (
                &Operand::Input(Input::Entry(Argument::Position, 2)),
                &Operand::Step(0)
            )
        );
    }

    /// A constant stands on the right of a product, and takes the sign of its output.
    #[test]
    fn constants_on_the_right_and_signs_within() {
        let three = Exact::one().double().add(&Exact::one());
        let program = program(|b| {
            let (q0, three) = (q(b, 0), Value::Constant(three.clone()));
            let product = b.mul(&three, &q0);
            vec![product, b.negate_if(&three, true)]
        });
        assert!(matches!(program.steps[0].right, Operand::Constant(_)));
        let constant = &program.outputs[1];
        assert!(!constant.negative);
        assert_eq!(constant.value, Operand::Constant(three.neg()));
    }
}
