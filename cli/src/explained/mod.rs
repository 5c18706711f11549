//! What each step of the pipeline brought for a robot, and why.
//!
//! - [`steps`]: the rows of the table, each with code that can be run
//! - [`parameters`]: what became of every link's parameters
//! - [`merged`]: what the fingerprints alone found
//! - `errors`: what rounding costs each row

pub mod errors;
pub mod merged;
pub mod parameters;
pub mod steps;

use dalembert_model::equations::Formulation;
use dalembert_model::equations::chain::Chain;
use dalembert_model::robot::Robot;

use crate::couplings::{Coupling, couplings};
use dalembert_codegen::workspace::{
    Columns, Graph, SceneRobot, Task, WaySource, admitted, input_hash, skeleton_for, trace,
};
use dalembert_codegen::{Function, GenerateError, Program, Request};
use merged::Merged;
use parameters::Parameters;
use steps::Row;

/// The most joints for which Lagrange–Euler is written out: the graph grows
/// with n⁴ to n⁵.
pub const MAX_WRITTEN: usize = 8;

/// All that was found about one function of a robot.
#[derive(Clone, Debug)]
pub struct Explanation {
    /// The robot, in its scene.
    pub scene_robot: SceneRobot,
    /// Which function.
    pub function: Function,
    /// The steps, in their order; the last is what is generated.
    pub rows: Vec<Row>,
    /// The findings of the fingerprints in each formulation as folded.
    pub merged: Vec<(Formulation, Merged)>,
    /// The fate of the parameters.
    pub parameters: Parameters,
    /// The coefficients of the whole robot that vanish or repeat, unless there are
    /// too many.
    pub couplings: Option<Vec<Coupling>>,
}

/// Explains one function, as if nothing else were asked for.
///
/// # Errors
/// Those of [`explain_all`].
pub fn explain(
    robot: &Robot,
    function: Function,
    request: &Request,
) -> Result<Explanation, GenerateError> {
    let alone = Request {
        functions: vec![function],
        ..request.clone()
    };
    let mut all = explain_all(robot, &alone, &[])?;
    all.pop().ok_or(GenerateError::Empty)
}

/// Explains the functions of a request, in their order; of the rest, effort,
/// preference, plan, scene, scalars, source of sines and watch count. With a
/// tolerance the last rows are what it admits, a row a scalar: all functions
/// together, since they are emitted in the same one. A row each shows the search without one
/// of its sources.
///
/// # Errors
/// Those of [`generate`](dalembert_codegen::generate).
pub fn explain_all(
    robot: &Robot,
    request: &Request,
    without: &[WaySource],
) -> Result<Vec<Explanation>, GenerateError> {
    if let Some(plan) = &request.plan
        && plan.input != input_hash(robot)
    {
        let robot = plan.robot.clone();
        return Err(GenerateError::StalePlan { robot });
    }
    let scene_robot =
        SceneRobot::of(robot, request.scene.as_ref()).map_err(GenerateError::Scene)?;
    let task = Task {
        robot,
        scene_robot: &scene_robot,
        request,
    };
    let mut explained = Vec::new();
    for (index, &function) in request.functions.iter().enumerate() {
        if !request.functions[..index].contains(&function) {
            explained.push(exact(&task, function, without)?);
        }
    }
    let programs: Vec<&Program> = explained.iter().map(|(_, program)| program).collect();
    let admitted = admitted(&task, &programs)?;
    let mut explanations: Vec<Explanation> = explained.into_iter().map(|(e, _)| e).collect();
    for (explanation, admitted) in explanations.iter_mut().zip(admitted.iter().flatten()) {
        explanation.rows.extend(steps::tolerated(admitted)?);
    }
    Ok(explanations)
}

/// Returns everything but what a tolerance admits, and the program that it is applied
/// to.
fn exact(
    task: &Task<'_>,
    function: Function,
    without: &[WaySource],
) -> Result<(Explanation, Program), GenerateError> {
    let Task {
        robot,
        scene_robot,
        request,
    } = *task;
    // Of a regressor no column comes from regrouped parameters.
    if function.columns() != Columns::None {
        return Err(GenerateError::Unexplained(function));
    }
    let found = steps::search_anew(task, function, None)?;
    let tuned = found.tuned.as_ref();
    let tuned = tuned.ok_or(GenerateError::Unexplained(function))?;
    let mut rows = Vec::new();
    let mut merged = Vec::new();
    let mut fingerprints = |formulation: Formulation, graph: &Graph| {
        merged.extend(Merged::of(graph).map(|merged| (formulation, merged)));
    };
    if robot.joints.len() <= MAX_WRITTEN {
        let formulation = Formulation::LagrangeEuler;
        let trace = trace(scene_robot, function, formulation);
        fingerprints(formulation, &trace.graph);
        rows.extend(steps::lagrange_euler(
            scene_robot,
            function,
            &trace,
            request,
        ));
    }
    let formulation = Formulation::NewtonEulerLink;
    let trace = trace(scene_robot, function, formulation);
    fingerprints(formulation, &trace.graph);
    rows.extend(steps::newton_euler(scene_robot, function, &trace));
    rows.extend(steps::chain(scene_robot, function, tuned));
    let (searched, program) = steps::searched(task, function, &found, without)?;
    rows.extend(searched);
    let chain = Chain::new(&skeleton_for(scene_robot, function), &tuned.regrouping);
    let couplings = match scene_robot.scene() {
        None => couplings(robot),
        Some(_) => None,
    };
    let explanation = Explanation {
        function,
        rows,
        merged,
        parameters: Parameters::of(scene_robot, function, tuned, &chain),
        couplings,
        scene_robot: scene_robot.clone(),
    };
    Ok((explanation, program))
}
