//! `dalembert explain`: what each step of the generator brings for a robot, in operations and in rounding;
//! Table 3 of the paper; closed forms of the coefficients; and why some of them vanish.

use std::path::Path;

use dalembert_codegen::workspace::{
    Argument, Input, Job, JointState, SEED, Setup, admitted, input_hash,
};
use dalembert_codegen::{Counts, Function, GenerateError, Program, Request, ScalarType};
use dalembert_import::ChainArgs;
use dalembert_model::equations::{Arm, Formulation};
use dalembert_model::number::{Exact, Rounded};
use dalembert_model::robot::Robot;
use dalembert_stamp::{Comment, sealed};

use crate::args::Options;
use crate::couplings;
use crate::files::{Files, Target, ends_in};
use crate::formulas::{self, FormulaArgs};
use crate::measure::{Bench, Code as Measured, largest};
use crate::output::{Context, Done, Failure, Outcome};
use crate::progress;
use crate::report::{COUNTS, Cell, Report, Table, cells, counts};
use crate::robot_report;
use crate::source::Source;
use crate::steps::{self, StepCode, StepRow};
use crate::table3::comparisons;

/// Arguments of `explain`.
#[derive(Debug, clap::Args)]
pub struct ExplainArgs {
    /// The robot: a robot file, a URDF or an MJCF
    robot: std::path::PathBuf,
    /// Say which of D_ik, h_ikm and c_i vanish, why, and which nearly do
    #[arg(long, conflicts_with_all = ["scene", "outputs", "effort"])]
    couplings: bool,
    #[command(flatten)]
    formulas: FormulaArgs,
    #[command(flatten)]
    options: Options<false>,
    #[command(flatten)]
    chain: ChainArgs,
}

const STATES: usize = 200;

/// All that was found about one function of a robot.
#[derive(Clone, Debug)]
pub struct Explanation {
    /// The robot, in its scene.
    pub setup: Setup,
    /// The function.
    pub function: Function,
    /// The steps, in their order; the last is what is generated.
    pub rows: Vec<StepRow>,
}

/// Explains the functions of a request, in their order; of the rest, effort,
/// preference, plan, scene, scalars, source of sines and watch count. With a
/// tolerance the last rows are what it admits, a row a scalar: all functions
/// together, since they are emitted in the same one.
///
/// # Errors
/// Those of [`generate`](dalembert_codegen::generate).
pub fn explain(robot: &Robot, request: &Request) -> Result<Vec<Explanation>, GenerateError> {
    let setup = request.prepare(robot)?;
    let job = Job {
        robot,
        setup: &setup,
        request,
    };
    let mut explanations: Vec<Explanation> = Vec::new();
    let mut programs = Vec::new();
    for &function in &request.functions {
        let mut others = explanations.iter();
        if others.any(|explanation| explanation.function == function) {
            continue;
        }
        let (rows, program) = steps::exact(&job, function)?;
        programs.push(program);
        explanations.push(Explanation {
            setup: setup.clone(),
            function,
            rows,
        });
    }
    let programs: Vec<&Program> = programs.iter().collect();
    let admitted = admitted(&job, &programs, None)?;
    for (explanation, admitted) in explanations.iter_mut().zip(admitted.iter().flatten()) {
        explanation.rows.extend(steps::tolerated(admitted)?);
    }
    Ok(explanations)
}

impl Explanation {
    /// Measures what rounding costs each row, of a vector and of an entry, in u, at states inside the limits of the robot, or of its
    /// scene.
    pub fn rounding(&self, states: usize) -> Vec<[f64; 2]> {
        let (setup, function) = (&self.setup, self.function);
        let bench = Bench::new(setup.clone());
        let drawn = setup.states(states, SEED);
        let samples = |scalar| bench.samples(function, scalar, &drawn, &drawn);
        let double = samples(ScalarType::F64);
        let exact: Arm<Exact> = setup.arm(Exact::clone);
        let arm = exact.map(f64::nearest);
        let sizes = setup.sizes(function);
        let row = |row: &StepRow| {
            let scalar = row.scalar();
            let code = Measured {
                function,
                scalar,
                sizes,
                vanishing: vec![false; function.outputs(sizes)],
                run: match &row.code {
                    StepCode::Formula(formulation) => {
                        Box::new(|state| formula(setup, &arm, *formulation, function, state))
                    }
                    StepCode::Program(program) => {
                        let text = program.in_doubles();
                        Box::new(move |state| text.run_at(state))
                    }
                    StepCode::Emitted(text, _) => Box::new(|state| text.run_at(state)),
                },
            };
            let worst = match scalar {
                ScalarType::F64 => bench.compare(&code, &double),
                ScalarType::F32 => bench.compare(&code, &samples(scalar)),
            };
            largest(&worst)
        };
        self.rows.iter().map(row).collect()
    }
}

fn formula(
    setup: &Setup,
    arm: &Arm<f64>,
    formulation: Formulation,
    function: Function,
    state: &JointState,
) -> Vec<f64> {
    let input = |input| match input {
        Input::Sin(joint) => libm::sincos(state.q[joint]).0,
        Input::Cos(joint) => libm::sincos(state.q[joint]).1,
        Input::PerSpeed(coordinate) => {
            let qd = state.entry(Argument::Velocity, coordinate);
            setup.per_speed(coordinate, &qd, f64::nearest, |x| libm::sqrt(*x))
        }
        Input::Entry(argument, joint) => state.entry(argument, joint),
    };
    let task = setup.task(function);
    let posed = task.posed_arm(arm.clone(), &(f64::nearest, input));
    posed.results(formulation)
}

