//! `dalembert certify`: checks generated code and certificates by `dalembert-checker`, which shares
//! no code with the generator.

use std::path::{Path, PathBuf};

use dalembert_checker::certify::{Line, RATE, Shown, certify};
use dalembert_checker::file::MOST_BYTES;
use dalembert_checker::{Fault, Output, audit, read};
use dalembert_codegen::workspace::{Setup, input_hash};
use dalembert_stamp::Stamp;
use serde_json::{Value, json};

use crate::args::values::{certified_parser, positive_parser};
use crate::output::{Context, Done, Failure, Outcome};
use crate::report::{Cell, Report, Table, cells};
use crate::source::{Source, text};

/// Arguments of `certify`.
#[derive(Debug, clap::Args)]
pub struct CertifyArgs {
    /// A generated file (.rs, .h), to check every function, or a certificate (.json), to check its
    /// text, its box and every bound
    #[arg(value_parser = certified_parser())]
    file: PathBuf,
    /// The robot that the file was generated for
    #[arg(long, value_name = "ROBOT")]
    robot: PathBuf,
    /// The scene that the file was generated for [default: the one it names]
    #[arg(long, value_name = "NAME")]
    scene: Option<String>,
    /// Accept errors up to this, relative to T, instead of the scene's tolerance; for
    /// certificates that `tradeoff` wrote for other tolerances
    #[arg(long, value_name = "E", value_parser = positive_parser())]
    tolerance: Option<f64>,
}

/// Runs the subcommand.
pub(crate) fn run(args: &CertifyArgs, context: &Context) -> Outcome {
    let source = text(&args.file, MOST_BYTES as u64)?;
    let robot = Source::open(context, &args.robot)?;
    let edited = origin(&args.file, &source, &robot)?;
    let kind = args.file.extension().and_then(|kind| kind.to_str());
    let done = match kind {
        Some("rs" | "h" | "hpp" | "hh" | "cuh" | "cu") => whole_file(args, &source, &robot)?,
        _ => certificates(args, &source, &robot)?,
    };
    if let (Some(note), false) = (edited, done.failed.is_empty()) {
        context.say(&note);
    }
    Ok(done)
}

/// Checks the claims of certificates.
fn certificates(args: &CertifyArgs, source: &str, robot: &Source) -> Outcome {
    let name = args.file.display();
    let claims = read(source).map_err(|fault| Failure::Input(format!("error: {name}: {fault}")))?;
    let mut report = Report::default();
    let (mut all, mut refused) = (Vec::new(), Vec::new());
    for (index, mut claim) in claims.into_iter().enumerate() {
        claim.scene = args.scene.clone().or(claim.scene);
        let found = audit(&claim, &robot.robot_file, args.tolerance);
        let found = found.map_err(|fault| match fault {
            Fault::Robot(..) => Failure::Input(format!("error: {fault}")),
            _ => Failure::Check(format!("error: {name}: `{}`: {fault}", claim.function)),
        })?;
        let (function, scalar) = (&found.name, &found.scalar);
        if !found.is_shown() {
            refused.push(format!("`{function}` in {scalar}"));
        }
        let scene = claim.scene.as_ref();
        let within = scene.map_or_else(String::new, |scene| format!(" in scene {scene}"));
        let before = if index > 0 { "\n" } else { "" };
        report.line(format!(
            "{before}`{function}` in {scalar}{within}, relative to T"
        ));
        let heads = "joint|T|real|rounding|bound|E|.tolerance|seen|finding=|.passed";
        let table = Table::new(heads).with(found.outputs.iter().map(row));
        all.push(json!({
            "file": name.to_string(),
            "function": function.to_string(),
            "scalar": scalar.to_string(),
            "scene": claim.scene,
            "outputs": table.json(),
            "passed": found.is_shown(),
        }));
        report.rows(table);
    }
    report.value("certificates", all);
    report.value("passed", refused.is_empty());
    let mut done = Done::from(report);
    if !refused.is_empty() {
        let refused = refused.join(", ");
        done.failed
            .push(format!("error: {name}: not shown: {refused}"));
    }
    Ok(done)
}

/// Returns the table row of an output, relative to T; absolute if T is zero.
fn row(output: &Output) -> Vec<Cell> {
    let relative = |x: f64| match output.scale {
        0.0 => x,
        scale => x / scale,
    };
    let cell = |x: f64| Cell::power(relative(x), 3);
    let found = &output.found;
    let finding = match (output.holds(), output.is_shown()) {
        _ if found.seen.off > output.claimed => "E is refuted at a state",
        (true, true) => "E holds",
        (true, false) => "E holds, but is above the tolerance",
        (false, true) => "E not shown; within the tolerance",
        (false, false) => "not shown",
    };
    // An entry of D has two: its row and its column.
    let joints = output.joints.iter().map(|joint| (joint + 1).to_string());
    cells![
        joints.collect::<Vec<_>>().join(", "),
        Cell::power(output.scale, 4),
        cell(found.edits),
        cell(found.rounding),
        cell(found.bound()),
        cell(output.claimed),
        Cell::json(output.tolerated.map(relative)),
        cell(found.seen.off),
        finding,
        Cell::json(output.is_shown()),
    ]
}

