//! `dalembert show`: draws the arm in two views, as SVG.

use std::path::PathBuf;

use dalembert_import::ChainArgs;
use dalembert_model::diagnostic::Diagnostic;
use dalembert_model::equations::matrix::Columns;
use dalembert_model::number::parse::parse_decimal;
use dalembert_model::number::{Angle, Rounded};
use dalembert_model::reference::Reference;
use dalembert_model::robot::{JointKind, Position, Robot};
use dalembert_stamp::{Comment, sealed};
use nalgebra::DVector;
use serde_json::Value;

use crate::drawing;
use crate::files::{Files, ends_in};
use crate::output::{Context, Done, Failure, Outcome};
use crate::report::{Cell, Report, Table, cells};
use crate::source::Source;

/// Arguments of `show`.
#[derive(Debug, clap::Args)]
pub struct ShowArgs {
    /// The robot: a robot file, a URDF or an MJCF
    robot: PathBuf,
    /// The joint positions in rad or m, such as 0.3, pi/2 or 90deg, separated by commas
    /// [default: zeros]
    #[arg(
        long,
        value_name = "Q",
        value_delimiter = ',',
        allow_hyphen_values = true
    )]
    at: Vec<String>,
    /// Write the drawing here [default: standard output; with --json nothing is drawn]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    #[command(flatten)]
    chain: ChainArgs,
}

pub(crate) fn run(args: &ShowArgs, context: &Context) -> Outcome {
    let source = Source::open(context, &args.robot, &args.chain)?;
    let robot = &source.robot;
    let output = args.output.as_deref();
    let is_drawn = output.is_some() || !context.json;
    ends_in(output, "svg")?;
    let mut files = Files::new(context, &[&args.robot]);
    let target = is_drawn.then(|| files.output(output)).transpose()?;
    let at = position(args, robot)?;
    for (index, (text, q)) in args.at.iter().zip(&at).enumerate() {
        if let Some(warning) = doubtful(robot, index, text, *q) {
            context.say(&warning);
        }
    }
    let wrong = |error| Failure::input(format!("--at: {error}"));
    let svg = drawing::svg(robot, &at).map_err(wrong)?;
    let svg = sealed(Comment::Xml, "dalembert show", &svg);
    Ok(Done {
        files: target.map(|target| (target, svg)).into_iter().collect(),
        ..Done::from(poses(robot, &at).map_err(wrong)?)
    })
}

/// Returns the poses of links and hand as JSON: each is [R | p], row by row, in base axes.
fn poses(robot: &Robot, at: &[f64]) -> Result<Report, Diagnostic> {
    let runtime = Reference::<f64>::from_robot(robot);
    let q = DVector::from_column_slice(at);
    let rows = |pose: &Columns<f64>| -> Value { pose.rows().chunks(4).map(Value::from).collect() };
    let mut links = Table::new("joint|pose");
    for (joint, pose) in robot.rows().into_iter().zip(&runtime.poses(&q)?) {
        let name = Cell::json(joint.name.clone());
        links.row(cells![name, Cell::json(rows(pose))]);
    }
    let mut report = Report::default();
    report.value("robot", robot.name.as_str());
    report.value("input", robot.short_hash());
    report.value("at", at);
    report.value("links", links.json());
    if !robot.is_tree() {
        report.value("hand", rows(&runtime.hand(&q)?));
    }
    Ok(report)
}

/// A number without a unit is in radians, but may have been meant in degrees.
fn doubtful(robot: &Robot, index: usize, text: &str, q: f64) -> Option<String> {
    let joint = robot.joints.get(index)?;
    let range = joint.limits.position.as_ref();
    let limits = range.map(|ends| ends.each_ref().map(Position::to_f64));
    let turns = joint.kind == JointKind::Revolute;
    let what = match limits {
        Some([low, high]) if q < low || q > high => {
            format!("beyond its limits, {low:.4} to {high:.4}")
        }
        _ if turns && q.abs() > 2.0 * std::f64::consts::PI => "more than a turn".to_owned(),
        _ => return None,
    };
    let unit = if turns { "rad" } else { "m" };
    let help = match parse_decimal(text.trim()) {
        Ok(_) if turns => {
            let radians = q.to_radians();
            format!("\n  = help: {q} is in radians; for degrees write {q}deg ({radians:.4} rad)")
        }
        _ => String::new(),
    };
    let label = robot.joint_label(index);
    Some(format!(
        "warning: --at: {label} at {q} {unit} is {what}{help}"
    ))
}

fn position(args: &ShowArgs, robot: &Robot) -> Result<Vec<f64>, Failure> {
    if args.at.is_empty() {
        return Ok(vec![0.0; robot.joints.len()]);
    }
    let value = |text: &String| {
        let error = match parse_decimal(text.trim()) {
            Ok(number) => return Ok(f64::nearest_rational(&number)),
            Err(error) => error,
        };
        let angle = Angle::parse(text).map(|angle| angle.to_f64());
        angle.map_err(|_| {
            Failure::Input(format!(
                "error: --at: `{text}` is {error}\n  = help: give one position per joint, in rad or m, \
                 separated by commas, e.g. 0,pi/2,0.1"
            ))
        })
    };
    args.at.iter().map(value).collect()
}
