//! A function's program: from the plan, or searched for.

use dalembert_model::equations::chain::Regrouping;
use dalembert_model::number::Exact;

use super::{GenerateError, Task};
use crate::function::Function;
use crate::graph::Graph;
use crate::plan::Entry;
use crate::portfolio::start::{Approach, Problem};
use crate::portfolio::tune::Tuned;
use crate::portfolio::{self, Limit, Source, Variant};
use crate::program::{Counts, Program, ScalarType};
use crate::scene::{ParametersKey, SceneKey};
use crate::simplify::{self, Effort, Pass, Simplified};
use crate::verify::accuracy::{AccuracyFilter, Refused};
use crate::watch::{FunctionWatch, Part};

/// Returns the plan's program, the first requested scalar's that it has.
pub fn replay<'a>(task: &Task<'a>, function: Function) -> Result<Option<&'a Entry>, GenerateError> {
    let Task {
        scene_robot,
        request,
        ..
    } = *task;
    let Some(plan) = &request.plan else {
        return Ok(None);
    };
    // Its definition: nothing was searched for.
    if function == Function::Load {
        return Ok(None);
    }
    let scene = scene_robot.scene();
    let parameters = ParametersKey::of(scene_robot, function);
    let find = |scene| {
        let mut scalars = request.scalars.iter();
        let found = |&scalar: &ScalarType| {
            plan.find(function, request.start, scalar, scene, parameters.as_ref())
        };
        // Of other numbers of the load it is the program of another function.
        let same = |entry: &&Entry| entry.parameters == parameters;
        scalars.find_map(found).filter(same)
    };
    let found = find(scene);
    // A box or a tolerance by itself leaves the equations as they are.
    if found.is_none() && scene_robot.has_whole_model() {
        return Ok(find(None));
    }
    match (found, scene) {
        // A program of the scene as it was is a program of another scene.
        (Some(entry), Some(scene)) if entry.scene != Some(SceneKey::of(scene)) => {
            Err(GenerateError::StaleScene {
                scene: scene.name.clone(),
            })
        }
        _ => Ok(found),
    }
}

/// Searches for a program.
pub(super) fn found(
    task: &Task<'_>,
    function: Function,
) -> Result<(Source, Vec<Pass>, Program, Option<Refused>), GenerateError> {
    let found = search(task, function)?;
    let (seed, simplified) = (&found.variants[found.simplified.seed], &found.simplified);
    let mut passes = vec![Pass {
        name: "traced",
        counts: seed.traced,
    }];
    passes.extend(simplified.passes.iter().cloned());
    let program = Program::in_scene(task.scene_robot, function, &simplified.graph);
    passes.push(Pass {
        name: "final",
        counts: program.counts(),
    });
    Ok((seed.source, passes, program, found.refused))
}

/// What a search found, and from what.
pub struct Found {
    /// The regrouping of the regrouped variants, if there are such.
    pub tuned: Option<Tuned>,
    /// What it started from.
    pub variants: Vec<Variant>,
    /// Its program, and those on the way.
    pub simplified: Simplified,
    /// What would be cheaper, but for its rounding error.
    pub refused: Option<Refused>,
}

/// Searches for the cheapest program.
///
/// A thorough search contains the quick one: it is never dearer.
pub fn search(task: &Task<'_>, function: Function) -> Result<Found, GenerateError> {
    let search = Search {
        task: *task,
        function,
        judge: match task.is_lenient() {
            true => AccuracyFilter::lenient(task.scene_robot, function),
            false => AccuracyFilter::new(task.scene_robot, function),
        },
    };
    let watch = task.request.watch.over(function);
    // Who wants an end before a function's turn gets the quick search for it.
    if watch.is_over() {
        return search.quick(None);
    }
    let tell = |part, best| watch.step(part, [0, 1], best);
    tell(Part::Formulations, None);
    // Nobody ends the quick search inside a thorough one: that is at least as good.
    let is_quick = task.request.effort == Effort::Quick;
    let quick = search.quick(is_quick.then_some(watch))?;
    if is_quick || watch.is_over() {
        tell(Part::Proof, Some(quick.simplified.graph.counts()));
        return Ok(quick);
    }
    tell(Part::Formulations, Some(quick.simplified.graph.counts()));
    let mut found = search.run(Effort::Thorough, true, &[], Some(watch))?;
    if found.cost() > quick.cost() {
        found = quick;
    } else {
        found.refused = quick
            .refused
            .and_then(|refused| search.refused(refused.counts, refused.error, &found));
    }
    tell(Part::Proof, Some(found.simplified.graph.counts()));
    Ok(found)
}

