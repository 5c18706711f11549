//! The coefficients of the dynamics that vanish or repeat.
//!
//! D_ik, h_ikm and c_i are outputs of one graph in which nodes with equal
//! fingerprints are merged: an output that vanishes is the constant zero, and
//! outputs that are equal or opposite are edges to one node.

use std::collections::HashMap;

use dalembert_model::equations::Formulation;
use dalembert_model::robot::Robot;

use dalembert_codegen::Function;
use dalembert_codegen::workspace::{Folding, MAX_OUTPUTS, Node, Quantity, Setup, Sizes, trace};

/// The value of a coefficient.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Value {
    /// Zero in every state.
    Zero,
    /// The same in every state, and not zero.
    Constant,
    /// A function of the state, neither equal nor opposite to an earlier coefficient.
    Distinct,
    /// Equal to an earlier coefficient.
    Equals(String),
    /// The opposite of an earlier coefficient.
    OppositeOf(String),
}

/// One coefficient: D_ik with i ≤ k, h_ikm with k ≤ m, or c_i.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Coupling {
    /// Its name, with indices from 1: `h_346`.
    pub name: String,
    /// Its value.
    pub value: Value,
    /// Inertia, Christoffel or Gravity.
    pub quantity: Quantity,
}

/// Lists the coefficients of a robot: D, then h, then c, each in the order of its indices;
/// `None` if it has too many joints, or its base floats.
pub fn couplings(robot: &Robot) -> Option<Vec<Coupling>> {
    let function = Function::DynamicCoefficients;
    let n = robot.joints.len();
    let sizes = Sizes::whole(n);
    if robot.floating.is_some() || function.outputs(sizes) > MAX_OUTPUTS {
        return None;
    }
    // Equal functions have equal fingerprints in every formulation. The graph of Lagrange–Euler
    // becomes too large first.
    let formulation = match n {
        0..=6 => Formulation::LagrangeEuler,
        _ => Formulation::NewtonEulerLink,
    };
    let rows: Vec<usize> = (0..n).collect();
    let traced = trace(Setup::whole(robot).task(function), formulation).graph;
    let graph = traced.rebuild(Folding::Semantic);
    let mut outputs = graph.outputs.iter();
    let mut couplings = Vec::new();
    let mut known = HashMap::new();
    for &quantity in function.quantities() {
        // D and h are symmetric.
        let is_first = |i: usize| quantity == Quantity::Gravity || i / n % n <= i % n;
        let edges = outputs.by_ref().take(quantity.len(sizes)).enumerate();
        for (index, &edge) in edges.filter(|(index, _)| is_first(*index)) {
            let name = quantity.entry(index, &rows, sizes);
            let negative = edge.negative;
            let value = if graph.is_zero(edge) {
                Value::Zero
            } else if let Some((other, sign)) = known.get(&(quantity, edge.node)) {
                match *sign == negative {
                    true => Value::Equals(String::clone(other)),
                    false => Value::OppositeOf(String::clone(other)),
                }
            } else {
                known.insert((quantity, edge.node), (name.clone(), negative));
                match graph.node(edge.node) {
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

/// Counts the coefficients of one quantity, symmetric ones once: all, those that vanish, and the
/// others, with equal and opposite ones counted once.
pub fn summary(couplings: &[Coupling], quantity: Quantity) -> [usize; 3] {
    let own = couplings.iter().filter(|own| own.quantity == quantity);
    let count = |is: fn(&Value) -> bool| own.clone().filter(|own| is(&own.value)).count();
    [
        count(|_| true),
        count(|value| *value == Value::Zero),
        count(|value| matches!(value, Value::Constant | Value::Distinct)),
    ]
}
