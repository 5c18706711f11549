//! `dalembert tradeoff`: what accuracy costs, certified and observed.
//!
//! - this file: what is asked for
//! - [`report`]: the table, for people and as CSV
//! - [`chart`]: the front as SVG

mod chart;
mod report;

use std::path::Path;

use crate::sweep::ladder::{Ladder, Options};
use crate::sweep::{Point, mark};
use dalembert_codegen::workspace::{ErrorBudget, SceneKey, SceneRobot, plan_file};
use dalembert_codegen::{Function, GenerateError, Plan, Program, Request, ScalarType, generate};
use dalembert_model::read::Reading;
use dalembert_model::scene::{Scale, Scene};
use serde_json::json;

use crate::args::TradeoffArgs;
use crate::files::folder::Folder;
use crate::outcome::{Failure, Outcome};
use crate::progress::{self, Steps};
use crate::{input, output};

/// Tolerances unless others are asked for; zero is always there.
const TOLERANCES: [f64; 10] = [1e-12, 1e-10, 1e-8, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 5e-2, 1e-1];

/// The files that are written.
const CSV: &str = "tradeoff.csv";
const SVG: &str = "tradeoff.svg";
const CERTIFICATES: &str = "certificates";

/// Runs the subcommand.
pub fn run(args: &TradeoffArgs) -> Outcome {
    let reading = input::reading(&args.robot)?;
    let scene = args.scene.as_ref();
    let scene = scene.map(|name| input::scene(&args.robot, &reading, name));
    let scene = scene.transpose()?;
    let tolerances = tolerances(args)?;
    // Before the work: a folder that cannot be is no news an hour later.
    let output = match &args.output {
        None => None,
        Some(folder) => {
            let output = Folder::at(folder, &[CSV, SVG], Some(&args.robot))?;
            Folder::at(&folder.join(CERTIFICATES), &[], None)?;
            Some(output)
        }
    };
    // Its own tolerance is one of many here.
    let bare = scene.map(Scene::without_tolerance);
    let scene_robot =
        SceneRobot::of(&reading.robot, bare.as_ref()).map_err(GenerateError::Scene)?;
    let exact = exact(args, &reading, scene, bare.as_ref())?;
    let relative_to = relative_to(args, scene);
    let frame = ErrorBudget::new(&scene_robot, &exact, relative_to).map_err(|refusal| {
        Failure::Input(format!(
            "error: {}: {refusal}\n  = help: give the limits in the robot file, or the box of a scene",
            args.robot.display()
        ))
    })?;
    // Every tolerance and the exact program: searched for, then falsified.
    let steps = Steps::new(2 * (1 + tolerances.len()));
    let watch = steps.watch();
    let frame = frame.watched(watch.over(exact.function));
    let options = Options {
        samples: args.samples,
        climbs: args.climbs,
        effort: args.effort,
    };
    let ladder = Ladder::new(options, &frame, &steps);
    let mut points = ladder
        .climb(&tolerances)
        .map_err(|error| Failure::Check(format!("error: {error}")))?;
    drop(steps);
    mark(&mut points);
    match args.json {
        true => output::print_json(&json!({
            "robot": reading.robot.name,
            "input": reading.robot.short_hash(),
            "scene": scene.map(|scene| &scene.name),
            "function": exact.function.name(),
            "relative_to": word(relative_to),
            "variants": points.iter().map(report::json).collect::<Vec<_>>(),
        }))?,
        false => output::print(&report::table(&points))?,
    }
    if let Some(folder) = &output {
        let chart = chart(&reading, scene, exact.function, relative_to, &points);
        folder.write(&files(chart, &points))?;
        output::note(&format!("wrote {}", folder.path().display()));
    }
    let violated = points.iter().filter_map(|point| {
        let why = point.violation.as_ref()?;
        Some(format!("error: {} is violated: {why}", point.file()))
    });
    let violated: Vec<String> = violated.collect();
    match violated.is_empty() {
        true => Ok(()),
        false => Err(Failure::Check(violated.join("\n"))),
    }
}

