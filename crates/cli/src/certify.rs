//! `dalembert certify`: checks generated code by `dalembert-checker`, which shares no formula with the
//! generator.

use std::path::{Path, PathBuf};

use dalembert_checker::certify::{
    Cost, Demand, Findings, FunctionReport, RATE, ResultBound, certify,
};
use dalembert_checker::file::MOST_BYTES;
use dalembert_codegen::workspace::{bound_of, input_hash};
use dalembert_import::ChainArgs;
use dalembert_model::robot::Robot;
use dalembert_model::scene::Scene;
use dalembert_stamp::Stamp;

use crate::args::values::{certified_parser, positive_parser};
use crate::output::{Context, Done, Failure, Outcome};
use crate::report::{Cell, Report, Table, WIDTH, broken, cells};
use crate::source::{Source, text};

/// Arguments of `certify`.
///
/// A function is shown if its text is the claimed program, each literal rounded once, that program gives the
/// robot's results in real numbers, and rounding has a bound at every state of the box. It is measured if
/// it divides: then rounding is bounded at some 1500 states alone. Rounding errors are relative to the
/// largest value of an entry at random states of the box, in a matrix of its row or column; u is 2^-53 in
/// f64, 2^-24 in f32.
#[derive(Debug, clap::Args)]
pub struct CertifyArgs {
    /// A generated file (.rs, .h), whose claim stands beside it: NAME.claim.json
    #[arg(value_parser = certified_parser())]
    file: PathBuf,
    /// The robot that the file was generated for
    #[arg(long, value_name = "ROBOT")]
    robot: PathBuf,
    /// The scene that the file was generated for [default: the one it names]
    #[arg(long, value_name = "NAME")]
    scene: Option<String>,
    /// Accept errors up to this times T instead of the scene's tolerance. T is the actuator's limit or the
    /// largest value of the result, as the claim says. For the files that `tradeoff` writes
    #[arg(long, value_name = "E", value_parser = positive_parser())]
    tolerance: Option<f64>,
    /// Accept rounding errors up to this part of the largest value [default: 1/64 in f32 and of polynomials
    /// for sines, 1.9e-9 in f64]
    #[arg(long, value_name = "SHARE", value_parser = positive_parser())]
    worst: Option<f64>,
    /// Exit with 1 if a function is measured instead of shown
    #[arg(long)]
    strict: bool,
    #[command(flatten)]
    chain: ChainArgs,
}

pub(crate) fn run(args: &CertifyArgs, context: &Context) -> Outcome {
    let source = text(&args.file, MOST_BYTES as u64)?;
    let robot = Source::open(context, &args.robot, &args.chain)?;
    let edited = origin(args, &source, &robot)?;
    let done = checked(args, &source, &robot)?;
    if let (Some(note), false) = (edited, done.failed.is_empty()) {
        context.say(&note);
    }
    Ok(done)
}

const RESULTS: &str = "result|joint|T|real|rounding|E|.tolerance";

/// Values are relative to T; absolute if T is zero. `base` is the number of coordinates of a base that
/// floats in the scene.
fn row(result: &ResultBound, robot: &Robot, base: usize) -> Vec<Cell> {
    let cell = |x: f64| Cell::of(bound_of(x, 4), x);
    let bound = result.relative();
    // An entry of D has two: its row and its column.
    let label = |coordinate: &usize| match coordinate.checked_sub(base) {
        Some(joint) => (joint + 1).to_string(),
        None => robot.coordinate_label(*coordinate),
    };
    cells![
        result.field.clone(),
        Vec::from_iter(result.joints.iter().map(label)).join(", "),
        Cell::of(bound_of(result.scale, 5), result.scale),
        cell(bound.real),
        cell(bound.rounding),
        cell(bound.total()),
        Cell::json(result.tolerated / result.unit()),
    ]
}

