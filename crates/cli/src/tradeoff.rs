//! `dalembert tradeoff`: what accuracy costs, with bounds and with what is observed.

use std::path::PathBuf;

use dalembert_codegen::workspace::{Budget, SceneKey, Setup, claim_of, prove};
use dalembert_codegen::{Function, GenerateError, Program, Request, ScalarType};
use dalembert_import::ChainArgs;
use dalembert_model::scene::{Scale, Scene};
use dalembert_stamp::{Comment, sealed};
use serde_json::Value;

use crate::args::Options;
use crate::args::values::{positive_parser, scale_parser};
use crate::chart::{self, Dot};
use crate::files::{Files, Target};
use crate::ladder::{Ladder, Point, mark};
use crate::output::{Context, Done, Failure, Outcome};
use crate::report::{Cell, Table, cells, in_scene};
use crate::source::Source;
use crate::terminal;

/// Arguments of `tradeoff`.
#[derive(Debug, clap::Args)]
pub struct TradeoffArgs {
    /// The robot; the box is its limits of motion, unless a scene has one, whose tolerance gives way
    /// to the list of tolerances
    robot: PathBuf,
    /// What errors are relative to: `actuator`, the joints' torque limits, or `range`,
    /// the largest torque that was found for the model in the box
    /// [default: the scene's, or actuator]
    #[arg(long, value_name = "SCALE", value_parser = scale_parser())]
    relative_to: Option<Scale>,
    /// Tolerances, separated by commas [default: 1e-12 to 1e-1]
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = positive_parser(), allow_hyphen_values = true)]
    tolerances: Vec<f64>,
    /// Write table, chart and the text of every variant, with its claim, to this folder
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// States at which each variant is run; with 0 nothing is observed
    #[arg(
        long,
        value_name = "N",
        allow_negative_numbers = true,
        default_value_t = 10_000
    )]
    samples: u32,
    #[command(flatten)]
    options: Options<false>,
    #[command(flatten)]
    chain: ChainArgs,
}

/// Tolerances unless others are asked for; zero is always there.
const TOLERANCES: [f64; 10] = [1e-12, 1e-10, 1e-8, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 5e-2, 1e-1];

const CSV: &str = "tradeoff.csv";
const SVG: &str = "tradeoff.svg";

pub(crate) fn run(args: &TradeoffArgs, context: &Context) -> Outcome {
    let mut source = Source::open(context, &args.robot, &args.chain)?;
    source.outputs = vec![Function::InverseDynamics];
    let (mut request, scene) = exact_request(args, &source)?;
    let tolerances = tolerances(args, context);
    // Before the work: a folder that cannot be is no news an hour later.
    let mut files = Files::new(context, &[&args.robot]);
    let targets = args.output.as_ref().map(|folder| {
        let [csv, svg] = [CSV, SVG].map(|name| files.add_in(folder, name));
        Ok::<[Target; 2], Failure>([csv?, svg?])
    });
    let targets = targets.transpose()?;
    let setup = request.setup(&source.robot).map_err(GenerateError::from)?;
    let functions = source.generate(context, &mut request)?.functions;
    let (loads, functions): (Vec<_>, Vec<_>) = (functions.into_iter())
        .map(|own| own.program)
        .partition(|own| own.function == Function::Load);
    let load = loads.first();
    let exact = functions.into_iter().next();
    let mut exact = exact.ok_or_else(|| Failure::from(GenerateError::empty()))?;
    let relative_to = relative_to(args, scene.as_ref());
    let climb = |exact: &Program| {
        climb(
            args,
            &request,
            (&setup, load),
            exact,
            relative_to,
            &tolerances,
        )
    };
    let mut points = climb(&exact)?;
    // What a tolerance led to may be exact, and cheaper than what the exact search found.
    if let Some(better) = better(&setup, &exact, &points) {
        points = climb(&better)?;
        exact = better;
    }
    mark(&mut points);
    let mut done = Done::default();
    let report = &mut done.report;
    report.value("robot", source.robot.name.as_str());
    report.value("input", source.robot.short_hash());
    report.value("scene", scene.as_ref().map(|scene| scene.name.as_str()));
    report.value("function", exact.function.to_string());
    report.value("relative_to", relative_to.word());
    let table = table(&points);
    if let Some(([csv, svg], folder)) = targets.zip(args.output.as_ref()) {
        let scene = in_scene(scene.as_ref().map(|scene| scene.name.as_str()));
        let title = format!("{}{scene}: {}", source.robot.name, exact.function);
        let chart = drawn(&title, relative_to, &points);
        done.files = vec![
            (csv, table.csv()),
            (svg, sealed(Comment::Xml, "dalembert tradeoff", &chart)),
        ];
        for point in &points {
            let own = &point.variant;
            let name = format!("variants/{}", point.name());
            let mut add = |ending: &str| files.add_in(folder, &format!("{name}.{ending}"));
            let [code, claim] = [add("rs")?, add("claim.json")?];
            let writer = format!(
                "Generated by dalembert {} for `{}`: within {:e}",
                env!("CARGO_PKG_VERSION"),
                source.robot.name,
                point.tolerance
            );
            done.files
                .push((code, sealed(Comment::Line, &writer, &own.with_load())));
            let text = claim_of(&source.robot, &source.robot_file, &setup, own).write();
            done.files.push((claim, text));
        }
        done.notes.push(format!("wrote {}", folder.display()));
    }
    let table = table.without("rounding");
    done.report.value("variants", table.json());
    done.report.rows(table);
    done.failed.extend(points.iter().filter_map(|point| {
        let (name, why) = (point.name(), point.violation.as_ref()?);
        Some(format!("error: {name} is violated: {why}"))
    }));
    Ok(done)
}