pub(crate) fn run(args: &ExplainArgs, context: &Context) -> Outcome {
    let mut source = Source::open(context, &args.robot, &args.chain)?;
    if args.couplings {
        return Ok(couplings::report(&source.robot)?.into());
    }
    if let Some(quantities) = &args.formulas.formulas {
        let request = source.request(&args.options.0, &ScalarType::ALL)?;
        let output = args.formulas.output.as_deref();
        let mut files = Files::new(context, &[&args.robot]);
        let is_written = output.is_some() || !context.json;
        let target = is_written.then(|| files.output(output)).transpose()?;
        let (robot, scene) = (&source.robot, request.scene.as_ref());
        let (args, is_json) = (&args.formulas, context.json);
        return formulas::run(args, quantities, robot, scene, target, is_json);
    }
    let targets = targets(args, context)?;
    if targets.is_some() && args.options.0.get("scene").is_some() {
        let why = "a page is about the whole robot: leave --scene out, or add --formulas";
        return Err(Failure::input(why));
    }
    source.outputs = vec![Function::InverseDynamics];
    let mut request = source.request(&args.options.0, &ScalarType::ALL)?;
    let session = progress::watch(&mut request);
    let input = input_hash(&source.robot);
    if request.plan.take_if(|plan| plan.input != input).is_some() {
        let why = "the plan beside the robot file no longer fits it: a new search replaces it";
        context.say(&format!("warning: {why}"));
    }
    let explained = explain(&source.robot, &request)?;
    drop(session);
    if let Some([page, picture]) = targets {
        let shown = picture.file().unwrap_or(Path::new("picture.svg"));
        let last = |explanation: &Explanation| Some(explanation.rows.last()?.counts);
        let generated: Vec<Counts> = explained.iter().filter_map(last).collect();
        let [text, svg] = robot_report::page(&source.robot, &generated, shown)?;
        let text = sealed(Comment::Xml, "dalembert explain", &text);
        let svg = sealed(Comment::Xml, "dalembert explain", &svg);
        return Ok(Done {
            files: vec![(page, text), (picture, svg)],
            ..Done::default()
        });
    }
    let robot = &source.robot;
    let mut report = Report::of(robot, request.scene.as_ref());
    report.line(format!(
        "errors: the largest at {STATES} states inside the limits, against 256-bit arithmetic, in u (f64 2^-53, f32 2^-24):\n\
         of a vector relative to its largest entry, of an entry relative to its own largest value"
    ));
    report.value("states", STATES);
    for explanation in &explained {
        let name = explanation.function.to_string();
        report.table(&format!("functions/{name}"), &name, steps_of(explanation));
    }
    if request.scene.is_none() && robot.floating.is_none() {
        let heads = "formulation=Table 3, torques|mul|add|mul as written|add as written";
        let rows = comparisons(robot).map(|(formulation, counts)| {
            let mut row = cells![formulation];
            row.extend(counts.map(|count| Cell::from(count as usize)));
            row
        });
        report.table("table3", "", Table::new(heads).with(rows));
        report.line(
            "  Table 3: the paper's formulas for this number of joints, in which no parameter is 0 or 1.\n  \
             As written: the same formulas with this robot's numbers, where factors 0, 1 and -1 cost nothing.\n  \
             The step `Lagrange–Euler, run`: the formula as a program runs it, where factors -1 count and\n  \
             numbers that cancel are gone."
        );
    }
    if request.scene.is_none() {
        couplings::count(&mut report, robot);
    }
    Ok(report.into())
}

/// Reserves the files of a page about the robot, if one is asked for: the page and its drawing.
fn targets(args: &ExplainArgs, context: &Context) -> Result<Option<[Target; 2]>, Failure> {
    let Some(page) = args.formulas.output.as_deref() else {
        return Ok(None);
    };
    ends_in(Some(page), "md")?;
    if page == Path::new("-") {
        let why = "a page has its drawing beside it: give a file, such as -o robot.md";
        return Err(Failure::input(why));
    }
    let mut files = Files::new(context, &[&args.robot]);
    Ok(Some([
        files.add(page)?,
        files.add(&page.with_extension("svg"))?,
    ]))
}

fn steps_of(explanation: &Explanation) -> Table {
    let mut table = Table::new(&format!("step|.key|{COUNTS}|vector|entry"));
    let roundings = explanation.rounding(STATES);
    for (index, (row, rounding)) in explanation.rows.iter().zip(roundings).enumerate() {
        let is_emitted = matches!(row.code, StepCode::Emitted(..));
        let mut title = row.title().to_owned();
        if is_emitted {
            title += &format!(", in {}", row.scalar());
        }
        if is_emitted || index + 1 == explanation.rows.len() {
            title += ": generated";
        }
        let mut cells = cells![title, Cell::json(row.step)];
        cells.extend(counts(&row.counts));
        cells.extend(rounding.map(Cell::units));
        table.row(cells);
    }
    table.without_zeros("fma|div|sqrt|trig_mul|trig_add")
}