struct Search<'a> {
    task: Task<'a>,
    function: Function,
    judge: AccuracyFilter<'a>,
}

impl Search<'_> {
    /// Returns the quick search: without a limit first, since most robots need none.
    /// Where that costs too many digits, again within the limit, also from
    /// where the other one ended.
    fn quick(&self, watch: Option<FunctionWatch<'_>>) -> Result<Found, GenerateError> {
        let free = self.run(Effort::Quick, false, &[], watch)?;
        if self.judge.accepts(&free.simplified.graph) {
            return Ok(free);
        }
        let from: Vec<Regrouping<Exact>> =
            free.tuned.iter().map(|t| t.regrouping.clone()).collect();
        let mut found = self.run(Effort::Quick, true, &from, watch)?;
        let graph = &free.simplified.graph;
        let error = self.judge.error(graph);
        // The limit holds for every result: what breaks it for one may be cheaper and have a
        // smaller largest error than what keeps it for all.
        if free.cost() <= found.cost() && error < self.judge.error(&found.simplified.graph) {
            return Ok(free);
        }
        found.refused = self.refused(graph.counts(), error, &found);
        Ok(found)
    }

    /// Returns a refused program, worth a word only where it is cheaper.
    fn refused(&self, counts: Counts, error: f64, taken: &Found) -> Option<Refused> {
        let graph = &taken.simplified.graph;
        let is_cheaper = counts.operations() < graph.counts().operations();
        is_cheaper.then(|| Refused {
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
        watch: Option<FunctionWatch<'_>>,
    ) -> Result<Found, GenerateError> {
        let (scene_robot, function) = (self.task.scene_robot, self.function);
        let start = self.task.request.start;
        let excess = |graph: &Graph, bound| self.judge.excess(graph, bound);
        let limit: Option<Limit<'_>> = limited.then_some(&excess);
        let approaches = start.approaches(&Problem {
            scene_robot,
            function,
            effort,
            without: self.task.request.without,
            limit,
            from,
            watch,
        });
        let found = approaches
            .into_iter()
            .filter_map(|approach| self.from(approach, effort, limited, watch));
        // The first of the cheapest, of those that are accurate enough if there are such.
        let refused = |found: &Found| limited && !self.judge.accepts(&found.simplified.graph);
        found
            .min_by_key(|found| (refused(found), found.cost()))
            .ok_or(GenerateError::Empty)
    }

    fn from(
        &self,
        approach: Approach,
        effort: Effort,
        limited: bool,
        watch: Option<FunctionWatch<'_>>,
    ) -> Option<Found> {
        let (scene_robot, function) = (self.task.scene_robot, self.function);
        let start = self.task.request.start;
        let Approach {
            tuned,
            variants,
            others,
        } = approach;
        let graphs: Vec<Graph> = variants.iter().map(|v| v.graph.clone()).collect();
        let mut helpers = others;
        helpers.extend(start.helpers(scene_robot));
        if let Some(tuned) = &tuned
            && effort == Effort::Thorough
        {
            helpers.extend(portfolio::neighbours(scene_robot, function, tuned));
        }
        let without = self.task.request.without;
        let accept = |graph: &Graph| !limited || self.judge.accepts(graph);
        let simplified = simplify::watched(&graphs, &helpers, effort, without, &accept, watch);
        Some(Found {
            tuned,
            variants,
            simplified: simplified?,
            refused: None,
        })
    }
}

impl Found {
    fn cost(&self) -> u64 {
        simplify::cost(&self.simplified.graph)
    }
}
