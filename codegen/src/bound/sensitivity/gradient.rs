//! The program of all adjoints of a program.

use std::cell::RefCell;
use std::rc::Rc;

use dalembert_model::scalar::Scalar;

use crate::dag::symbol::Symbol;
use crate::dag::{Builder, Dag, Edge, Folding, Id, Node};
use crate::program::{Input, Program};

/// A graph with the value of each operation and, output by output, the derivatives
/// of the output with respect to them: all of them its outputs.
pub(super) struct Gradient {
    pub graph: Dag,
    /// The value of each operation, in the graph.
    pub values: Vec<(Id, Edge)>,
    /// The derivatives of each output, with respect to each operation, sine and cosine that it
    /// depends on.
    pub adjoints: Vec<Vec<(Id, Edge)>>,
}

impl Gradient {
    /// Differentiates every output of a program.
    pub(super) fn new(program: &Program) -> Gradient {
        let builder = Rc::new(RefCell::new(Builder::new(Folding::Syntactic)));
        let dag = &program.dag;
        let input = |input| Symbol::input(&builder, input);
        let values = dag.values(&(Symbol::constant, input));
        let mut adjoints = Vec::new();
        let mut derivatives = Vec::with_capacity(dag.outputs.len());
        for output in &dag.outputs {
            dag.adjoints(output.node, &values, &mut adjoints);
            let own = adjoints.iter().zip(&dag.nodes).enumerate().rev();
            let own = own.filter(|(_, (adjoint, node))| !adjoint.is_zero() && errs(node));
            let own = own.map(|(index, (adjoint, _))| (index as Id, adjoint.clone()));
            derivatives.push(own.collect::<Vec<_>>());
        }
        let edge = |(id, value): &(Id, Symbol)| (*id, value.edge(&mut builder.borrow_mut()));
        let operations = dag.operations();
        let values = operations.map(|(id, ..)| edge(&(id, values[id as usize].clone())));
        let values: Vec<_> = values.collect();
        let adjoints = derivatives.iter().map(|own| own.iter().map(edge).collect());
        let adjoints: Vec<Vec<_>> = adjoints.collect();
        let edges = values.iter().chain(adjoints.iter().flatten());
        let outputs = edges.map(|(_, edge)| *edge).collect();
        let builder = builder.replace(Builder::new(Folding::Syntactic));
        Gradient {
            graph: builder.finish(outputs),
            values,
            adjoints,
        }
    }
}

/// Returns whether a node may be off by more than its literal: operations, sines and cosines.
fn errs(node: &Node) -> bool {
    match node {
        Node::Apply(..) | Node::Input(Input::Sin(_) | Input::Cos(_)) => true,
        Node::Constant(_) | Node::Input(_) => false,
    }
}
