//! Steps in vain: steps that no result depends on.
//!
//! Regrouping shares sums whose common part cancels later. Every result's derivative by such a part
//! is zero, so zero may take its place: fewer operations, and fewer digits are lost. In the place of
//! a factor by which a whole quotient is scaled, one may stand.

use std::array::from_fn;

use dalembert_model::number::Exact;
use dalembert_model::scalar::Scalar;
use dalembert_model::scalar::field::Field;
use rustc_hash::FxHashMap;

use super::{Builder, Dag, Fingerprint, Folding, Lanes, Node, Points};
use crate::random::Random;

const SEED: u64 = 0x7a1e;

impl Dag {
    /// Drops steps without effect on the results and merges equal ones, both told by
    /// fingerprints; returns the graph itself if it has neither.
    #[must_use]
    pub(crate) fn without_vain_steps(&self) -> Dag {
        let results = self.result_prints();
        let is_same = |dag: &Dag| dag.result_prints() == results;
        let mut best = self.clone();
        loop {
            let vain = best.vain_steps();
            let zero = Exact::zero();
            let mut next = best.with(&vain, &zero);
            if !is_same(&next) {
                // Two of them may matter together, though none does alone.
                let one = Exact::one();
                let mut alone = [&zero, &one]
                    .into_iter()
                    .flat_map(|value| vain.iter().map(move |step| (step, value)));
                let mut candidate = None;
                while let (None, Some((step, value))) = (&candidate, alone.next()) {
                    candidate = Some(best.with(&[*step], value)).filter(is_same);
                }
                next = candidate.unwrap_or_else(|| best.with(&[], &zero));
            }
            if next.counts().operations() >= best.counts().operations() || !is_same(&next) {
                return best;
            }
            best = next;
        }
    }

    /// True if no step is in vain, and none has a value that another one has, or an operand has, but
    /// for its sign: where a program divides, the checker refuses these. Operations of one `row` may
    /// have the same value.
    pub(crate) fn has_needed_steps_alone(&self, row: impl Fn(usize) -> usize) -> bool {
        let prints = self.prints();
        let mut rows = FxHashMap::default();
        let mut operations = 0;
        let is_new = |(index, node): (usize, &Node)| {
            let value = prints[index].canonical().0;
            if node.operands().is_none() {
                rows.insert(value, usize::MAX);
                return true;
            }
            let row = row(operations);
            operations += 1;
            *rows.entry(value).or_insert(row) == row
        };
        self.live().all(is_new) && self.vain_steps().is_empty()
    }

    fn prints(&self) -> Vec<Fingerprint> {
        let points = Points::SEARCH;
        let constant = |constant: &Exact| points.constant(constant).unwrap_or_else(Scalar::zero);
        self.values(&(constant, |input| points.input(input)))
    }

    pub(crate) fn result_prints(&self) -> Vec<Fingerprint> {
        self.results(&self.prints())
    }

    /// Lists the operations by which a random combination of all results has no derivative.
    fn vain_steps(&self) -> Vec<usize> {
        let values = self.prints();
        let mut random = Random::new(SEED);
        let mut adjoints = vec![Fingerprint::zero(); values.len()];
        for edge in &self.outputs {
            let weight = Lanes(from_fn(|_| Field::new(random.bits())));
            let adjoint = &mut adjoints[edge.index()];
            *adjoint = adjoint.add(&weight);
        }
        self.pass_back(&values, &mut adjoints);
        let is_vain = |index: &usize| adjoints[*index] == Fingerprint::zero();
        let operations = self.live().filter(|(_, node)| node.operands().is_some());
        operations.map(|(index, _)| index).filter(is_vain).collect()
    }

    fn with(&self, steps: &[usize], value: &Exact) -> Dag {
        let mut builder = Builder::new(Folding::Semantic);
        // Leaves first: a step that equals one is replaced by it.
        for (_, node) in self.live() {
            match node {
                Node::Constant(constant) => builder.constant(constant),
                Node::Input(input) => builder.input(*input),
                Node::Apply(..) => continue,
            };
        }
        let mut dag = self.clone();
        for &step in steps {
            dag.nodes[step] = Node::Constant(value.clone());
        }
        let outputs = builder.results(&dag);
        builder.finish(outputs).rebuild(Folding::Syntactic)
    }
}