fn checked(args: &CertifyArgs, source: &str, robot: &Source) -> Outcome {
    let name = args.file.display();
    let stamp = Stamp::read(source);
    let stamp_scene = stamp.iter().find_map(|(stamp, _)| stamp.asked.get("scene"));
    let scene = args.scene.as_deref().or(stamp_scene);
    let place = claim_of(&args.file);
    if !place.exists() {
        return Err(Failure::Input(format!(
            "error: there is no `{0}`, the claim that `{name}` is compared with\n  = help: \
             `dalembert generate {1} -o {name}` writes it beside the code",
            place.display(),
            args.robot.display()
        )));
    }
    let claim = text(&place, MOST_BYTES as u64)?;
    let demand = Demand {
        scene,
        tolerance: args.tolerance,
        worst: args.worst,
    };
    let certificate = certify(source, &claim, &robot.robot_file, &demand)
        .map_err(|fault| Failure::Input(format!("error: {fault}")))?;
    let mut report = Report::default();
    let has_results = |line: &FunctionReport| {
        let findings = line.result.as_ref();
        findings.is_ok_and(|findings| !findings.results.is_empty())
    };
    report.line(match certificate.lines.iter().any(has_results) {
        false => {
            "shown: apart from rounding, the code gives the robot's results at every state of the box.\n\
             rounding: the largest error, as a part of the largest value of that result, and in u: 2^-53 in f64, 2^-24 in f32."
        }
        true => {
            "shown: at every state of the box each result is within E of the robot's, relative to T."
        }
    });
    if let Some(scene) = scene {
        report.line(format!("Scene `{scene}`."));
    }
    report.value("scene", scene);
    let of_name = |candidate: &&Scene| Some(candidate.name.as_str()) == scene;
    let base = match robot.scenes.iter().find(of_name) {
        Some(scene) => scene.base_coordinates(&robot.robot),
        None => robot.robot.base_coordinates(),
    };
    if certificate.is_unlimited {
        let rates =
            format!("Joints without limits: velocities and accelerations up to {RATE} (SI).");
        report.line(rates);
    }
    if let Some((body, is_default)) = certificate.payloads {
        let default = ["", " (no range is given)"][usize::from(is_default)];
        report.line(format!("Payloads: {body}{default}."));
    }
    for (link, body) in &certificate.bodies {
        report.line(format!("Bodies of link {link}: {body}."));
    }
    let mut table = Table::new("module|function|rounding|units|states|bounded|why|passed");
    let mut module = "";
    for line in &certificate.lines {
        if line.module != module {
            module = &line.module;
            report.line(module);
        }
        let words = broken(&words(line), WIDTH - 38).join(&format!("\n{}", " ".repeat(38)));
        report.line(format!("  {:<35} {words}", line.name));
        let findings = line.result.as_ref().ok();
        let worst = findings.and_then(worst);
        if let Some(details) = findings.filter(|details| !details.results.is_empty()) {
            let bounds = details.results.iter();
            let rows = bounds.map(|result| row(result, &robot.robot, base));
            let results = Table::new(RESULTS).with(rows);
            report.value(&format!("within/{}", line.name), results.json());
            report.rows(results);
        }
        table.row(cells![
            line.module.as_str(),
            line.name.as_str(),
            Cell::json(worst.map(|cost| cost.rounding)),
            Cell::json(worst.map(|cost| cost.units)),
            Cell::json(worst.map(|cost| cost.states)),
            Cell::json(findings.map(Findings::is_bounded)),
            Cell::json(line.result.as_ref().err().map(ToString::to_string)),
            Cell::json(findings.is_some()),
        ]);
    }
    report.value("file", name.to_string());
    report.value("functions", table.json());
    report.value("passed", certificate.passes(args.strict));
    let mut done = Done::from(report);
    if !certificate.passes(args.strict) {
        let why = match certificate.passes(false) {
            true => format!(
                "error: --strict is set, and some functions of {name} are measured, not shown"
            ),
            false => format!("error: some functions of {name} are not shown to be correct"),
        };
        done.failed.push(why);
    }
    Ok(done)
}

