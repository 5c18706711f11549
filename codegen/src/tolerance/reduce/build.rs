//! The program of a model.

use dalembert_model::equations::chain::MomentBody;
use dalembert_model::equations::matrix::scaled;
use dalembert_model::number::parse::parse_decimal;
use dalembert_model::number::{Exact, Rational};
use dalembert_model::scalar::Scalar;

use super::fit::Solution;
use super::terms::{Terms, nothing, traced};
use crate::dag::{Builder as GraphBuilder, Dag, Folding};
use crate::program::Program;
use crate::search::{Effort, cost, search};
use crate::seeds::start::Tuning;
use crate::seeds::{regrouped, skeleton, tuned};
use crate::setup::{FittedLink, Setup};

pub(super) struct ReducedModel<'a> {
    pub setup: &'a Setup,
    pub exact: &'a Program,
    pub terms: &'a Terms,
}

impl ReducedModel<'_> {
    pub(super) fn price(&self, terms: &[usize]) -> u64 {
        let factors: Vec<f64> = (0..terms.len()).map(|k| 1.37 + 0.1709 * k as f64).collect();
        let fitted = self.fitted(terms, &factors);
        traced(&fitted, self.exact.function).map_or(u64::MAX, |graph| cost(&graph))
    }

    pub(super) fn program(&self, model: &Solution) -> Option<Program> {
        let fitted = self.fitted(&model.terms, &model.factors);
        let (function, effort) = (self.exact.function, Effort::Quick);
        let forms = function.forms();
        let task = fitted.task(function);
        let tuned = tuned(&Tuning::new(task, effort), &forms);
        let seeds = regrouped(task, &forms, &tuned);
        let graphs: Vec<Dag> = seeds.into_iter().map(|seed| seed.graph).collect();
        let best = search(&graphs, &[], &|n| effort.limits(n), &|_| true, &|_, _| true)?;
        let small = task.program(&best.graph);
        let mut builder = GraphBuilder::new(Folding::Semantic);
        let values = builder.results(&small.dag);
        let mut outputs = vec![builder.zero(); self.exact.dag.outputs.len()];
        for (&output, value) in self.terms.outputs.iter().zip(values) {
            outputs[output] = value;
        }
        Some(self.exact.with_graph(&builder.finish(outputs)))
    }

    fn fitted(&self, terms: &[usize], factors: &[f64]) -> Setup {
        let mut links = nothing(&skeleton(self.setup));
        for (&term, &factor) in terms.iter().zip(factors) {
            let term = &self.terms.all[term];
            add(&mut links[term.link], &term.unit, &five_digits(factor));
        }
        let outputs = self.terms.outputs.iter();
        let rows: Vec<usize> = outputs.map(|&output| self.exact.rows[output]).collect();
        self.setup.fitted(links, &rows)
    }
}

fn add(link: &mut FittedLink, unit: &FittedLink, factor: &Exact) {
    let body = MomentBody {
        mass: unit.body.mass.mul(factor),
        first: scaled(factor, &unit.body.first),
        second: unit.body.second.map(|x| x.mul(factor)),
    };
    link.body = link.body.with(&body);
    link.armature = link.armature.add(&unit.armature.mul(factor));
    link.viscous = link.viscous.add(&unit.viscous.mul(factor));
}

/// Rounds to five digits: a factor is fitted to samples.
fn five_digits(x: f64) -> Exact {
    let digits: Rational = parse_decimal(&format!("{x:.4e}")).unwrap_or_default();
    Exact::from(digits)
}
