//! The steps of the pipeline, one row each, with code that can be run.

use dalembert_model::equations::Formulation;
use dalembert_model::equations::chain::{Chain, Regrouping, Skeleton};
use dalembert_model::equations::matrix::opposite;
use dalembert_model::number::Exact;
use dalembert_model::robot::JointKind;
use dalembert_model::scalar::Scalar;

use dalembert_codegen::workspace::{
    self, Dag, Folding, Job, RegressorColumns, SearchResult, Signature, Variant, VariantSet, cost,
    replay, search, search_graphs, skeleton, trace, trace_chain, tune, tune::ChainChoice,
};
use dalembert_codegen::{Counts, Function, GenerateError, Program, Request, ScalarType, Start};

/// The steps: what programs and people call them. Each does more than the one before, until the next
/// formulation.
#[rustfmt::skip]
const STEPS: [(&str, &str); 13] = [
    ("lagrange_euler_written", "Lagrange–Euler, run with this robot's numbers"),
    ("lagrange_euler_folded", "  traced: folded, equal expressions shared"),
    ("lagrange_euler_fingerprints", "  fingerprints: equal values shared"),
    ("lagrange_euler_search", "  search alone"),
    ("newton_euler_folded", "Newton–Euler in link axes, traced"),
    ("newton_euler_fingerprints", "  fingerprints"),
    ("chain", "chain form, nothing moved"),
    ("base_parameters", "  base parameters"),
    ("tuned_regrouping", "  regrouping tuned link by link"),
    ("unit_of_length", "  unit of length"),
    ("search", "  search, all forms"),
    ("plan", "kept in the plan"),
    ("tolerance", "what the tolerance admits"),
];

/// The code that a row runs.
#[derive(Clone, Debug)]
pub enum StepCode {
    /// A formulation over floats, as written.
    Formula(Formulation),
    /// A program.
    Program(Box<Program>),
    /// A text as it is emitted, with its own sines if it has such.
    Emitted(Box<workspace::Code>, ScalarType),
}

/// One step.
#[derive(Clone, Debug)]
pub struct StepRow {
    /// The name for programs.
    pub step: &'static str,
    /// Its operation counts.
    pub counts: Counts,
    /// The code.
    pub code: StepCode,
}

impl StepRow {
    /// Returns the name of the step for people.
    pub fn title(&self) -> &'static str {
        let mut steps = STEPS.into_iter();
        let entry = steps.find(|(step, _)| *step == self.step);
        entry.map_or(self.step, |(_, title)| title)
    }

    /// Returns the scalar that the code runs in.
    pub fn scalar(&self) -> ScalarType {
        match self.code {
            StepCode::Emitted(_, scalar) => scalar,
            StepCode::Formula(_) | StepCode::Program(_) => ScalarType::F64,
        }
    }
}

/// The graph of Lagrange–Euler grows with n⁴ to n⁵.
const MAX_WRITTEN: usize = 8;

/// Takes all steps but what a tolerance admits; returns them, and the program that it is applied to.
/// Fails as the search does, and for a regressor: no column of it comes from regrouped parameters.
pub(super) fn exact(
    job: &Job<'_>,
    function: Function,
) -> Result<(Vec<StepRow>, Program), GenerateError> {
    if function.columns() != RegressorColumns::None {
        return Err(unexplained(function));
    }
    // Over all forms, nothing replayed.
    let anew = Request {
        start: Start::Auto,
        plan: None,
        renewed: None,
        ..job.request.clone()
    };
    let result = search(&job.with(&anew), function)?;
    let tuned = result.tuned.as_ref().ok_or_else(|| unexplained(function))?;
    let mut steps = Steps {
        job,
        function,
        rows: Vec::new(),
    };
    if job.robot.joints.len() <= MAX_WRITTEN {
        steps.lagrange_euler();
    }
    steps.newton_euler();
    steps.chain(tuned);
    let program = steps.searched(&result)?;
    Ok((steps.rows, program))
}

struct Steps<'t> {
    job: &'t Job<'t>,
    function: Function,
    rows: Vec<StepRow>,
}

