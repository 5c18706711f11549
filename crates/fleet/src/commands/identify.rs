//! `identify`: an arm's parameters, and its robot file.

use std::path::PathBuf;

use clap::Args;
use dalembert_fit::{Accumulator, Model, consistent, cross_validation, fit, identified};
use dalembert_model::robot::write;

use super::table::{number, table};
use crate::dynamics::{Dynamics, no_model};
use crate::error::Error;
use crate::job::{Job, LogArgs};
use crate::output::{self, Unfinished};
use crate::progress::Going;

#[derive(Args, Debug)]
pub(super) struct IdentifyArgs {
    #[command(flatten)]
    logs: LogArgs,
    /// Robot file to write, with bodies that exist
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

pub(super) async fn run(args: &IdentifyArgs, going: &Going) -> Result<String, Error> {
    if let Some(output) = &args.output {
        Unfinished::beside(output)?;
    }
    let mut job = Job::new(&args.logs, true, going).await?;
    let progress = job.progress.clone();
    let found = progress
        .shown(args.logs.progress, job.aggregates("_fit"))
        .await?;
    let robot = job.robot.clone();
    let names = job.logs.iter().map(|log| log.name.display().to_string());
    let names: Vec<String> = names.collect();
    let is_written = args.output.is_some();
    let solved = going.blocking(move |_| {
        let model = robot.model().ok_or_else(no_model)?;
        solve(model, &found, &names, is_written)
    });
    let (text, robot) = going.unless_ended(solved).await?;
    if let (Some(name), Some(robot)) = (&args.output, robot) {
        output::write(name, &robot)?;
    }
    Ok(text)
}

fn solve(
    model: &Model,
    found: &[Vec<u8>],
    names: &[String],
    is_written: bool,
) -> Result<(String, Option<String>), Error> {
    let files = found.iter();
    let files = files.map(|bytes| Accumulator::from_bytes(model, bytes));
    let files = files.collect::<Result<Vec<_>, _>>()?;
    let mut all = Accumulator::new(model);
    for file in &files {
        all.merge(file)?;
    }
    let fit = fit(model, &all)?;
    let mut rows = Vec::new();
    for k in 0..model.columns().len() {
        let [value, error] = [fit.parameters[k], fit.standard_errors[k]].map(number);
        rows.push([model.name(k), value, error]);
    }
    let mut text = table(["parameter", "value", "std. error"], rows);
    text += &format!("{} states, condition {:.0}\n", fit.states, fit.condition);
    for one in &fit.unexcited {
        text += &format!("not excited: {one}\n");
    }
    let mut rows = Vec::new();
    let mut add = |name: &str, before: &[f64], after: &[f64]| {
        for (i, (before, after)) in before.iter().zip(after).enumerate() {
            let [before, after] = [*before, *after].map(number);
            rows.push([name.to_owned(), (i + 1).to_string(), before, after]);
        }
    };
    let what = match files.len() {
        1 => {
            add(&names[0], &fit.before, &fit.after);
            "of the states of the fit: with more than one log, each is compared with what the \
             others say"
        }
        _ => {
            let each = cross_validation(model, &files)?;
            for (name, file) in names.iter().zip(&each) {
                add(name, &file.before, &file.after);
            }
            "of each log, with parameters from the others"
        }
    };
    let head = ["residuals, rms", "joint", "before", "after"];
    text += &format!("\n{}{what}\n", table(head, rows));
    if !is_written {
        return Ok((text, None));
    }
    let bodies = consistent(model, &fit)?;
    text += &format!(
        "bodies that exist: {:.2} standard errors from the free parameters altogether\n",
        bodies.distance
    );
    Ok((text, Some(write(&identified(model, &bodies)?))))
}
