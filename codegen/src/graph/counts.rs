//! Operation counts of a graph.

use std::collections::BTreeSet;

use super::{Graph, Node};
use crate::program::{AngleSum, Counts};

impl Graph {
    /// Returns what the outputs cost.
    pub fn counts(&self) -> Counts {
        let mut counts = Counts::default();
        for (node, live) in self.nodes.iter().zip(self.live()) {
            match node {
                _ if !live => {}
                Node::Sum(..) | Node::Difference(..) => counts.add += 1,
                Node::Product(..) => counts.mul += 1,
                Node::Quotient(..) => counts.div += 1,
                Node::Input(_) | Node::Constant(_) => {}
            }
        }
        let angles = self.angles();
        counts.sincos = angles.len();
        counts.add += angles.iter().map(|angle| angle.additions()).sum::<usize>();
        counts
    }

    /// Returns the angles whose sine or cosine the outputs need.
    pub fn angles(&self) -> BTreeSet<AngleSum> {
        let nodes = self.nodes.iter().zip(self.live());
        let live = nodes.filter_map(|(node, live)| live.then_some(node));
        let inputs = live.filter_map(|node| match node {
            Node::Input(input) => input.angle(),
            _ => None,
        });
        inputs.collect()
    }
}
