//! The coefficients of the dynamics that vanish or repeat.
//!
//! D_ik, h_ikm and c_i are outputs of one graph that was merged by
//! fingerprint: an output that vanishes is the constant zero there, and two
//! that are equal or opposite are edges to one node.

use std::collections::HashMap;

use dalembert_model::equations::Formulation;
use dalembert_model::robot::Robot;

use dalembert_codegen::Function;
use dalembert_codegen::workspace::{
    Folding, MAX_OUTPUTS, Node, Quantity, SceneRobot, Sizes, trace,
};

/// The value of a coefficient.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Value {
    /// Zero in every state.
    Zero,
    /// The same in every state, and not zero.
    Constant,
    /// A function of the state, equal or opposite to none before it.
    Distinct,
    /// Equal to a coefficient before it.
    Equals(String),
    /// The opposite of a coefficient before it.
    OppositeOf(String),
}

/// One coefficient: D_ik with i ≤ k, h_ikm with k ≤ m, or c_i.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Coupling {
    /// Its name, one-based: `h_346`.
    pub name: String,
    /// Its value.
    pub value: Value,
    /// Inertia, Christoffel or Gravity.
    pub quantity: Quantity,
}

/// Lists the coefficients of a robot: D, then h, then c, each in the order of its indices;
/// `None` if it has too many joints.
pub fn couplings(robot: &Robot) -> Option<Vec<Coupling>> {
    let function = Function::DynamicCoefficients;
    let n = robot.joints.len();
    let sizes = Sizes::whole(n);
    if function.outputs(sizes) > MAX_OUTPUTS {
        return None;
    }
    // Equal functions have equal fingerprints, whichever formulation is traced. Written out,
    // Lagrange–Euler grows out of hand first.
    let formulation = match n {
        0..=6 => Formulation::LagrangeEuler,
        _ => Formulation::NewtonEulerLink,
    };
    let graph = trace(&SceneRobot::whole(robot), function, formulation)
        .graph
        .rebuild(Folding::Semantic);
    let mut outputs = graph.outputs.iter();
    let mut couplings = Vec::new();
    let mut known = HashMap::new();
    for &quantity in function.quantities() {
        let edges = outputs.by_ref().take(quantity.len(sizes)).enumerate();
        for (index, &edge) in edges.filter(|(index, _)| is_first(quantity, *index, n)) {
            let name = quantity.entry(index, sizes);
            let negative = edge.is_negative();
            let value = if graph.is_zero(edge) {
                Value::Zero
            } else if let Some((other, sign)) = known.get(&(quantity, edge.node())) {
                match *sign == negative {
                    true => Value::Equals(String::clone(other)),
                    false => Value::OppositeOf(String::clone(other)),
                }
            } else {
                known.insert((quantity, edge.node()), (name.clone(), negative));
                match graph.node(edge.node()) {
                    Node::Constant(_) => Value::Constant,
                    _ => Value::Distinct,
                }
            };
            couplings.push(Coupling {
                name,
                value,
                quantity,
            });
        }
    }
    Some(couplings)
}

/// Counts the coefficients of one quantity, symmetric ones once: all, those that vanish, and the others,
/// equal and opposite ones once.
pub fn summary(couplings: &[Coupling], quantity: Quantity) -> [usize; 3] {
    let mut summary = [0; 3];
    for own in couplings.iter().filter(|own| own.quantity == quantity) {
        summary[0] += 1;
        match own.value {
            Value::Zero => summary[1] += 1,
            Value::Constant | Value::Distinct => summary[2] += 1,
            Value::Equals(_) | Value::OppositeOf(_) => {}
        }
    }
    summary
}

/// Returns whether an entry of a symmetric quantity is the one whose last two indices ascend.
fn is_first(quantity: Quantity, index: usize, n: usize) -> bool {
    quantity == Quantity::Gravity || index / n % n <= index % n
}
