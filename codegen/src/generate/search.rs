//! A function's program: from the plan, or searched for.

use dalembert_model::equations::chain::Regrouping;
use dalembert_model::number::Exact;

use super::{GenerateError, Job, Outcome, lanes};
use crate::dag::Dag;
use crate::function::Function;
use crate::plan::{Entry, Plan};
use crate::program::{Counts, Program, ScalarType};
use crate::search::{self, Effort, Pass, Searched};
use crate::seeds::start::{Approach, Start, Tuning};
use crate::seeds::{ChainChoice, Limit, Seed, Source};
use crate::setup::{ParametersKey, SceneKey, Task, input_hash};
use crate::task::Prefer;
use crate::verify::accuracy::{AccuracyFilter, RefusedProgram};
use crate::verify::exact::prove;
use crate::verify::growth::Growth;
use crate::watch::{FunctionWatch, Part};

/// Returns a plan's program, the first requested scalar's that it has.
pub fn replay(job: &Job<'_>, plan: Option<&Plan>, function: Function) -> Outcome<Option<Entry>> {
    let Job { setup, request, .. } = *job;
    // A load is its definition: nothing was searched for.
    let Some(plan) = plan.filter(|_| function != Function::Load) else {
        return Ok(None);
    };
    let scene = setup.scene();
    let parameters = ParametersKey::find(setup.task(function));
    let find = |scene| {
        let in_scalar = |&scalar: &ScalarType| {
            plan.find(function, request.start, scalar, scene, parameters.as_ref())
        };
        // With other numbers of the load it is the program of another function.
        let same = |entry: &Entry| entry.parameters == parameters;
        request.scalars.iter().find_map(in_scalar).filter(same)
    };
    let plan_entry = find(scene);
    // A box or a tolerance by itself leaves the equations as they are.
    if plan_entry.is_none() && setup.has_whole_model() {
        return Ok(find(None));
    }
    // A program of the scene as it was is a program of another scene.
    if let (Some(entry), Some(scene)) = (&plan_entry, scene)
        && entry.scene != Some(SceneKey::new(scene))
    {
        return Err(GenerateError::stale_scene(&scene.name));
    }
    Ok(plan_entry)
}

/// A program with where it comes from, its counts on the way, and what would be cheaper.
type Origin = (Source, Vec<Pass>, Program, Option<RefusedProgram>);

/// Returns the program, its limbs as lanes where that is asked for or cheaper.
pub(super) fn found_program(job: &Job<'_>, function: Function) -> Result<Origin, GenerateError> {
    let search = Search::new(job, function);
    let (source, passes, apart, refused) = search.apart()?;
    let accepts = |graph: &Dag| search.judge.accepts(graph);
    match lanes::chosen(job, function, &apart, accepts) {
        Some(side_by_side) => Ok((Source::Regrouped, passes, side_by_side, None)),
        None => Ok((source, passes, apart, refused)),
    }
}

pub struct SearchResult {
    /// The regrouping of the chain forms, if there are such.
    pub tuned: Option<ChainChoice>,
    pub seeds: Vec<Seed>,
    pub searched: Searched,
    /// A cheaper program that was refused for its rounding error.
    pub refused: Option<RefusedProgram>,
}

/// Searches for the cheapest program. A thorough search contains the quick one: it is never dearer.
pub fn search(job: &Job<'_>, function: Function) -> Result<SearchResult, GenerateError> {
    Search::new(job, function).cheapest()
}

/// Programs within 1/50 of the cheapest count as equally cheap.
const NEAR: u64 = 50;

/// A second search, within the limit, takes minutes for more operations than this; it mends single
/// results where the largest error is no larger than the textbook's.
const LARGE: usize = 4000;

struct Search<'a> {
    job: Job<'a>,
    task: Task<'a>,
    judge: AccuracyFilter<'a>,
}