impl Steps<'_> {
    fn program(&mut self, step: &'static str, program: Program) {
        self.rows.push(StepRow {
            step,
            counts: program.counts(),
            code: StepCode::Program(Box::new(program)),
        });
    }

    fn graph(&mut self, step: &'static str, graph: &Dag) {
        let program = self.job.setup.task(self.function).program(graph);
        self.program(step, program);
    }

    /// As written, traced and merged; then what the general machinery makes of it alone.
    fn lagrange_euler(&mut self) {
        let (setup, request) = (self.job.setup, self.job.request);
        let trace = trace(setup.task(self.function), Formulation::LagrangeEuler);
        let joints = setup.robot().joints.iter().enumerate();
        let turning = joints
            .filter(|(i, joint)| setup.lock(*i).is_none() && joint.kind == JointKind::Revolute);
        self.rows.push(StepRow {
            step: "lagrange_euler_written",
            counts: Counts {
                sincos: turning.count(),
                ..trace.traced
            },
            code: StepCode::Formula(Formulation::LagrangeEuler),
        });
        self.graph("lagrange_euler_folded", &trace.graph);
        let graphs = std::slice::from_ref(&trace.graph);
        let watch = request.watch.over(self.function);
        let goes_on = |_: [usize; 2], _: &Dag| !watch.is_over();
        let limits = |operations| request.effort.limits(operations);
        // Whatever it costs in digits: that is what the row is to show.
        if let Some(result) = search_graphs(graphs, &[], &limits, &|_| true, &goes_on) {
            self.graph("lagrange_euler_fingerprints", &result.start);
            self.graph("lagrange_euler_search", &result.graph);
        }
    }

    fn newton_euler(&mut self) {
        let formulation = Formulation::NewtonEulerLink;
        let graph = trace(self.job.setup.task(self.function), formulation).graph;
        self.graph("newton_euler_folded", &graph);
        let merged = graph.rebuild(Folding::Semantic);
        self.graph("newton_euler_fingerprints", &merged);
    }

    /// Adds the chain form in one regrouping after the other, each in its cheapest form: nothing
    /// moved; everything that can; per link as much as is cheapest, origins too; and the unit of length.
    fn chain(&mut self, tuned: &ChainChoice) {
        let (setup, function) = (self.job.setup, self.function);
        let arm = skeleton(setup);
        let mut metres = tuned.regrouping.clone();
        (metres.unit, metres.per_unit) = (Exact::one(), Exact::one());
        for (step, regrouping) in [
            ("chain", &kept(&arm)),
            ("base_parameters", &tune::start(&arm)),
            ("tuned_regrouping", &metres),
            ("unit_of_length", &tuned.regrouping),
        ] {
            let chain = Chain::new(&arm, regrouping);
            let forms = function.forms().into_iter();
            let graphs = forms
                .map(|form| trace_chain(setup.task(function), &chain, form, Folding::Semantic).0);
            if let Some(cheapest) = graphs.min_by_key(cost) {
                self.graph(step, &cheapest);
            }
        }
    }

    fn searched(&mut self, result: &SearchResult) -> Result<Program, GenerateError> {
        let graph = &result.searched.graph;
        let mut last = self.job.setup.task(self.function).program(graph);
        self.program("search", last.clone());
        if let Some(entry) = replay(self.job, self.job.request.plan.as_ref(), self.function)? {
            last = entry.program;
            self.program("plan", last.clone());
        }
        Ok(last)
    }
}

/// Every link keeps what it has; origins are as for base parameters.
fn kept(arm: &Skeleton<Exact>) -> Regrouping<Exact> {
    let mut regrouping = Regrouping::base(arm);
    for (segment, link) in arm.links.iter().zip(&mut regrouping.links) {
        let body = segment.link.body.moved(&opposite(&link.origin));
        match segment.link.kind {
            JointKind::Revolute => {
                let [_, _, first] = body.first;
                (link.mass, link.first, link.second) = (body.mass, first, body.second.zz);
            }
            JointKind::Prismatic => link.keep_seconds = true,
        }
    }
    regrouping
}

pub(super) fn tolerated(admitted: &VariantSet) -> Result<Vec<StepRow>, GenerateError> {
    let row = |variant: &Variant| {
        let (function, scalar) = (variant.emitted.function, variant.scalar);
        let signature = Signature::of(&variant.emitted, scalar);
        let text = workspace::Code::parse(&variant.text, &signature)
            .map_err(|error| GenerateError::Defect(function, Some(scalar), error.to_string()))?;
        Ok(StepRow {
            step: "tolerance",
            counts: text.counts(),
            code: StepCode::Emitted(Box::new(text), scalar),
        })
    };
    admitted.variants.iter().map(row).collect()
}

fn unexplained(function: Function) -> GenerateError {
    let message = format!(
        "`{function}` has no steps to explain: none of its results comes from regrouped \
         parameters; `count` gives its operations"
    );
    GenerateError::refused(None, message, "")
}
