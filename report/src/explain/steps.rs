//! The steps of the pipeline, one row each, with code that can be run.

use dalembert_model::equations::Formulation;
use dalembert_model::equations::chain::{Chain, Gauge, Skeleton};
use dalembert_model::equations::matrix::opposite;
use dalembert_model::number::Exact;
use dalembert_model::robot::JointKind;
use dalembert_model::scalar::Scalar;

use dalembert_codegen::certify::certificate::Certificate;
use dalembert_codegen::certify::choose::Admitted;
use dalembert_codegen::function::Function;
use dalembert_codegen::generate::search::{self, Found};
use dalembert_codegen::generate::{GenerateError, Request};
use dalembert_codegen::graph::{Folding, Graph};
use dalembert_codegen::portfolio::tune::{self, Tuned};
use dalembert_codegen::portfolio::{self, Start};
use dalembert_codegen::program::{Counts, Lowered, Program, ScalarType};
use dalembert_codegen::scene::Setting;
use dalembert_codegen::simplify;
use dalembert_codegen::trace::Trace;

/// A step of the pipeline.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Step {
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
    /// What the plan beside the robot file keeps.
    Plan,
    /// What the scene's tolerance admits.
    Tolerance,
}

impl Step {
    /// A name for programs.
    pub fn key(self) -> &'static str {
        match self {
            Step::LagrangeWritten => "lagrange_euler_written",
            Step::LagrangeFolded => "lagrange_euler_folded",
            Step::LagrangeFingerprints => "lagrange_euler_fingerprints",
            Step::LagrangeEGraph => "lagrange_euler_e_graph",
            Step::LagrangeSearch => "lagrange_euler_search",
            Step::NewtonFolded => "newton_euler_folded",
            Step::NewtonFingerprints => "newton_euler_fingerprints",
            Step::ChainKept => "chain",
            Step::ChainBase => "base_parameters",
            Step::ChainTuned => "tuned_gauge",
            Step::ChainUnit => "unit_of_length",
            Step::EGraph => "e_graph",
            Step::Search => "search",
            Step::Plan => "plan",
            Step::Tolerance => "tolerance",
        }
    }

    /// A name for readers.
    pub fn title(self) -> &'static str {
        match self {
            Step::LagrangeWritten => "Lagrange–Euler, run with this robot's numbers",
            Step::LagrangeFolded => "  traced: folded, equal expressions shared",
            Step::LagrangeFingerprints => "  fingerprints: equal values shared",
            Step::LagrangeEGraph => "  e-graph alone",
            Step::LagrangeSearch => "  search alone",
            Step::NewtonFolded => "Newton–Euler in link axes, traced",
            Step::NewtonFingerprints => "  fingerprints",
            Step::ChainKept => "chain form, nothing moved",
            Step::ChainBase => "  base parameters",
            Step::ChainTuned => "  gauge tuned link by link",
            Step::ChainUnit => "  unit of length",
            Step::EGraph => "  e-graph, all forms",
            Step::Search => "  search, all forms",
            Step::Plan => "kept in the plan",
            Step::Tolerance => "what the tolerance admits",
        }
    }
}

/// What a row runs.
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
    pub step: Step,
    /// What it costs.
    pub counts: Counts,
    /// What runs.
    pub code: Code,
}

impl Row {
    fn program(step: Step, program: Program) -> Row {
        Row {
            step,
            counts: program.counts(),
            code: Code::Program(Box::new(program)),
        }
    }

    fn graph(step: Step, setting: &Setting, function: Function, graph: &Graph) -> Row {
        Row::program(step, Program::in_setting(setting, function, graph))
    }
}

/// Lagrange–Euler: as written, traced, merged; then what the general machinery
/// makes of it alone.
pub(super) fn lagrange_euler(
    setting: &Setting,
    function: Function,
    trace: &Trace,
    request: &Request,
) -> Vec<Row> {
    let row = |step, graph: &Graph| Row::graph(step, setting, function, graph);
    let joints = setting.robot().joints.iter();
    let moves = |i: &usize| setting.lock(*i).is_none();
    let turning = joints
        .enumerate()
        .filter(|(i, joint)| moves(i) && joint.kind == JointKind::Revolute);
    let mut rows = vec![
        Row {
            step: Step::LagrangeWritten,
            counts: Counts {
                sincos: turning.count(),
                ..trace.traced
            },
            code: Code::Formula(Formulation::LagrangeEuler),
        },
        row(Step::LagrangeFolded, &trace.graph),
    ];
    let graphs = std::slice::from_ref(&trace.graph);
    let watch = Some(request.watch.over(function));
    // Whatever it costs in digits: that is what the row is to show.
    if let Some(found) = simplify::watched(graphs, &[], request.effort, &|_| true, watch) {
        rows.extend([
            row(Step::LagrangeFingerprints, &found.start),
            row(Step::LagrangeEGraph, &found.saturated),
            row(Step::LagrangeSearch, &found.graph),
        ]);
    }
    rows
}