/// Returns the chart, the table and the certificates, by name.
fn files(chart: String, points: &[Point]) -> Vec<(String, String)> {
    let mut files = vec![(SVG.into(), chart), (CSV.into(), report::csv(points))];
    files.extend(points.iter().map(|point| {
        let name = format!("{CERTIFICATES}/{}", point.file());
        (name, point.certificate.to_json())
    }));
    files
}

/// Returns the tolerances, ascending, each once.
fn tolerances(args: &TradeoffArgs) -> Result<Vec<f64>, Failure> {
    let mut tolerances = match args.tolerances.as_slice() {
        [] => TOLERANCES.to_vec(),
        given => given.to_vec(),
    };
    if let Some(bad) = tolerances.iter().find(|t| !(t.is_finite() && **t > 0.0)) {
        return Err(Failure::Input(format!(
            "error: a tolerance is a number above zero, not {bad}\n  = help: --tolerances 1e-3,1e-2"
        )));
    }
    if let Some(large) = tolerances.iter().find(|t| **t >= 1.0) {
        output::note(&format!(
            "warning: a tolerance of {large} allows an error as large as the output: 0.01 is 1%"
        ));
    }
    tolerances.sort_by(f64::total_cmp);
    tolerances.dedup();
    Ok(tolerances)
}

/// Returns what was asked for, else the scene's scale, else the actuators.
fn relative_to(args: &TradeoffArgs, scene: Option<&Scene>) -> Scale {
    let own = scene.and_then(|scene| scene.tolerance.as_ref());
    let own = own.map(|tolerance| tolerance.relative_to);
    let asked = args.relative_to.as_deref();
    let mut words = Scale::WORDS.into_iter();
    let asked = words.find(|(word, _)| Some(*word) == asked);
    asked
        .map(|(_, scale)| scale)
        .or(own)
        .unwrap_or(Scale::Actuator)
}

/// Returns what a scale is called on the command line.
fn word(scale: Scale) -> &'static str {
    let mut words = Scale::WORDS.into_iter();
    let found = words.find(|(_, other)| *other == scale);
    found.map_or("", |(word, _)| word)
}

/// Draws the operations over the certified errors.
fn chart(
    reading: &Reading,
    scene: Option<&Scene>,
    function: Function,
    scale: Scale,
    points: &[Point],
) -> String {
    let scene = scene.map_or_else(String::new, |scene| format!(", scene {}", scene.name));
    let title = format!("{}{scene}: {function}", reading.robot.name);
    let scale = match scale {
        Scale::Actuator => "the actuators' limits",
        Scale::Range => "the largest torques",
    };
    chart::of_operations(&title, scale, points)
}

/// Returns the exact program, which tolerances are applied to: from the plan if there is
/// one, of the scene without its own.
fn exact(
    args: &TradeoffArgs,
    reading: &Reading,
    scene: Option<&Scene>,
    bare: Option<&Scene>,
) -> Result<Program, Failure> {
    let first = scene.and_then(|scene| scene.outputs.first().copied());
    let first = first.map_or(Function::InverseDynamics, Function::from);
    let mut plan = kept(&args.robot)?;
    if let (Some(plan), Some(scene), Some(bare)) = (&mut plan, scene, bare) {
        for entry in &mut plan.entries {
            if entry.scene == Some(SceneKey::of(scene)) {
                entry.scene = Some(SceneKey::of(bare));
                entry.edited = None;
            }
        }
    }
    let mut request = Request {
        scalars: vec![ScalarType::F64],
        effort: args.effort,
        plan,
        scene: bare.cloned(),
        ..Request::of(&[args.function.unwrap_or(first)])
    };
    let session = progress::watch(&mut request);
    let mut functions = generate(&reading.robot, &request)?.functions.into_iter();
    drop(session);
    let first = functions.next().map(|function| function.program);
    first.ok_or_else(|| Failure::from(GenerateError::Empty))
}

fn kept(robot: &Path) -> Result<Option<Plan>, Failure> {
    plan_file::beside(robot).map_err(|message| Failure::Input(format!("error: {message}")))
}
