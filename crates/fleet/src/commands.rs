//! The commands.

#[cfg(feature = "cluster")]
mod cluster;
mod identify;
mod residual;
mod simulate;

use clap::{Parser, Subcommand};

use crate::error::Error;
use crate::progress::Going;

/// Residuals of an arm's model, and its parameters, from a fleet's logs
#[derive(Debug, Parser)]
#[command(name = "dalembert-fleet", version)]
pub struct CommandLine {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Tells how far measured torques are from the model's, by file and joint
    Residual(residual::ResidualArgs),
    /// Identifies the parameters of an arm, and writes its robot file
    Identify(identify::IdentifyArgs),
    /// Writes logs of a simulated arm
    Simulate(simulate::SimulateArgs),
    /// Runs the scheduler of a cluster
    #[cfg(feature = "cluster")]
    Scheduler(cluster::SchedulerArgs),
    /// Runs an executor of a cluster
    #[cfg(feature = "cluster")]
    Executor(cluster::ExecutorArgs),
}

#[derive(Clone, Debug)]
pub struct Report {
    /// The text for standard output.
    pub text: String,
    /// The error that came after this was computed.
    pub failed: Option<Error>,
}

/// Runs a command; after an error no output has changed.
pub async fn run(arguments: CommandLine, going: &Going) -> Result<Report, Error> {
    let text = match arguments.command {
        Command::Identify(args) => return identify::run(&args, going).await,
        Command::Residual(args) => residual::run(&args, going).await?,
        Command::Simulate(args) => simulate::run(args, going).await?,
        #[cfg(feature = "cluster")]
        Command::Scheduler(args) => cluster::scheduler(args, going).await?,
        #[cfg(feature = "cluster")]
        Command::Executor(args) => cluster::executor(args, going).await?,
    };
    Ok(Report { text, failed: None })
}

fn table<const N: usize>(head: [&str; N], rows: Vec<[String; N]>) -> String {
    let mut table = vec![head.map(str::to_owned)];
    table.extend(rows);
    let width = |k: usize| table.iter().map(|row| row[k].chars().count()).max();
    let widths: Vec<usize> = (0..N).map(|k| width(k).unwrap_or(0)).collect();
    let mut text = String::new();
    for row in &table {
        let cell = |(k, (cell, width)): (usize, (&String, &usize))| match k {
            0 => format!("{cell:width$}"),
            _ => format!("{cell:>width$}"),
        };
        let cells: Vec<String> = row.iter().zip(&widths).enumerate().map(cell).collect();
        text += cells.join("  ").trim_end();
        text.push('\n');
    }
    text
}

fn number(x: f64) -> String {
    let size = x.abs();
    match size {
        _ if !x.is_finite() => x.to_string(),
        0.0 => "0".to_owned(),
        _ if !(1e-4..1e6).contains(&size) => format!("{x:.3e}"),
        _ => {
            let digits = (3 - libm::floor(libm::log10(size)) as i32).clamp(0, 7);
            format!("{x:.*}", digits as usize)
        }
    }
}