/// Newton–Euler in link axes.
pub(super) fn newton_euler(setting: &Setting, function: Function, trace: &Trace) -> Vec<Row> {
    let row = |step, graph: &Graph| Row::graph(step, setting, function, graph);
    vec![
        row(Step::NewtonFolded, &trace.graph),
        row(
            Step::NewtonFingerprints,
            &trace.graph.rebuild(Folding::Semantic),
        ),
    ]
}

/// The chain form in one gauge after the other, each in its cheapest form.
pub(super) fn chain(setting: &Setting, function: Function, tuned: &Tuned) -> Vec<Row> {
    let arm = portfolio::skeleton(setting);
    let mut metres = tuned.gauge.clone();
    (metres.unit, metres.per_unit) = (Exact::one(), Exact::one());
    let gauges = [
        (Step::ChainKept, kept(&arm)),
        (Step::ChainBase, tune::start(&arm)),
        (Step::ChainTuned, metres),
        (Step::ChainUnit, tuned.gauge.clone()),
    ];
    let row = |(step, gauge): (Step, Gauge<Exact>)| {
        let chain = Chain::new(&arm, &gauge);
        let forms = function.forms().into_iter();
        let graphs = forms
            .map(|form| portfolio::trace_chain(setting, function, &chain, form, Folding::Semantic));
        let cheapest = graphs.map(|(graph, _)| graph).min_by_key(simplify::cost)?;
        Some(Row::graph(step, setting, function, &cheapest))
    };
    gauges.into_iter().filter_map(row).collect()
}

/// The gauge in which every link keeps what it has; origins as for base
/// parameters.
pub(super) fn kept(arm: &Skeleton<Exact>) -> Gauge<Exact> {
    let mut gauge = Gauge::base(arm);
    for (segment, link) in arm.links.iter().zip(&mut gauge.links) {
        let body = segment.body.moved(&opposite(&link.origin));
        match segment.kind {
            JointKind::Revolute => {
                let [_, _, first] = body.first;
                (link.mass, link.first, link.second) = (body.mass, first, body.second.zz);
            }
            JointKind::Prismatic => link.keep_seconds = true,
        }
    }
    gauge
}

/// The search over all forms, nothing replayed.
pub(super) fn search(
    setting: &Setting,
    function: Function,
    request: &Request,
) -> Result<Found, GenerateError> {
    search::search(setting, function, &anew(request))
}

/// What the search made of all forms, and what the plan keeps; and the last of
/// them: what is generated, or what a tolerance is applied to.
pub(super) fn searched(
    setting: &Setting,
    function: Function,
    request: &Request,
    found: &Found,
) -> Result<(Vec<Row>, Program), GenerateError> {
    let row = |step, graph: &Graph| Row::graph(step, setting, function, graph);
    let simplified = &found.simplified;
    let mut rows = vec![row(Step::EGraph, &simplified.saturated)];
    let mut last = Program::in_setting(setting, function, &simplified.graph);
    rows.push(Row::program(Step::Search, last.clone()));
    if let Some(entry) = search::replay(setting, function, request)? {
        last = entry.program.clone();
        rows.push(Row::program(Step::Plan, last.clone()));
    }
    Ok((rows, last))
}

/// What a tolerance admits of a function: a row a scalar, as it is emitted.
pub(super) fn tolerated(admitted: &Admitted) -> Result<Vec<Row>, GenerateError> {
    let row = |certificate: &Certificate| {
        let (function, scalar) = (certificate.emitted.function, certificate.scalar);
        let text = Lowered::parse(&certificate.text, function, scalar)
            .map_err(|error| GenerateError::Text(function, scalar, error.to_string()))?;
        Ok(Row {
            step: Step::Tolerance,
            counts: text.counts(),
            code: Code::Emitted(Box::new(text), scalar),
        })
    };
    admitted.certificates.iter().map(row).collect()
}

/// The request without a plan, from all formulations.
fn anew(request: &Request) -> Request {
    Request {
        start: Start::Auto,
        plan: None,
        ..request.clone()
    }
}
