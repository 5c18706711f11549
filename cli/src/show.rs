//! `dalembert show`: the arm in two views, as SVG.

use crate::drawing;
use dalembert_model::equations::matrix::Columns;
use dalembert_model::number::Angle;
use dalembert_model::number::Rounded;
use dalembert_model::number::parse::parse_decimal;
use dalembert_model::reference::{Reference, WrongLength};
use dalembert_model::robot::{JointKind, Position, Robot};
use nalgebra::DVector;
use serde_json::{Value, json};

use crate::args::ShowArgs;
use crate::files::target::Target;
use crate::files::{distinct, write};
use crate::outcome::{Failure, Outcome};
use crate::{input, output};

/// Runs the subcommand.
pub fn run(args: &ShowArgs) -> Outcome {
    let robot = input::robot(&args.robot)?;
    let target = Target::output(args.output.as_deref(), args.json)?;
    distinct::distinct(
        &[("the robot file", &args.robot)],
        &[("the drawing", &target)],
    )?;
    target.ends_in("svg")?;
    if !args.force {
        target.ours()?;
    }
    let at = position(args, &robot)?;
    for (index, (text, q)) in args.at.iter().zip(&at).enumerate() {
        if let Some(warning) = doubtful(&robot, index, text, *q) {
            output::note(&warning);
        }
    }
    let wrong = |error| Failure::Input(format!("error: --at: {error}"));
    let svg = drawing::svg(&robot, &at).map_err(wrong)?;
    if !args.json {
        return write::write(&[(&target, &svg)]);
    }
    let poses = json(&robot, &at).map_err(wrong)?;
    if args.output.is_some() {
        write::write(&[(&target, &svg)])?;
    }
    output::print_json(&poses)
}

/// Returns where everything is: each pose is [R | p], row by row, in base axes.
fn json(robot: &Robot, at: &[f64]) -> Result<Value, WrongLength> {
    let runtime = Reference::<f64>::from_robot(robot);
    let q = DVector::from_column_slice(at);
    let rows = |pose: &Columns<f64>| {
        let rows = pose.rows();
        rows.chunks(4).map(<[f64]>::to_vec).collect::<Vec<_>>()
    };
    let poses = runtime.poses(&q)?;
    let links = robot
        .rows()
        .into_iter()
        .zip(&poses)
        .map(|(joint, pose)| json!({ "joint": joint.name, "pose": rows(pose) }));
    Ok(json!({
        "robot": robot.name,
        "input": robot.short_hash(),
        "at": at,
        "links": links.collect::<Vec<_>>(),
        "hand": rows(&runtime.hand(&q)?),
    }))
}

/// Returns what is odd about a position of a joint: beyond its limits, or more than a turn. A
/// number by itself is of radians, and was perhaps meant otherwise.
fn doubtful(robot: &Robot, index: usize, text: &str, q: f64) -> Option<String> {
    let joint = robot.joints.get(index)?;
    let limits = joint
        .limits
        .position
        .as_ref()
        .map(|ends| ends.each_ref().map(Position::to_f64));
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
            format!("\n  = help: radians? {q} degrees are {radians:.4}, or write {q}deg")
        }
        _ => String::new(),
    };
    let label = robot.joint_label(index);
    Some(format!(
        "warning: --at: {label} at {q} {unit} is {what}{help}"
    ))
}

/// Returns where the joints are: at zero unless said.
fn position(args: &ShowArgs, robot: &Robot) -> Result<Vec<f64>, Failure> {
    if args.at.is_empty() {
        return Ok(vec![0.0; robot.joints.len()]);
    }
    let value = |text: &String| match parse_decimal(text.trim()) {
        Ok(number) => Ok(f64::nearest_rational(&number)),
        Err(error) => Angle::parse(text).map(|angle| angle.to_f64()).map_err(|_| {
            Failure::Input(format!(
                "error: --at: `{text}` is {error}\n  = help: a position a joint, in rad or m, \
                 separated by commas, e.g. 0,pi/2,0.1"
            ))
        }),
    };
    args.at.iter().map(value).collect()
}
