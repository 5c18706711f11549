//! `residual`: how far measured torques are from the model's.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use clap::{Args, ValueEnum};
use dalembert_fit::Watch;

use super::{number, table};
use crate::dynamics::Dynamics;
use crate::engine::locate;
use crate::error::Error;
use crate::functions::{Joint, Residuals};
use crate::job::{Job, LogArgs};
use crate::logs::{Log, Table, canonical_names, walk};
use crate::output::{self, Unfinished};
use crate::picture::{Curves, picture};
use crate::progress::Going;

#[derive(Args, Debug)]
pub(super) struct ResidualArgs {
    #[command(flatten)]
    logs: LogArgs,
    /// Parquet file of all states and their residuals; always written by this machine
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// SVG of the worst files' residuals over time
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
    /// The number of files that the SVG shows
    #[arg(long, value_name = "COUNT", default_value_t = 3)]
    worst: usize,
    /// List the times at which residuals change
    #[arg(long, value_enum)]
    watch_for: Option<WatchFor>,
    /// Bar of cumulative sums, in units of a joint's noise
    #[arg(long, value_name = "SUM", default_value_t = 40.0)]
    bar: f64,
    /// A log in which nothing happens: noise and bar are taken from it
    #[arg(long, value_name = "FILE")]
    quiet: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum WatchFor {
    /// Contacts: residuals that change for a short time
    Collision,
}

pub(super) async fn run(args: &ResidualArgs, going: &Going) -> Result<String, Error> {
    for output in [&args.output, &args.svg].into_iter().flatten() {
        // Before anything is computed for it.
        Unfinished::beside(output)?;
    }
    let mut job = Job::new(&args.logs, false, going).await?;
    let passes = usize::from(args.output.is_some()) + usize::from(args.watch_for.is_some());
    if passes > 0 || args.svg.is_some() {
        job.tell_local("-o, --svg and --watch-for");
    }
    job.progress.expect(passes as u64 * job.rows());
    let progress = job.progress.clone();
    let computation = computed(args, &mut job);
    progress.shown(args.logs.progress, computation).await
}

async fn computed(args: &ResidualArgs, job: &mut Job) -> Result<String, Error> {
    let log_residuals = summaries(job).await?;
    let mut text = summary(job, &log_residuals);
    if args.watch_for.is_some() {
        text += &watched(args, job, &log_residuals).await?;
    }
    let svg = match &args.svg {
        Some(_) => Some(drawn(args, job, &log_residuals).await?),
        None => None,
    };
    if let Some(output) = &args.output {
        write_residuals(job, output).await?;
    }
    if let (Some(name), Some(svg)) = (&args.svg, svg) {
        output::write(name, &svg)?;
    }
    Ok(text)
}

async fn summaries(job: &mut Job) -> Result<Vec<Residuals>, Error> {
    let mut checked = Vec::new();
    let aggregates = job.aggregates("_residuals").await?;
    for (log, bytes) in job.logs.iter().zip(&aggregates) {
        let residuals = Residuals::from_bytes(bytes)?;
        checked.push(match residuals.not_finite() {
            0 => Ok(residuals),
            count => {
                let why = Error::new(format!("torques of {count} rows are not finite"));
                Err(locate(log).unwrap_or_else(|| why.at(log.name.display())))
            }
        });
    }
    job.keep(checked)
}

fn summary(job: &Job, log_residuals: &[Residuals]) -> String {
    let mut rows = Vec::new();
    let mut total = Residuals::new(job.robot.joints());
    for (log, residuals) in job.logs.iter().zip(log_residuals) {
        total.merge(residuals);
        rows.extend(lines(&log.name.display().to_string(), residuals, true));
    }
    if log_residuals.len() > 1 {
        rows.extend(lines("all", &total, false));
    }
    let (states, files) = (total.states(), log_residuals.len());
    let table = table(["file", "joint", "rms", "99 %", "worst", "at, s"], rows);
    let told = |(log, residuals): (&Log, &Residuals)| log.told(residuals.states());
    let told: String = job.logs.iter().zip(log_residuals).map(told).collect();
    format!("{table}{states} states in {files} files; N·m or N, 99 % within 0.8 % of it\n{told}")
}

fn lines(name: &str, residuals: &Residuals, time: bool) -> Vec<[String; 6]> {
    let line = |(i, joint): (usize, &Joint)| {
        let at = time.then(|| format!("{:.3}", joint.time));
        let sizes = [residuals.rms(i), residuals.quantile(i, 0.99), joint.worst];
        let [rms, most, worst] = sizes.map(number);
        let at = at.unwrap_or_default();
        [name.to_owned(), (i + 1).to_string(), rms, most, worst, at]
    };
    residuals.joints().iter().enumerate().map(line).collect()
}

async fn watched(
    args: &ResidualArgs,
    job: &Job,
    log_residuals: &[Residuals],
) -> Result<String, Error> {
    let n = job.robot.joints();
    // Half of the residuals are below it, whatever a contact does to the others.
    let noise_of = |residuals: &Residuals| -> Vec<f64> {
        let of_joint = |i| (residuals.quantile(i, 0.5) / 0.6745).max(f64::MIN_POSITIVE);
        (0..n).map(of_joint).collect()
    };
    let (noises, bar): (Vec<Vec<f64>>, f64) = match &args.quiet {
        None => (log_residuals.iter().map(noise_of).collect(), args.bar),
        Some(quiet) => {
            let quiet = LogArgs {
                logs: vec![quiet.display().to_string()],
                skip_bad: false,
                ..args.logs.clone()
            };
            let mut quiet = Job::new(&quiet, false, &job.going).await?;
            let quiet_residuals = summaries(&mut quiet).await?;
            let noise = noise_of(&quiet_residuals[0]);
            let (robot, quiet_noise) = (job.robot.clone(), noise.clone());
            let levels = quiet.each(move |_, log, going| {
                Ok(contacts(robot.as_ref(), log, &quiet_noise, f64::MAX / 4.0, going)?.1)
            });
            let level = levels.await?.into_iter().fold(0.0, f64::max);
            (vec![noise; job.logs.len()], 2.0 * level)
        }
    };
    let (robot, noises) = (job.robot.clone(), Arc::new(noises));
    let search = job.each(move |place, log, going| {
        Ok(contacts(robot.as_ref(), log, &noises[place], bar, going)?.0)
    });
    let mut rows = Vec::new();
    for (log, contacts) in job.logs.iter().zip(search.await?) {
        let name = log.name.display().to_string();
        for one in contacts {
            let [start, end] = [one.start, one.end].map(|time| format!("{time:.3}"));
            let joint = (one.joint + 1).to_string();
            rows.push([name.clone(), start, end, joint, number(one.largest)]);
        }
    }
    if rows.is_empty() {
        let why = format!("no cumulative sum of residuals exceeds {bar:.0} times the noise");
        return Ok(format!("\nno contacts: {why}\n"));
    }
    let head = ["contact in", "from, s", "to, s", "joint", "largest, N·m"];
    Ok(format!("\n{}", table(head, rows)))
}

async fn drawn(
    args: &ResidualArgs,
    job: &Job,
    log_residuals: &[Residuals],
) -> Result<String, Error> {
    let n = job.robot.joints();
    // Joints have torques of other sizes: each counts by its own over all logs.
    let mut total = Residuals::new(n);
    for residuals in log_residuals {
        total.merge(residuals);
    }
    let size = |residuals: &Residuals| {
        let parts = (0..n).map(|i| residuals.rms(i) / total.rms(i).max(f64::MIN_POSITIVE));
        parts.fold(0.0, f64::max)
    };
    let mut order: Vec<usize> = (0..log_residuals.len()).collect();
    order.sort_by(|a, b| size(&log_residuals[*b]).total_cmp(&size(&log_residuals[*a])));
    order.truncate(args.worst);
    let (robot, chosen) = (job.robot.clone(), order.clone());
    let drawings = job.each(move |place, log, going| {
        if !chosen.contains(&place) {
            return Ok(None);
        }
        let mut curves = Curves::new(&log.name.display().to_string(), n, log.rows);
        walk(robot.as_ref(), log, going, |block, residuals| {
            curves.add(&block.time, residuals);
            Ok(())
        })?;
        Ok(Some(curves))
    });
    let curves = drawings.await?;
    let worst: Vec<&Curves> = order.iter().flat_map(|place| &curves[*place]).collect();
    Ok(picture(&worst))
}

async fn write_residuals(job: &Job, output: &Path) -> Result<(), Error> {
    let part = Unfinished::beside(output)?;
    let n = job.robot.joints();
    let mut names = canonical_names(n);
    names.extend((1..=n).map(|i| format!("residual{i}")));
    let (logs, robot, path) = (job.logs.clone(), job.robot.clone(), part.path().to_owned());
    let written = job.going.blocking(move |going| {
        let mut table = Table::create(&path, &names, true)?;
        for log in &logs {
            let name = log.name.display().to_string();
            walk(robot.as_ref(), log, going, |block, residuals| {
                let quantities = block.quantities.iter().map(Vec::as_slice);
                table.write(&name, &block.time, quantities.chain([residuals]))
            })?;
        }
        table.close()
    });
    written.await.map_err(|why| why.at(output.display()))?;
    part.finish()
}

/// Half of the change that is found soonest, in units of the noise.
const DRIFT: f64 = 1.0;
/// Alarms that are closer than this, s, are of one contact.
const APART: f64 = 0.5;

struct Contact {
    start: f64,
    end: f64,
    joint: usize,
    largest: f64,
}

/// Finds when residuals change; returns the largest sum, too, in units of the noise.
fn contacts(
    robot: &dyn Dynamics,
    log: &Log,
    noise: &[f64],
    bar: f64,
    going: &Going,
) -> Result<(Vec<Contact>, f64), Error> {
    let mut watch = Watch::new(noise, DRIFT, bar)?;
    let (mut contacts, mut level): (Vec<Contact>, f64) = (Vec::new(), 0.0);
    let mut state = vec![0.0; noise.len()];
    walk(robot, log, going, |block, residuals| {
        for (s, time) in block.time.iter().enumerate() {
            for (i, value) in state.iter_mut().enumerate() {
                *value = residuals[i * block.len() + s];
            }
            let alarm = watch.push(&state)?;
            level = level.max(watch.level());
            let last = contacts.last_mut().filter(|last| time - last.end < APART);
            if let Some(last) = last {
                if alarm.is_some() {
                    last.end = *time;
                }
                last.largest = last.largest.max(state[last.joint].abs());
            } else if let Some(joint) = alarm {
                contacts.push(Contact {
                    start: *time,
                    end: *time,
                    joint,
                    largest: state[joint].abs(),
                });
            }
        }
        Ok(())
    })?;
    Ok((contacts, level))
}
