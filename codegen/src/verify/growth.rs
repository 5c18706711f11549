//! The sizes of results for all that intervals know of sines: the checker bounds rounding by them.
//! An axis as the product of two others, whose axes are such products themselves, is exact and
//! accurate, but its size in intervals is squared again and again.

use dalembert_model::number::Rounded;

use crate::dag::{Dag, Node, Operation};

/// A result may be so many times as large as in the graphs that the program was found from.
const MOST: f64 = 32768.0;

/// The least size of each result among several graphs of a function.
pub(crate) struct Growth(Vec<f64>);

impl Growth {
    pub(crate) fn of(graphs: &[Dag]) -> Growth {
        let mut least: Vec<f64> = Vec::new();
        for graph in graphs {
            let sizes = sizes(graph);
            least.resize(sizes.len(), f64::INFINITY);
            let both = least.iter_mut().zip(sizes);
            both.for_each(|(least, size)| *least = least.min(size));
        }
        Growth(least)
    }

    pub(crate) fn admits(&self, graph: &Dag) -> bool {
        let mut both = sizes(graph).into_iter().zip(&self.0);
        both.all(|(size, least)| size <= MOST * least)
    }
}

/// Sines, rates and loads are at most one; a quotient is as large as what it divides.
fn sizes(graph: &Dag) -> Vec<f64> {
    let mut sizes: Vec<f64> = Vec::with_capacity(graph.nodes.len());
    for node in &graph.nodes {
        let size = match node {
            Node::Constant(constant) => f64::nearest(constant).abs(),
            Node::Input(_) => 1.0,
            Node::Apply(operation, operands) => {
                let [a, b] = operands.map(|id| sizes[id as usize]);
                match operation {
                    Operation::Add | Operation::Sub => a + b,
                    Operation::Mul | Operation::Fused => a * b,
                    Operation::Div => a,
                }
            }
        };
        sizes.push(size);
    }
    let outputs = graph.outputs.iter();
    outputs.map(|edge| sizes[edge.index()]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dag::{Builder, Folding};
    use crate::program::Input;

    #[test]
    fn a_cosine_by_squares_of_large_sums_is_refused() {
        let mut builder = Builder::new(Folding::Syntactic);
        let [sin, cos] = [Input::Sin(0), Input::Cos(0)].map(|input| builder.input(input));
        let mut axis = builder.add(sin, cos);
        let plain = builder.mul(axis, cos);
        for _ in 0..5 {
            axis = builder.add(axis, cos);
            axis = builder.mul(axis, axis);
        }
        let graph = builder.finish(vec![plain, axis]);
        let with = |edge| Dag {
            nodes: graph.nodes.clone(),
            outputs: vec![edge],
        };
        let growth = Growth::of(&[with(plain)]);
        assert!(growth.admits(&with(plain)));
        assert!(!growth.admits(&with(axis)));
    }
}
