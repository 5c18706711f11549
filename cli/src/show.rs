//! `dalembert show`: the arm in two views, as SVG.

use dalembert_model::number::Angle;
use dalembert_model::number::Rounded;
use dalembert_model::number::parse::parse_decimal;
use dalembert_model::robot::Robot;
use dalembert_report::drawing;

use crate::args::ShowArgs;
use crate::files::target::Target;
use crate::files::{distinct, write};
use crate::input;
use crate::outcome::{Failure, Outcome};

/// Runs the subcommand.
pub fn run(args: &ShowArgs) -> Outcome {
    let robot = input::robot(&args.robot)?;
    let target = match &args.output {
        None => Target::standard(),
        Some(path) => Target::at(path)?,
    };
    distinct::distinct(
        &[("the robot file", &args.robot)],
        &[("the drawing", &target)],
    )?;
    let svg = drawing::svg(&robot, &position(args, &robot)?)
        .map_err(|error| Failure::Input(format!("error: --at: {error}")))?;
    write::write(&[(&target, &svg)])
}

/// Where the joints are: at zero unless said.
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
