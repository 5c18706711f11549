//! The exact program to prune: in the regrouping that leaves least.
//!
//! The smallest exact program shares so much that every value matters to many outputs, and its
//! regrouping makes entries vanish that a tolerance would drop anyway. A descent over the
//! regroupings, link by link as for the exact program, but by what is left after pruning, finds a
//! better one. Prices are of samples; what comes out is an equal program like any other, and
//! whoever uses it shows that again.

use dalembert_model::equations::chain::Regrouping;
use dalembert_model::number::Exact;

use crate::approximate::prune::{PruneSettings, Target, appraise};
use crate::parallel;
use crate::program::Program;
use crate::search::{Effort, search};
use crate::seeds;
use crate::seeds::start::Problem;
use crate::setup::Setup;
use crate::watch::Part;

/// The samples, and the share of the allowances that errors may use: of a look at every regrouping,
/// and of a closer one at a few. The fewer the samples, the more they miss.
const LOOKS: [(usize, f64); 2] = [(16, 0.45), (40, 0.7)];

const CLOSER: usize = 12;

pub(super) fn descend(setup: &Setup, target: Target<'_>) -> Option<Program> {
    let Target {
        exact,
        settings,
        watch,
        ..
    } = target;
    if settings.sweeps == 0 || seeds::skeleton(setup).links.is_empty() {
        return None;
    }
    let quick = |operations| Effort::Quick.limits(operations);
    let (task, forms) = (setup.task(exact.function), exact.function.forms());
    let problem = Problem {
        watch,
        ..Problem::new(task, Effort::Thorough)
    };
    let tuned = seeds::tuned(&problem, &forms);
    let mut best: Option<(Regrouping<Exact>, Program)> = None;
    let mut least = price(target, exact, LOOKS[1]);
    for round in 0..settings.sweeps {
        let counts = best.as_ref().map(|(_, program)| program.counts());
        watch.step(Part::Omissions, [round, settings.sweeps], counts);
        let from = best
            .as_ref()
            .map_or(&tuned.regrouping, |(regrouping, _)| regrouping);
        let mut regroupings = seeds::neighbours(task, from);
        if round == 0 {
            regroupings.insert(0, from.clone());
        }
        let looks = parallel::each(&regroupings, |regrouping| {
            if watch.is_over() {
                return None;
            }
            let graph = seeds::in_regrouping(task, regrouping, tuned.form);
            let graph = search(&[graph], &[], &quick, &|_| true, &|_, _| true)?.graph;
            let program = exact.with_graph(&graph);
            Some((price(target, &program, LOOKS[0]), regrouping, program))
        });
        let mut looks: Vec<_> = looks.into_iter().flatten().collect();
        looks.sort_by_key(|look| look.0);
        looks.truncate(CLOSER);
        let prices = parallel::each(&looks, |(_, _, program)| price(target, program, LOOKS[1]));
        let pairs = prices.into_iter().zip(looks);
        let Some((found, (_, regrouping, program))) = pairs.min_by_key(|pair| pair.0) else {
            break;
        };
        if found >= least {
            break;
        }
        (least, best) = (found, Some((regrouping.clone(), program)));
    }
    best.map(|(_, program)| program)
}

fn price(target: Target<'_>, exact: &Program, (samples, share): (usize, f64)) -> u32 {
    if target.watch.is_over() {
        return u32::MAX;
    }
    let allowances: Vec<f64> = target.allowances.iter().map(|a| share * a).collect();
    let settings = PruneSettings {
        samples,
        alike: 0,
        ..*target.settings
    };
    let target = Target {
        exact,
        allowances: &allowances,
        settings: &settings,
        ..target
    };
    appraise(target, exact)
}
