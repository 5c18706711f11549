//! The steps of the pipeline, one row each, with code that can be run.

use dalembert_model::equations::Formulation;
use dalembert_model::equations::chain::{Chain, Regrouping, Skeleton};
use dalembert_model::equations::matrix::opposite;
use dalembert_model::number::Exact;
use dalembert_model::robot::JointKind;
use dalembert_model::scalar::Scalar;

use dalembert_codegen::workspace::{
    Admitted, Certificate, Folding, Found, Graph, Lowered, SceneRobot, Task, Trace, cost, replay,
    search, skeleton, trace_chain, tune, tune::Tuned, watched,
};
use dalembert_codegen::{Counts, Function, GenerateError, Program, Request, ScalarType, Start};

/// A step of the pipeline.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SearchStep {
    /// Lagrange–Euler run as it is written: what is zero or one for the robot
    /// is left out, nothing else.
    LagrangeWritten,
    /// Traced: zeros and ones folded, equal expressions shared.
    LagrangeFolded,
    /// Equal values shared, whatever the expression.
    LagrangeFingerprints,
    /// Equality saturation on that, no recursion, no rule of robotics.
    LagrangeEGraph,
    /// And the search.
    LagrangeSearch,
    /// Newton–Euler in link axes, traced.
    NewtonFolded,
    /// Its equal values shared.
    NewtonFingerprints,
    /// The chain form: columns of U, composite bodies; nothing moved.
    ChainKept,
    /// Base parameters: everything moved that can move.
    ChainBase,
    /// Per link as much moved as is cheapest, origins too.
    ChainTuned,
    /// And the unit of length.
    ChainUnit,
    /// Equality saturation.
    EGraph,
    /// Discovery and extraction in turns.
    Search,
    /// The program that the plan beside the robot file keeps.
    Plan,
    /// The program that the scene's tolerance admits.
    Tolerance,
}

impl SearchStep {
    /// Returns a name for programs.
    pub fn key(self) -> &'static str {
        self.names().0
    }

    /// Returns a name for readers.
    pub fn title(self) -> &'static str {
        self.names().1
    }

    #[rustfmt::skip]
    fn names(self) -> (&'static str, &'static str) {
        match self {
            SearchStep::LagrangeWritten => ("lagrange_euler_written", "Lagrange–Euler, run with this robot's numbers"),
            SearchStep::LagrangeFolded => ("lagrange_euler_folded", "  traced: folded, equal expressions shared"),
            SearchStep::LagrangeFingerprints => ("lagrange_euler_fingerprints", "  fingerprints: equal values shared"),
            SearchStep::LagrangeEGraph => ("lagrange_euler_e_graph", "  e-graph alone"),
            SearchStep::LagrangeSearch => ("lagrange_euler_search", "  search alone"),
            SearchStep::NewtonFolded => ("newton_euler_folded", "Newton–Euler in link axes, traced"),
            SearchStep::NewtonFingerprints => ("newton_euler_fingerprints", "  fingerprints"),
            SearchStep::ChainKept => ("chain", "chain form, nothing moved"),
            SearchStep::ChainBase => ("base_parameters", "  base parameters"),
            SearchStep::ChainTuned => ("tuned_regrouping", "  regrouping tuned link by link"),
            SearchStep::ChainUnit => ("unit_of_length", "  unit of length"),
            SearchStep::EGraph => ("e_graph", "  e-graph, all forms"),
            SearchStep::Search => ("search", "  search, all forms"),
            SearchStep::Plan => ("plan", "kept in the plan"),
            SearchStep::Tolerance => ("tolerance", "what the tolerance admits"),
        }
    }
}

/// The code that a row runs.
#[derive(Clone, Debug)]
pub enum Code {
    /// A formulation over floats, as written.
    Formula(Formulation),
    /// A program.
    Program(Box<Program>),
    /// A text as it is emitted, with its own sines if it has such.
    Emitted(Box<Lowered>, ScalarType),
}

/// One step.
#[derive(Clone, Debug)]
pub struct Row {
    /// Which.
    pub step: SearchStep,
    /// Its operation counts.
    pub counts: Counts,
    /// The code.
    pub code: Code,
}

impl Row {
    /// Returns the scalar that the code runs in.
    pub fn scalar(&self) -> ScalarType {
        match self.code {
            Code::Emitted(_, scalar) => scalar,
            Code::Formula(_) | Code::Program(_) => ScalarType::F64,
        }
    }

    fn program(step: SearchStep, program: Program) -> Row {
        Row {
            step,
            counts: program.counts(),
            code: Code::Program(Box::new(program)),
        }
    }

    fn graph(step: SearchStep, scene_robot: &SceneRobot, function: Function, graph: &Graph) -> Row {
        Row::program(step, Program::in_scene(scene_robot, function, graph))
    }
}