impl<'a> Search<'a> {
    fn new(job: &Job<'a>, function: Function) -> Search<'a> {
        let task = job.setup.task(function);
        let is_lenient = job.request.prefer == Prefer::Operations;
        let (job, judge) = (*job, AccuracyFilter::new(task, is_lenient));
        Search { job, task, judge }
    }

    /// Goes on from the program that is renewed, which stays unless there is a cheaper one.
    fn apart(&self) -> Result<Origin, GenerateError> {
        let mut result = self.cheapest()?;
        if let Some((entry, program)) = self.renewed() {
            let again = self.renew(&entry, &program, &result);
            if let Some(again) = again.filter(|rerun| rerun.cost() < result.cost()) {
                result = again;
            }
            if search::cost(&program.dag) <= result.cost() {
                return Ok((entry.source, entry.passes, program, None));
            }
        }
        let (seed, searched) = (result.seed(), &result.searched);
        let program = self.task.program(&searched.graph);
        let counts = [
            seed.traced,
            seed.graph.counts(),
            searched.start.counts(),
            program.counts(),
        ];
        let named = Pass::NAMES.into_iter().zip(counts);
        let passes = named.map(|(name, counts)| Pass { name, counts });
        Ok((seed.source, passes.collect(), program, result.refused))
    }

    fn cheapest(&self) -> Result<SearchResult, GenerateError> {
        let request = self.job.request;
        let watch = request.watch.over(self.task.function);
        let no_watch = FunctionWatch::default();
        // A function whose turn comes after an early end gets the quick search.
        if watch.is_over() {
            return self.quick(no_watch);
        }
        let tell = |part, best| watch.step(part, [0, 1], best);
        tell(Part::Formulations, None);
        // Nobody ends the quick search inside a thorough one: that is at least as good.
        let is_quick = request.effort == Effort::Quick;
        let quick = self.quick(if is_quick { watch } else { no_watch })?;
        if is_quick || watch.is_over() {
            tell(Part::Proof, Some(quick.searched.graph.counts()));
            return Ok(quick);
        }
        tell(Part::Formulations, Some(quick.searched.graph.counts()));
        let mut result = self.run(Effort::Thorough, true, &[], watch)?;
        if self.order(&result) > self.order(&quick) {
            result = quick;
        } else if let Some(refusal) = quick.refused {
            result.refused = self.refused(refusal.counts, refusal.error, &result);
        }
        tell(Part::Proof, Some(result.searched.graph.counts()));
        Ok(result)
    }

    fn accepts(&self, result: &SearchResult) -> bool {
        self.judge.accepts(&result.searched.graph)
    }

    fn order(&self, result: &SearchResult) -> (bool, u64) {
        (!self.accepts(result), result.cost())
    }

    fn renewed(&self) -> Option<(Entry, Program)> {
        let Job { setup, request, .. } = self.job;
        let plan = request.renewed.as_ref();
        let plan = plan.filter(|plan| plan.input == input_hash(setup.robot()))?;
        let entry = replay(&self.job, Some(plan), self.task.function).ok()??;
        if !entry.program.loops.is_empty() {
            return None;
        }
        let program = entry.program.clone().with_speeds(setup.speeds());
        let is_right = prove(setup, &program).is_ok() && self.judge.accepts(&program.dag);
        is_right.then_some((entry, program))
    }

    fn renew(&self, entry: &Entry, program: &Program, best: &SearchResult) -> Option<SearchResult> {
        let again = Approach {
            tuned: best.tuned.clone(),
            seeds: vec![Seed {
                source: entry.source,
                traced: entry.passes.first()?.counts,
                graph: program.dag.clone(),
            }],
            helpers: vec![best.searched.graph.clone()],
        };
        let watch = self.job.request.watch.over(self.task.function);
        self.search_from(again, self.job.request.effort, true, watch)
    }

    /// Searches without a limit first, since most robots need none. Where that costs too many
    /// digits, again within the limit, also from where the other search ended.
    fn quick(&self, watch: FunctionWatch<'_>) -> Result<SearchResult, GenerateError> {
        let free = self.run(Effort::Quick, false, &[], watch)?;
        if self.accepts(&free) {
            return Ok(free);
        }
        let graph = &free.searched.graph;
        let error = self.judge.error(graph);
        if graph.counts().operations() > LARGE && error <= self.judge.textbook() {
            return Ok(free);
        }
        let mut same = Approach::of(free.seeds.clone());
        same.tuned.clone_from(&free.tuned);
        let again = |from| self.search_from(from, Effort::Quick, true, watch);
        let mut candidate = again(same);
        let is_near = |result: &SearchResult| {
            let most = free.cost() + free.cost() / NEAR;
            result.cost() <= most && self.accepts(result)
        };
        if !candidate.as_ref().is_some_and(is_near) {
            let tuned = free.tuned.iter();
            let from: Vec<Regrouping<Exact>> = tuned.map(|t| t.regrouping.clone()).collect();
            let other = self.run(Effort::Quick, true, &from, watch)?;
            let both = candidate.into_iter().chain([other]);
            candidate = both.min_by_key(|result| self.order(result));
        }
        let mut result = candidate.ok_or_else(GenerateError::empty)?;
        if !self.accepts(&result) {
            // All that share parameters lose digits, as beside a heavy rotor: the textbook's does not.
            let textbook = Start::textbook(self.task).and_then(again);
            let accepted = textbook.filter(|textbook| self.accepts(textbook));
            result = accepted.unwrap_or(result);
        }
        // The limit holds for every result: what breaks it for one may be cheaper and have no
        // larger largest error than what keeps it for all.
        if free.cost() <= result.cost() && error <= self.judge.error(&result.searched.graph) {
            return Ok(free);
        }
        result.refused = self.refused(graph.counts(), error, &result);
        Ok(result)
    }

    fn refused(&self, counts: Counts, error: f64, taken: &SearchResult) -> Option<RefusedProgram> {
        let graph = &taken.searched.graph;
        let is_cheaper = counts.operations() < graph.counts().operations();
        is_cheaper.then(|| RefusedProgram {
            counts,
            error,
            taken: self.judge.error(graph),
        })
    }

    fn run(
        &self,
        effort: Effort,
        limited: bool,
        from: &[Regrouping<Exact>],
        watch: FunctionWatch<'_>,
    ) -> Result<SearchResult, GenerateError> {
        let excess = |graph: &Dag, bound| self.judge.excess(graph, bound);
        let limit: Option<Limit<'_>> = limited.then_some(&excess);
        let problem = Tuning {
            limit,
            from,
            watch,
            ..Tuning::new(self.task, effort)
        };
        let search = |approach| self.search_from(approach, effort, limited, watch);
        let approaches = self.job.request.start.approaches(&problem).into_iter();
        let order = |result: &SearchResult| (limited && !self.accepts(result), result.cost());
        let result = approaches.filter_map(search).min_by_key(order);
        result.ok_or_else(GenerateError::empty)
    }

    fn search_from(
        &self,
        approach: Approach,
        effort: Effort,
        limited: bool,
        watch: FunctionWatch<'_>,
    ) -> Option<SearchResult> {
        let seeds = approach.seeds.iter();
        let graphs: Vec<Dag> = seeds.map(|seed| seed.graph.clone()).collect();
        let growth = Growth::of(&graphs);
        let accept = |graph: &Dag| !limited || self.judge.accepts(graph);
        let goes_on = |rounds: [usize; 2], best: &Dag| {
            watch.step(Part::Search, rounds, Some(best.counts()));
            !watch.is_over()
        };
        let limits = |operations| effort.limits(operations);
        let run = |accept: &dyn Fn(&Dag) -> bool| {
            search::search(&graphs, &approach.helpers, &limits, &accept, &goes_on)
        };
        let mut searched = run(&accept)?;
        // Few programs grow, and a walk that refuses all that do ends earlier.
        if !growth.admits(&searched.graph) {
            searched = run(&|graph| growth.admits(graph) && accept(graph))?;
        }
        Some(SearchResult {
            tuned: approach.tuned,
            seeds: approach.seeds,
            searched,
            refused: None,
        })
    }
}

impl SearchResult {
    pub fn seed(&self) -> &Seed {
        &self.seeds[self.searched.seed]
    }

    fn cost(&self) -> u64 {
        search::cost(&self.searched.graph)
    }
}
