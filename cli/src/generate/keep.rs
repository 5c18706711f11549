//! The plan: programs kept for later runs.

use dalembert_codegen::generate::early::price;
use dalembert_codegen::generate::{Generated, GeneratedFunction, Request};
use dalembert_codegen::plan::{Edited, Entry, Plan};
use dalembert_codegen::program::{Program, ScalarType};
use dalembert_codegen::scene::{SceneKey, input_hash};
use dalembert_model::robot::Robot;

/// The plan with the programs in it, and what is to be said of it. Those of
/// other requests for the same robot stay, and after a search that was ended
/// early those that are no dearer than what it found.
pub fn plan(
    robot: &Robot,
    request: &Request,
    generated: &Generated,
    kept: Option<Plan>,
) -> (Plan, Vec<String>) {
    let input = input_hash(robot);
    let mut plan = kept.filter(|plan| plan.input == input).unwrap_or(Plan {
        robot: robot.name.clone(),
        input,
        entries: Vec::new(),
    });
    let mut notes = Vec::new();
    for function in &generated.functions {
        for scalar in scalars(request, function) {
            let entry = entry(request, function, scalar);
            let (name, scene) = (function.function, request.scene.as_ref());
            let other = plan.find(name, request.start, scalar, scene);
            let as_good = |other: &Entry| {
                other.scene == entry.scene && price(emitted(other)) <= price(emitted(&entry))
            };
            if generated.ended && other.is_some_and(as_good) {
                notes.push(format!(
                    "the plan keeps its own `{name}` in {scalar}: what was found until the early end is no cheaper"
                ));
            } else {
                plan.insert(entry);
            }
        }
    }
    (plan, notes)
}

fn entry(request: &Request, function: &GeneratedFunction, scalar: ScalarType) -> Entry {
    Entry {
        start: request.start,
        scalar,
        source: function.source,
        stages: function.stages.clone(),
        scene: request.scene.as_ref().map(SceneKey::of),
        program: exact(function).clone(),
        edited: function.admitted.as_ref().and_then(|admitted| {
            let claim = admitted.libm.iter().find(|claim| claim.scalar == scalar)?;
            Some(Edited {
                stages: admitted.stages.clone(),
                program: admitted.program.clone(),
                bounds: claim.bounds.clone(),
                lambda_min: claim.lambda_min,
            })
        }),
    }
}

/// What a run would emit of an entry.
fn emitted(entry: &Entry) -> &Program {
    let edited = entry.edited.as_ref();
    edited.map_or(&entry.program, |edited| &edited.program)
}

/// The scalars that a function was emitted in.
fn scalars(request: &Request, function: &GeneratedFunction) -> Vec<ScalarType> {
    match &function.admitted {
        None => request.scalars.clone(),
        Some(admitted) => admitted.certificates.iter().map(|c| c.scalar).collect(),
    }
}

/// The proved program: what a tolerance was applied to.
fn exact(function: &GeneratedFunction) -> &Program {
    let admitted = function.admitted.as_ref();
    let first = admitted.and_then(|admitted| admitted.stages.first());
    first.map_or(&function.program, |stage| &stage.program)
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use dalembert_codegen::function::Function;
    use dalembert_codegen::generate::{Request, generate};

    use super::{emitted, plan, price};
    use crate::input;

    /// The plan's own program stays after an early end that found a dearer one
    /// or an equal one, and only then.
    #[test]
    fn an_early_end_takes_nothing_better_away() {
        let robots = Path::new(env!("CARGO_MANIFEST_DIR")).join("../generated/robots");
        let Ok(robot) = input::robot(&robots.join("planar2r.toml")) else {
            panic!("a checked-in robot");
        };
        let request = Request {
            functions: vec![Function::Gravity],
            ..Request::default()
        };
        let good = generate(&robot, &request).unwrap();
        // The same function with a step that nobody needs.
        let mut dear = good.clone();
        let step = dear.functions[0].program.steps[0].clone();
        dear.functions[0].program.steps.push(step);
        let prices = |kept, found: &_| {
            let (plan, notes) = plan(&robot, &request, found, kept);
            let prices = plan.entries.iter().map(|entry| price(emitted(entry)));
            let prices: Vec<u64> = prices.collect();
            assert_eq!(prices.len(), 2, "one a scalar");
            assert_eq!(prices[0], prices[1]);
            (plan, prices[0], notes.len())
        };
        let (of_good, low, _) = prices(None, &good);
        let (of_dear, high, _) = prices(None, &dear);
        assert!(low < high);
        // Who had the patience for it gets what was found.
        assert_eq!(prices(Some(of_good.clone()), &dear).1, high);
        for generated in [&mut dear, &mut good.clone()] {
            generated.ended = true;
            let (_, price, notes) = prices(Some(of_good.clone()), generated);
            assert_eq!((price, notes), (low, 2));
        }
        let ended = {
            let mut good = good;
            good.ended = true;
            good
        };
        assert_eq!(prices(Some(of_dear.clone()), &ended).1, low);
        // Of another robot nothing is kept.
        let mut other = of_good;
        other.input = String::new();
        assert_eq!(prices(Some(other), &dear).1, high);
    }
}
