//! A function's program: from the plan, or searched for.

use super::{GenerateError, Prefer, Request, Start};
use crate::function::Function;
use crate::graph::Graph;
use crate::plan::{self, Entry};
use crate::portfolio::tune::Tuned;
use crate::portfolio::{self, Source, Sums, Variant};
use crate::scene::Setting;
use crate::schedule::Program;
use crate::simplify::{self, Effort, Simplified, Stage};
use crate::verify::accuracy::Judge;
use crate::watch::Part;

/// The plan's program, the first requested scalar's that it has.
pub(crate) fn replay<'r>(
    setting: &Setting,
    function: Function,
    request: &'r Request,
) -> Result<Option<&'r Entry>, GenerateError> {
    let Some(plan) = &request.plan else {
        return Ok(None);
    };
    let scene = setting.scene();
    let find = |scene| {
        let mut scalars = request.scalars.iter();
        scalars.find_map(|&scalar| plan.find(function, request.start, scalar, scene))
    };
    let found = find(scene);
    // A box or a tolerance by itself leaves the equations as they are.
    if found.is_none() && setting.has_whole_model() {
        return Ok(find(None));
    }
    match (found, scene) {
        // A program of the scene as it was is a program of another scene.
        (Some(entry), Some(scene)) if entry.scene != Some(plan::SceneKey::of(scene)) => {
            Err(GenerateError::StaleScene {
                scene: scene.name.clone(),
            })
        }
        _ => Ok(found),
    }
}

/// Searches for a program.
pub(super) fn found(
    setting: &Setting,
    function: Function,
    request: &Request,
) -> Result<(Source, Vec<Stage>, Program), GenerateError> {
    let found = search(setting, function, request)?;
    let (seed, simplified) = (&found.variants[found.simplified.seed], &found.simplified);
    let mut stages = vec![Stage {
        name: "traced",
        counts: seed.traced,
    }];
    stages.extend(simplified.stages.iter().cloned());
    let program = Program::in_setting(setting, function, &simplified.graph);
    stages.push(Stage {
        name: "final",
        counts: program.counts(),
    });
    Ok((seed.source, stages, program))
}

/// What a search found, and from what.
pub(crate) struct Found {
    /// The gauge of the regrouped variants, if there are such.
    pub tuned: Option<Tuned>,
    /// What it started from.
    pub variants: Vec<Variant>,
    /// Its program, and those on the way.
    pub simplified: Simplified,
}

/// Searches for the cheapest program.
pub(crate) fn search(
    setting: &Setting,
    function: Function,
    request: &Request,
) -> Result<Found, GenerateError> {
    let watch = request.watch.over(function);
    // Who wants an end before a function's turn gets the quick search for it.
    let (effort, watch) = match watch.is_over() {
        true => (Effort::Quick, None),
        false => (request.effort, Some(watch)),
    };
    let tell = |part, best| {
        if let Some(watch) = watch {
            watch.step(part, [0, 1], best);
        }
    };
    tell(Part::Formulations, None);
    let (tuned, variants) = request.start.variants(setting, function, effort, watch);
    let graphs: Vec<Graph> = variants.iter().map(|v| v.graph.clone()).collect();
    let mut helpers = match request.start {
        Start::Auto => vec![portfolio::angle_sums(setting, Sums::Products)],
        Start::AngleSums => vec![portfolio::angle_sums(setting, Sums::Inputs)],
        Start::Only(_) => Vec::new(),
    };
    if let Some(tuned) = &tuned
        && effort == Effort::Thorough
    {
        helpers.extend(portfolio::neighbours(setting, function, tuned));
    }
    let judge = match request.prefer {
        Prefer::Accuracy => Judge::new(setting, function),
        Prefer::Operations => Judge::lenient(setting, function),
    };
    let accept = |graph: &Graph| judge.accepts(graph);
    let simplified = simplify::watched(&graphs, &helpers, effort, &accept, watch);
    let simplified = simplified.ok_or(GenerateError::Empty)?;
    tell(Part::Proof, Some(simplified.graph.counts()));
    Ok(Found {
        tuned,
        variants,
        simplified,
    })
}
