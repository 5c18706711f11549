//! `identify`: an arm's parameters, and its robot file.

use std::path::PathBuf;

use clap::Args;
use dalembert_fit::robot_file::{replaceable, save};
use dalembert_fit::{
    Accumulator, Bodies, Fit, Model, consistent, cross_validation, fit, identified,
};
use dalembert_model::robot::Robot;

use super::{Report, number, table};
use crate::dynamics::{Dynamics, no_model};
use crate::error::Error;
use crate::job::{Job, LogArgs};
use crate::logs::Log;
use crate::output::Unfinished;
use crate::progress::Going;

#[derive(Args, Debug)]
pub(super) struct IdentifyArgs {
    #[command(flatten)]
    logs: LogArgs,
    /// Robot file to write, with physically consistent bodies
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

/// A joint is explained badly above this multiple of what the free parameters leave.
const BADLY: f64 = 1.5;
/// It is worse than before where it leaves so many times as much.
const WORSE: f64 = 1.01;

pub(super) async fn run(args: &IdentifyArgs, going: &Going) -> Result<Report, Error> {
    if let Some(output) = &args.output {
        Unfinished::beside(output)?;
        replaceable(output).map_err(|why| Error::new(why).at(output.display()))?;
    }
    let mut job = Job::new(&args.logs, true, going).await?;
    let progress = job.progress.clone();
    let computation = job.aggregates("_fit");
    let aggregates = progress.shown(args.logs.progress, computation).await?;
    let robot = job.robot.clone();
    let logs = job.logs.clone();
    let is_written = args.output.is_some();
    let solved = going.blocking(move |_| {
        let model = robot.model().ok_or_else(no_model)?;
        solve(model, &aggregates, &logs, is_written)
    });
    let (text, robot) = going.unless_ended(solved).await?;
    let written = match (&args.output, robot) {
        (Some(name), Some(robot)) => robot
            .and_then(|robot| save(name, &robot).map_err(|why| Error::new(why).at(name.display()))),
        _ => Ok(()),
    };
    let failed = written.err();
    Ok(Report { text, failed })
}

fn solve(
    model: &Model,
    aggregates: &[Vec<u8>],
    logs: &[Log],
    is_written: bool,
) -> Result<(String, Option<Result<Robot, Error>>), Error> {
    let read = |bytes: &Vec<u8>| Accumulator::from_bytes(model, bytes);
    let files: Vec<Accumulator> = aggregates.iter().map(read).collect::<Result<_, _>>()?;
    let mut total = Accumulator::new(model);
    for file in &files {
        total.merge(file)?;
    }
    let fit = fit(model, &total)?;
    let mut rows = Vec::new();
    for k in 0..model.columns().len() {
        let [value, error] = [fit.parameters[k], fit.standard_errors[k]].map(number);
        rows.push([model.name(k), value, error]);
    }
    let mut text = table(["parameter", "value", "std. error"], rows);
    text += &format!("{} states, condition {:.0}\n", fit.states, fit.condition);
    for (log, file) in logs.iter().zip(&files) {
        text += &log.told(file.states());
    }
    for one in &fit.unexcited {
        text += &format!("not excited: {one}\n");
    }
    let bodies = is_written.then(|| consistent(model, &fit));
    let written = match &bodies {
        Some(Ok(bodies)) => Some(bodies.file_parameters(model)),
        _ => None,
    };
    let mut rows = Vec::new();
    let mut add = |log: &Log, file: &Accumulator, [before, after]: [&[f64]; 2]| {
        let name = log.name.display().to_string();
        let residual = |parameters: &Vec<f64>| file.residual(model, parameters);
        let left = written.as_ref().map(residual).transpose()?;
        for (i, (before, after)) in before.iter().zip(after).enumerate() {
            let [before, after] = [*before, *after].map(number);
            let left = left.as_ref().map_or(String::new(), |left| number(left[i]));
            rows.push([name.clone(), (i + 1).to_string(), before, after, left]);
        }
        Ok::<(), dalembert_fit::Error>(())
    };
    let what = match files.len() {
        1 => {
            add(&logs[0], &total, [&fit.before, &fit.after])?;
            "of the states of the fit: with more than one log, each is compared with what the \
             others say"
        }
        _ => {
            let residuals = cross_validation(model, &files)?;
            for ((log, file), residual) in logs.iter().zip(&files).zip(&residuals) {
                add(log, file, [&residual.before, &residual.after])?;
            }
            "of each log, with parameters from the others"
        }
    };
    let last = written.as_ref().map_or("", |_| "written file");
    let head = ["residuals, rms", "joint", "before", "after", last];
    text += &format!("\n{}{what}\n", table(head, rows));
    let robot = bodies.map(|bodies| -> Result<Robot, Error> {
        let bodies = bodies?;
        text += &judged(model, &total, &fit, &bodies)?;
        Ok(identified(model, &bodies)?)
    });
    Ok((text, robot))
}

fn judged(model: &Model, total: &Accumulator, fit: &Fit, bodies: &Bodies) -> Result<String, Error> {
    let mut text = String::new();
    let written = total.residual(model, &bodies.file_parameters(model))?;
    let with_offsets = total.residual(model, &bodies.parameters)?;
    for (i, left) in written.iter().enumerate() {
        let is_worse = *left > WORSE * fit.before[i];
        if !is_worse && *left <= BADLY * fit.after[i] {
            continue;
        }
        let [before, after, residual] = [fit.before[i], fit.after[i], *left].map(number);
        let leaves = format!("joint {}: the written file leaves {residual}", i + 1);
        text += &match is_worse {
            true => format!("warning: {leaves}, more than the {before} before: "),
            false => format!("{leaves}, the free parameters {after}: "),
        };
        text += &match BADLY * with_offsets[i] < *left {
            true => format!(
                "its sensor has an offset of {}, which no robot file has; subtract it in the log\n",
                number(bodies.offset[i])
            ),
            false => "the free parameters belong to no real bodies and drives\n".to_owned(),
        };
    }
    if !bodies.stopped.is_empty() {
        let stopped = bodies.stopped.join(", ");
        text += &format!("stopped at 0, where less fits better: {stopped}");
        text += match stopped.contains("armature") {
            true => "; --without-rotors if torques are measured behind the gears\n",
            false => "\n",
        };
    }
    Ok(text)
}