/// Checks every function of a file.
fn whole_file(args: &CertifyArgs, source: &str, robot: &Source) -> Outcome {
    let name = args.file.display();
    if args.tolerance.is_some() {
        return Err(Failure::Input(format!(
            "error: --tolerance is for a certificate, and `{name}` is a generated file"
        )));
    }
    let stamp = Stamp::read(source);
    let named = stamp
        .as_ref()
        .and_then(|(stamp, _)| stamp.asked.get("scene"));
    let scene = args.scene.as_deref().or(named);
    let mut scenes = robot.scenes.iter();
    let own = scenes.find(|own| Some(own.name.as_str()) == scene);
    if own.is_some_and(|own| own.tolerance.is_some()) {
        return Err(Failure::Input(format!(
            "error: `{name}` was generated under a tolerance\n  = help: its certificate holds the bounds: \
             `dalembert certify {} --robot {}`",
            args.file.with_extension("certificate.json").display(),
            args.robot.display()
        )));
    }
    let place = claim_of(&args.file);
    if !place.exists() {
        return Err(Failure::Input(format!(
            "error: there is no `{0}`, which says what `{name}` is to be compared with\n  = help: \
             `dalembert generate {1} -o {name}` writes it beside the code",
            place.display(),
            args.robot.display()
        )));
    }
    let claim = text(&place, MOST_BYTES as u64)?;
    let found = certify(source, &claim, &robot.robot_file, scene);
    let found = found.map_err(|fault: Fault| Failure::Input(format!("error: {fault}")))?;
    let mut report = Report::default();
    report.line(
        "Each function is the program that is claimed, its literals rounded once, and this is the robot's in real\n\
         numbers. What rounding costs is relative to the largest value of each entry, in a matrix of its row or\n\
         column; u is half an ulp of that value.",
    );
    if found.is_unlimited {
        let rates =
            format!("Joints without limits: velocities and accelerations up to {RATE} (SI).");
        report.line(rates);
    }
    let mut table = Table::new("module|function|rounding|units|states|why|passed");
    let mut module = "";
    for line in &found.lines {
        if line.module != module {
            module = &line.module;
            report.line(module);
        }
        report.line(format!("  {:<35} {}", line.name, words(line)));
        let own = line.result.as_ref().ok();
        table.row(cells![
            line.module.as_str(),
            line.name.as_str(),
            Cell::json(own.map(|own| own.rounding)),
            Cell::json(own.map(|own| own.units)),
            Cell::json(own.map(|own| own.states)),
            Cell::json(line.result.as_ref().err().map(ToString::to_string)),
            Cell::json(own.is_some()),
        ]);
    }
    report.value("file", name.to_string());
    report.value("functions", table.json());
    report.value("passed", found.is_shown());
    let mut done = Done::from(report);
    if !found.is_shown() {
        let why = format!("error: some functions of {name} are not shown to be correct");
        done.failed.push(why);
    }
    Ok(done)
}

/// Returns where the claim of a file is: both scalars in Rust have one.
pub(crate) fn claim_of(file: &Path) -> PathBuf {
    let own = file.with_extension("claim.json");
    let stem = file.file_stem().unwrap_or_default().to_string_lossy();
    match stem.strip_suffix("_f32") {
        Some(base) if !own.exists() => file.with_file_name(format!("{base}.claim.json")),
        _ => own,
    }
}

/// Formats the result of a function.
fn words(line: &Line) -> String {
    match &line.result {
        Err(fault) => format!("not shown: {fault}"),
        Ok(Shown {
            rounding,
            units,
            states,
            has_polynomials,
        }) => {
            let of = if *has_polynomials {
                "sines and rounding"
            } else {
                "rounding"
            };
            let over = match states {
                0 => "over the box".to_owned(),
                count => format!("at {count} states"),
            };
            format!("shown; {of} {rounding:>9.2e} {units:>9.0} u {over}")
        }
    }
}

/// Refuses a file of another robot; returns a note if the robot was edited since.
///
/// # Errors
/// The file names another robot.
fn origin(file: &Path, source: &str, robot: &Source) -> Result<Option<String>, Failure> {
    let own = &robot.robot;
    // A certificate has the hash of the robot in its scene.
    let scenes = robot.scenes.iter().map(Some).chain([None]);
    let placed = scenes.filter_map(|scene| Setup::in_scene(own, scene).ok());
    let mut hashes: Vec<String> = placed.map(|placed| input_hash(placed.robot())).collect();
    let hash = input_hash(own);
    hashes.push(hash.clone());
    let is_own = |input: &str| input.len() >= 16 && hashes.iter().any(|own| own.starts_with(input));
    let origins = named(source).into_iter();
    let others = origins.filter(|(_, input)| !is_own(input));
    // Another robot's name is reported before an edit of this one.
    let Some((name, input)) = others.min_by_key(|(name, _)| *name == own.name) else {
        return Ok(None);
    };
    let found = format!(
        "`{}` is of robot `{name}`, input {input:.16}; `{}` is robot `{}`, input {hash:.16}",
        file.display(),
        robot.path.display(),
        own.name
    );
    match name == own.name {
        true => Ok(Some(format!(
            "note: {found}: the robot file was edited since"
        ))),
        false => Err(Failure::Check(format!(
            "error: {found}\n  = help: give --robot the robot file that it was generated from"
        ))),
    }
}

/// Returns the robot names and input hashes in the documentation of a generated file, or in the
/// fields of certificates.
fn named(source: &str) -> Vec<(String, String)> {
    let documentation = source.split_once("Dynamics of the robot `");
    let origin = documentation.and_then(|(_, rest)| {
        let (robot, rest) = rest.split_once('`')?;
        let input = rest.split_once("Input hash ")?.1.split('.').next()?;
        Some((robot.to_owned(), input.to_owned()))
    });
    let document: Value = serde_json::from_str(source).unwrap_or_default();
    let one = std::slice::from_ref(&document);
    let certificates = document.as_array().map_or(one, Vec::as_slice).iter();
    let fields = certificates.filter_map(|certificate| {
        let field = |key: &str| Some(certificate[key].as_str()?.to_owned());
        Some((field("robot")?, field("input")?))
    });
    origin.into_iter().chain(fields).collect()
}