/// Returns Lagrange–Euler: as written, traced, merged; then what the general machinery
/// makes of it alone.
pub(super) fn lagrange_euler(
    scene_robot: &SceneRobot,
    function: Function,
    trace: &Trace,
    request: &Request,
) -> Vec<Row> {
    let row = |step, graph: &Graph| Row::graph(step, scene_robot, function, graph);
    let joints = scene_robot.robot().joints.iter();
    let moves = |i: &usize| scene_robot.lock(*i).is_none();
    let turning = joints
        .enumerate()
        .filter(|(i, joint)| moves(i) && joint.kind == JointKind::Revolute);
    let mut rows = vec![
        Row {
            step: SearchStep::LagrangeWritten,
            counts: Counts {
                sincos: turning.count(),
                ..trace.traced
            },
            code: Code::Formula(Formulation::LagrangeEuler),
        },
        row(SearchStep::LagrangeFolded, &trace.graph),
    ];
    let graphs = std::slice::from_ref(&trace.graph);
    let watch = Some(request.watch.over(function));
    // Whatever it costs in digits: that is what the row is to show.
    if let Some(found) = watched(graphs, &[], request.effort, None, &|_| true, watch) {
        rows.extend([
            row(SearchStep::LagrangeFingerprints, &found.start),
            row(SearchStep::LagrangeEGraph, &found.saturated),
            row(SearchStep::LagrangeSearch, &found.graph),
        ]);
    }
    rows
}

/// Returns Newton–Euler in link axes.
pub(super) fn newton_euler(
    scene_robot: &SceneRobot,
    function: Function,
    trace: &Trace,
) -> Vec<Row> {
    let row = |step, graph: &Graph| Row::graph(step, scene_robot, function, graph);
    vec![
        row(SearchStep::NewtonFolded, &trace.graph),
        row(
            SearchStep::NewtonFingerprints,
            &trace.graph.rebuild(Folding::Semantic),
        ),
    ]
}

/// Returns the chain form in one regrouping after the other, each in its cheapest form.
pub(super) fn chain(scene_robot: &SceneRobot, function: Function, tuned: &Tuned) -> Vec<Row> {
    let arm = skeleton(scene_robot);
    let mut metres = tuned.regrouping.clone();
    (metres.unit, metres.per_unit) = (Exact::one(), Exact::one());
    let regroupings = [
        (SearchStep::ChainKept, kept(&arm)),
        (SearchStep::ChainBase, tune::start(&arm)),
        (SearchStep::ChainTuned, metres),
        (SearchStep::ChainUnit, tuned.regrouping.clone()),
    ];
    let row = |(step, regrouping): (SearchStep, Regrouping<Exact>)| {
        let chain = Chain::new(&arm, &regrouping);
        let forms = function.forms().into_iter();
        let graphs =
            forms.map(|form| trace_chain(scene_robot, function, &chain, form, Folding::Semantic));
        let cheapest = graphs.map(|(graph, _)| graph).min_by_key(cost)?;
        Some(Row::graph(step, scene_robot, function, &cheapest))
    };
    regroupings.into_iter().filter_map(row).collect()
}

/// Returns the regrouping in which every link keeps what it has; origins as for base
/// parameters.
pub(super) fn kept(arm: &Skeleton<Exact>) -> Regrouping<Exact> {
    let mut regrouping = Regrouping::base(arm);
    for (segment, link) in arm.links.iter().zip(&mut regrouping.links) {
        let body = segment.body.moved(&opposite(&link.origin));
        match segment.kind {
            JointKind::Revolute => {
                let [_, _, first] = body.first;
                (link.mass, link.first, link.second) = (body.mass, first, body.second.zz);
            }
            JointKind::Prismatic => link.keep_seconds = true,
        }
    }
    regrouping
}

/// Returns the search over all forms, nothing replayed.
pub(super) fn search_anew(task: &Task<'_>, function: Function) -> Result<Found, GenerateError> {
    let anew = Request {
        start: Start::Auto,
        plan: None,
        ..task.request.clone()
    };
    search(&task.with(&anew), function)
}

/// Returns what the search made of all forms, and what the plan keeps; and the last of them: what is
/// generated, or what a tolerance is applied to.
pub(super) fn searched(
    task: &Task<'_>,
    function: Function,
    found: &Found,
) -> Result<(Vec<Row>, Program), GenerateError> {
    let scene_robot = task.scene_robot;
    let simplified = &found.simplified;
    let saturated = &simplified.saturated;
    let mut last = Program::in_scene(scene_robot, function, &simplified.graph);
    let mut rows = vec![
        Row::graph(SearchStep::EGraph, scene_robot, function, saturated),
        Row::program(SearchStep::Search, last.clone()),
    ];
    if let Some(entry) = replay(task, function)? {
        last = entry.program.clone();
        rows.push(Row::program(SearchStep::Plan, last.clone()));
    }
    Ok((rows, last))
}

/// Returns what a tolerance admits of a function: a row a scalar, as it is emitted.
pub(super) fn tolerated(admitted: &Admitted) -> Result<Vec<Row>, GenerateError> {
    let row = |certificate: &Certificate| {
        let (function, scalar) = (certificate.emitted.function, certificate.scalar);
        let text = Lowered::parse(&certificate.text, function, scalar)
            .map_err(|error| GenerateError::Defect(function, Some(scalar), error.to_string()))?;
        Ok(Row {
            step: SearchStep::Tolerance,
            counts: text.counts(),
            code: Code::Emitted(Box::new(text), scalar),
        })
    };
    admitted.certificates.iter().map(row).collect()
}