/// The plan may have the program of the scene with its own tolerance, which is one of many here.
fn exact_request(
    args: &TradeoffArgs,
    source: &Source,
) -> Result<(Request, Option<Scene>), Failure> {
    let mut request = source.request(&args.options.0, &ScalarType::ALL)?;
    if args.options.0.items("outputs").len() > 1 {
        let why = "error: --outputs: one function is traded at a time\n  = help: name one";
        return Err(Failure::Input(why.into()));
    }
    request.functions.truncate(1);
    request.scalars = vec![ScalarType::F64];
    request.is_scalar_open = false;
    let scene = request.scene.take();
    request.scene = scene.as_ref().map(Scene::without_tolerance);
    if let (Some(plan), Some(scene), Some(bare)) = (&mut request.plan, &scene, &request.scene) {
        for entry in &mut plan.entries {
            if entry.scene == Some(SceneKey::new(scene)) {
                entry.scene = Some(SceneKey::new(bare));
                entry.edited = None;
            }
        }
    }
    Ok((request, scene))
}

fn climb(
    args: &TradeoffArgs,
    request: &Request,
    (setup, load): (&Setup, Option<&Program>),
    exact: &Program,
    relative_to: Scale,
    tolerances: &[f64],
) -> Result<Vec<Point>, Failure> {
    let refused = |refusal| {
        Failure::Input(format!(
            "error: {}: {refusal}\n  = help: give the limits in the robot file, or the box of a scene",
            args.robot.display()
        ))
    };
    let budget = Budget::new(setup, exact, load, relative_to).map_err(refused)?;
    // Every tolerance and the exact program: searched for, then falsified.
    terminal::bar().set_length(2 * (1 + tolerances.len() as u64));
    let ladder = Ladder::new(args.samples as usize, request.effort, &budget);
    let ladder = ladder.map_err(refused)?;
    let points = ladder.climb(tolerances, &terminal::step);
    points.map_err(|error| Failure::Check(format!("error: {error}")))
}

fn better(setup: &Setup, exact: &Program, points: &[Point]) -> Option<Program> {
    let programs = points.iter().map(|point| &point.variant.emitted);
    let fewer = |own: &&Program| own.counts().operations() < exact.counts().operations();
    let mut fewer: Vec<&Program> = programs.filter(fewer).collect();
    fewer.sort_by_key(|own| own.counts().operations());
    let mut fewer = fewer.into_iter();
    fewer.find(|own| prove(setup, own).is_ok()).cloned()
}

fn tolerances(args: &TradeoffArgs, context: &Context) -> Vec<f64> {
    let mut tolerances = match args.tolerances.as_slice() {
        [] => TOLERANCES.to_vec(),
        given => given.to_vec(),
    };
    if let Some(large) = tolerances.iter().find(|t| **t >= 1.0) {
        context.say(&format!(
            "warning: a tolerance of {large} allows an error as large as the output: 0.01 is 1%"
        ));
    }
    tolerances.sort_by(f64::total_cmp);
    tolerances.dedup();
    tolerances
}

fn relative_to(args: &TradeoffArgs, scene: Option<&Scene>) -> Scale {
    let own = scene.and_then(|scene| scene.tolerance.as_ref());
    let own = own.map(|tolerance| tolerance.relative_to);
    args.relative_to.or(own).unwrap_or(Scale::Actuator)
}

fn table(points: &[Point]) -> Table {
    let mut table = Table::new(
        "tolerance|scalar|sincos by=sines|mul|add|sincos|trig_mul|trig_add|bound|observed|rounding|front",
    );
    for own in points {
        let counts = own.counts();
        // What was not observed is no zero.
        let seen = |seen: Option<f64>| match seen {
            Some(seen) => Cell::power(seen, 2),
            None => Cell::of("–", Value::Null),
        };
        let sines = match own.variant.sines.is_empty() {
            true => Cell::from("libm"),
            false => Cell::of("poly", "polynomials"),
        };
        table.row(cells![
            Cell::of(format!("{:e}", own.tolerance), own.tolerance),
            own.variant.scalar.name(),
            sines,
            counts.mul,
            counts.add,
            counts.sincos,
            counts.trig_mul,
            counts.trig_add,
            Cell::power(own.bound, 2),
            seen(own.observed),
            Cell::power(own.rounding, 2),
            if own.dominated { "" } else { "yes" },
        ]);
    }
    table
}

fn drawn(title: &str, relative_to: Scale, points: &[Point]) -> String {
    let scale = match relative_to {
        Scale::Actuator => "the actuators' limits",
        Scale::Range => "the largest torques",
    };
    let dots = points.iter().map(|own| Dot {
        kind: own.kind(),
        cost: own.cost() as f64,
        bound: own.bound,
        observed: own.observed,
        dominated: own.dominated,
    });
    chart::svg(title, scale, &dots.collect::<Vec<Dot>>())
}