/// Both scalars in Rust have one claim.
pub(crate) fn claim_of(file: &Path) -> PathBuf {
    let claim = file.with_extension("claim.json");
    let stem = file.file_stem().unwrap_or_default().to_string_lossy();
    match stem.strip_suffix("_f32") {
        Some(base) if !claim.exists() => file.with_file_name(format!("{base}.claim.json")),
        _ => claim,
    }
}

fn words(line: &FunctionReport) -> String {
    match &line.result {
        Err(fault) => format!("not shown: {fault}"),
        Ok(shown) if !shown.results.is_empty() => "shown to be within the tolerance".into(),
        Ok(shown) => {
            let of = match shown.has_polynomials {
                true => "sines and rounding",
                false => "rounding",
            };
            let of_cost = |cost: &Cost| {
                let (rounding, units) = (cost.rounding, cost.units);
                let over = match cost.states {
                    0 if cost.is_of_whole => "of the largest entry, over the box".to_owned(),
                    0 => "over the box".to_owned(),
                    count => format!("at {count} states"),
                };
                match rounding.is_finite() {
                    true => format!("{of} {rounding:>9.2e} {units:>9.0} u {over}"),
                    false => format!("no bound of {of} {over}"),
                }
            };
            let of_kind = |is_bounded| shown.worst(is_bounded).map(of_cost);
            match (of_kind(false), of_kind(true)) {
                (None, bounded) => format!("shown; {}", bounded.unwrap_or_default()),
                (Some(measured), None) => format!("measured, not shown; {measured}"),
                (Some(measured), Some(bounded)) => {
                    let costs = shown.costs.iter().filter(|cost| cost.is_bounded);
                    let names = Vec::from_iter(costs.map(|cost| cost.name.as_str())).join(", ");
                    format!("measured, not shown; {measured}; of {names} {bounded}")
                }
            }
        }
    }
}

/// Returns the cost of what is measured, else of what is bounded.
fn worst(shown: &Findings) -> Option<&Cost> {
    shown.worst(false).or_else(|| shown.worst(true))
}

/// Returns a note if the robot was edited since; fails if the file names another one, or another chain.
fn origin(args: &CertifyArgs, source: &str, robot: &Source) -> Result<Option<String>, Failure> {
    let file = &args.file;
    let (arm, hash) = (&robot.robot, input_hash(&robot.robot));
    let is_own = |input: &str| input.len() >= 16 && hash.starts_with(input);
    let Some((name, input)) = named(source).filter(|(_, input)| !is_own(input)) else {
        return Ok(None);
    };
    let chain = Stamp::read(source).and_then(|(stamp, _)| ChainArgs::from_pairs(&stamp.chain));
    if let Some(chain) = chain.filter(|chain| robot.is_model && *chain != args.chain) {
        let help = match chain.pairs().is_empty() {
            true => format!("leave out {}: the file was generated without", args.chain),
            false => format!("give {chain}: the file was generated with that"),
        };
        return Err(Failure::Input(format!(
            "error: `{}` was generated for another chain of `{}`\n  = help: {help}",
            file.display(),
            robot.path.display()
        )));
    }
    let mismatch = format!(
        "`{}` is of robot `{name}`, input {input:.16}; `{}` is robot `{}`, input {hash:.16}",
        file.display(),
        robot.path.display(),
        arm.name
    );
    match *name == arm.name {
        true => Ok(Some(format!(
            "note: {mismatch}: the robot file was edited since"
        ))),
        false => Err(Failure::Check(format!(
            "error: {mismatch}\n  = help: give --robot the robot file that it was generated from"
        ))),
    }
}

/// Returns the robot's name and input hash in the documentation of a generated file.
fn named(source: &str) -> Option<(&str, &str)> {
    let (_, rest) = source.split_once("Dynamics of the robot `")?;
    let (robot, rest) = rest.split_once('`')?;
    let input = rest.split_once("Input hash ")?.1.split('.').next()?;
    Some((robot, input))
}
