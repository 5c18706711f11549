//! The cheapest regrouping for a function: from where to descend, and by which price.

use std::cell::Cell;

use dalembert_model::equations::chain::{Chain, Regrouping};
use dalembert_model::equations::matrix::zero_vector;
use dalembert_model::number::Exact;

use super::chain::{merged, skeleton_for};
use super::start::Tuning;
use super::tune::{self, ChainChoice};
use super::{Form, MAX_QUICK_LINKS};
use crate::dag::Dag;
use crate::search::{Effort, cost, glance};
use crate::setup::Task;
use crate::watch::Part;

/// The starts of longer chains are compared without a round of the search.
const MAX_TRIED: usize = 3;

/// The error of a program over the error that is allowed: at most one where it
/// is admitted. At or above the bound, which is the second argument, it need not be exact.
pub(crate) type Limit<'a> = &'a dyn Fn(&Dag, f64) -> f64;

/// Above every price of an admitted program. A refused program is compared by
/// its error, so that a descent from there first goes where it is admitted.
const REFUSED: u64 = 1 << 48;

fn price(graph: &Dag, limit: Option<Limit<'_>>, below: u64) -> u64 {
    let cost = cost(graph);
    let Some(limit) = limit.filter(|_| cost < below) else {
        return cost;
    };
    // A refused one loses to all that are admitted, and to those refused for less.
    let bound = match below.checked_sub(REFUSED) {
        None => 1.0,
        Some(refused) => (refused as f64 / 1e6).max(1.0),
    };
    match limit(graph, bound.next_up()) {
        admitted if admitted <= 1.0 => cost,
        refused => REFUSED + (refused * 1e6) as u64,
    }
}

pub(crate) fn tuned(problem: &Tuning<'_>, forms: &[Form]) -> ChainChoice {
    tunings(problem, forms).0
}

/// Returns the regrouping that a descent from base parameters ends at. One link at a time it does
/// not get to frames whose origins are all beside those of the links that carry them: also returns
/// where a descent from there ends, if that is cheaper before the search. After it either may be.
pub(crate) fn tunings(problem: &Tuning<'_>, forms: &[Form]) -> (ChainChoice, Option<ChainChoice>) {
    let (task, effort, limit) = (problem.task, problem.effort, problem.limit);
    let Task { setup, function } = task;
    let arm = skeleton_for(task);
    let tried = Cell::new(0);
    let is_over_after_step = || {
        tried.set(tried.get() + 1);
        let rounds = [tried.get(), 0];
        problem.watch.step(Part::Formulations, rounds, None);
        problem.watch.is_over()
    };
    let traced_price = |chain: &Chain<Exact>, form: Form, below: u64| {
        price(&merged(task, chain, form), limit, below)
    };
    // The cheapest regrouping before a search need not be the cheapest after it.
    let quick_price = |chain: &Chain<Exact>, form: Form, below: u64| match is_over_after_step() {
        true => u64::MAX,
        false => price(&glance(&merged(task, chain, form)), limit, below),
    };
    if setup.takes_load(function)
        && let Some(load) = setup.load()
    {
        // The numbers of the load are those of one regrouping, for all functions.
        let choice = tune::tune(&arm, load.regrouping.clone(), forms, 0, traced_price);
        return (choice, None);
    }
    let start = tune::start(&arm);
    let with = |axes: Vec<i32>| {
        let mut from = start.clone();
        for (link, axes) in from.links.iter_mut().zip(axes) {
            link.axes = axes;
        }
        from
    };
    let chain = Chain::new(&arm, &start);
    let mut starts: Vec<Regrouping<Exact>> = starts(&chain).into_iter().map(with).collect();
    if effort == Effort::Quick && starts.len() > 1 {
        // One descent: from where the others look dearer already. For a short chain
        // a round of the search is cheap, and tells more than the folded formula. For a tree the
        // formula tells less: its limbs need not be alike.
        starts.sort_by_cached_key(|from| {
            let chain = Chain::new(&arm, from);
            match arm.links.len() <= MAX_TRIED {
                true => quick_price(&chain, forms[0], u64::MAX),
                false => traced_price(&chain, forms[0], u64::MAX),
            }
        });
        starts.truncate(if chain.is_serial() { 1 } else { 2 });
    }
    let beside = starts.first().map(with_zero_origins);
    starts.extend_from_slice(problem.from);
    let watched_price = |chain: &Chain<Exact>, form: Form, below: u64| match is_over_after_step() {
        true => u64::MAX,
        false => traced_price(chain, form, below),
    };
    let rounds = if effort == Effort::Quick { 1 } else { 3 };
    let descend = |from: Regrouping<Exact>| {
        let mut choice = tune::tune(&arm, from, forms, rounds, watched_price);
        choice.price = quick_price(&Chain::new(&arm, &choice.regrouping), choice.form, u64::MAX);
        choice
    };
    let choices = starts.into_iter().map(descend);
    let cheapest = choices.min_by_key(|choice| choice.price);
    let mut tuned = cheapest.unwrap_or(ChainChoice {
        regrouping: start,
        form: forms[0],
        price: u64::MAX,
    });
    let mut second = beside.map(descend);
    second = second.filter(|second| second.price < tuned.price);
    if effort == Effort::Thorough && arm.links.len() <= MAX_QUICK_LINKS && !is_over_after_step() {
        let finished = |choice: ChainChoice| {
            tune::tune(&arm, choice.regrouping, &[choice.form], 2, quick_price)
        };
        (tuned, second) = (finished(tuned), second.map(finished));
    }
    (tuned, second)
}

pub(crate) fn with_zero_origins(from: &Regrouping<Exact>) -> Regrouping<Exact> {
    let mut from = from.clone();
    for link in &mut from.links {
        link.origin = zero_vector();
    }
    from
}

/// Each link's own axes; the last link's before it turns; those before each group.
fn starts(chain: &Chain<Exact>) -> Vec<Vec<i32>> {
    let n = chain.links.len();
    let freedoms = chain.freedoms();
    let before: Vec<i32> = freedoms.iter().map(|[less, _]| *less).collect();
    let mut last = vec![0; n];
    if n > 0 {
        last[n - 1] = before[n - 1].max(-1);
    }
    let mut starts = vec![vec![0; n]];
    for axes in [last, before] {
        if !starts.contains(&axes) {
            starts.push(axes);
        }
    }
    starts
}
