//! The largest value and the largest adjoints of every operation over a box.
//!
//! Each is a trigonometric polynomial of its own and bounded as such: what
//! cancels is gone, which intervals would not see.

use std::cell::RefCell;
use std::rc::Rc;

use dalembert_model::scalar::Scalar;

use crate::bound::expand::visit;
use crate::bound::grid::{self, Aim, GridEffort};
use crate::bound::input_box::InputBox;
use crate::dag::symbol::Symbol;
use crate::dag::{Builder, Dag, Edge, Folding, Id, Node};
use crate::program::{Input, Program};

/// How close a bound is to come to a value that is taken: sums of products of
/// two of them are what counts.
const CLOSE: f64 = 0.1;

/// Polynomials that may have all their points; more share what these have, until
/// it is too little to look at angles at all.
const FULL: usize = 2048;
const FEWEST: usize = 64;

const STARTS: usize = 2;

#[derive(Clone, Debug)]
pub(super) struct Extremes {
    pub values: Vec<f64>,
    /// For each output and each operation, sine and cosine; zero where the output does not depend
    /// on it.
    pub adjoints: Vec<Vec<f64>>,
}

impl Extremes {
    pub(super) fn new(program: &Program, limits: &InputBox, points: usize) -> Option<Extremes> {
        let (graph, rows) = gradient(program);
        let sliding = grid::sliding(&graph, limits.joints());
        let each = points.min(FULL * points / graph.outputs.len().max(1));
        let closeness = GridEffort {
            points: if each < FEWEST { 0 } else { each },
            close: CLOSE,
            starts: STARTS,
        };
        let mut most = vec![Some(0.0); graph.nodes.len()];
        visit(&graph, limits, &mut |node, polynomial| {
            let harmonics = grid::harmonics(polynomial, limits.joints());
            most[node] = harmonics.map(|harmonics| {
                grid::magnitude(harmonics, limits, &sliding, Aim::Least, closeness)
            });
        })?;
        let most: Vec<f64> = most.into_iter().collect::<Option<_>>()?;
        let by_node = |own: &Vec<(Id, Edge)>| {
            let mut all = vec![0.0; program.dag.nodes.len()];
            for (id, edge) in own {
                all[*id as usize] = most[edge.index()];
            }
            all
        };
        let mut rows = rows.iter().map(by_node);
        Some(Extremes {
            values: rows.next()?,
            adjoints: rows.collect(),
        })
    }
}

/// The values come first, then the derivatives output by output; each has the node that it is of.
fn gradient(program: &Program) -> (Dag, Vec<Vec<(Id, Edge)>>) {
    let builder = Rc::new(RefCell::new(Builder::new(Folding::Syntactic)));
    let dag = &program.dag;
    let input = |input| Symbol::input(&builder, input);
    let values = dag.values(&(Symbol::constant, input));
    let operations = dag.operations();
    let operations = operations.map(|(id, ..)| (id, values[id as usize].clone()));
    let mut rows: Vec<Vec<(Id, Symbol)>> = vec![operations.collect()];
    let mut adjoints = Vec::new();
    for output in &dag.outputs {
        dag.adjoints(output.node, &values, &mut adjoints);
        let own = adjoints.iter().zip(&dag.nodes).enumerate().rev();
        let own = own.filter(|(_, (adjoint, node))| !adjoint.is_zero() && errs(node));
        let own = own.map(|(index, (adjoint, _))| (index as Id, adjoint.clone()));
        rows.push(own.collect());
    }
    let edge = |(id, value): &(Id, Symbol)| (*id, value.edge(&mut builder.borrow_mut()));
    let rows = rows.iter().map(|row| row.iter().map(edge).collect());
    let rows: Vec<Vec<(Id, Edge)>> = rows.collect();
    let outputs = rows.iter().flatten().map(|(_, edge)| *edge).collect();
    let builder = builder.replace(Builder::new(Folding::Syntactic));
    (builder.finish(outputs), rows)
}

fn errs(node: &Node) -> bool {
    match node {
        Node::Apply(..) | Node::Input(Input::Sin(_) | Input::Cos(_)) => true,
        Node::Constant(_) | Node::Input(_) => false,
    }
}
