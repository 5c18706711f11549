//! The parts that commands over logs have in common: a robot, logs that were looked at, an engine.

use std::path::PathBuf;
use std::sync::Arc;

use clap::Args;
use dalembert_import::ChainArgs;
use futures::stream::{self, StreamExt};

use crate::dynamics::{Dynamics, Loaded};
use crate::engine::{Engine, Limits};
use crate::error::Error;
use crate::logs::{Log, Mapping, convert, expand, inspect};
use crate::output::Scratch;
use crate::progress::{Going, Progress};

/// The robot of a command.
#[derive(Args, Clone, Debug)]
pub struct RobotArgs {
    /// Robot file, or URDF
    #[arg(long, value_name = "FILE")]
    pub robot: PathBuf,
    #[command(flatten)]
    pub chain: ChainArgs,
    /// Torques are measured behind the gears: they do not feel the rotors, whose inertias are 0
    #[arg(long)]
    pub without_rotors: bool,
}

/// Logs, and what reading them may take.
#[derive(Args, Clone, Debug)]
pub struct LogArgs {
    /// Parquet or MCAP files; patterns as 'logs/**/*.parquet'
    #[arg(required = true)]
    pub logs: Vec<String>,
    #[command(flatten)]
    pub robot: RobotArgs,
    #[command(flatten)]
    pub mapping: Mapping,
    /// Leave out unusable files; otherwise they are listed and nothing is computed
    #[arg(long)]
    pub skip_bad: bool,
    /// The most memory that reading takes, as 512M or 4G
    #[arg(long, value_name = "SIZE", default_value = "1G", value_parser = bytes)]
    pub memory: u64,
    /// Threads [default: the machine's]
    #[arg(long, value_name = "COUNT")]
    pub threads: Option<usize>,
    /// Folder for files that are converted; the executors of a cluster have to see it
    /// [default: the system's for temporary files]
    #[arg(long, value_name = "FOLDER")]
    pub work: Option<PathBuf>,
    /// Show the progress even if standard error is not a terminal
    #[arg(long)]
    pub progress: bool,
    /// The scheduler of a cluster
    #[cfg(feature = "cluster")]
    #[arg(long, value_name = "HOST:PORT")]
    pub scheduler: Option<String>,
}

/// Reads a size, as 512M or 4G.
pub fn bytes(text: &str) -> Result<u64, String> {
    let bad = || format!("`{text}` is not a size: expected 512M or 4G");
    let digits = text.trim_end_matches(|c: char| c.is_ascii_alphabetic());
    let unit = text[digits.len()..].to_ascii_uppercase();
    let unit = match unit.trim_end_matches("IB") {
        "" => 1,
        "K" => 1 << 10,
        "M" => 1 << 20,
        "G" => 1 << 30,
        _ => return Err(bad()),
    };
    let count: u64 = digits.parse().map_err(|_| bad())?;
    let size = count.checked_mul(unit).filter(|size| *size >= 64 << 20);
    size.ok_or_else(|| format!("`{text}`: 64M is the least, and 16E the most"))
}

/// Returns how many threads to use: the machine's, if none are asked for.
pub fn threads(asked: Option<usize>) -> usize {
    let cores = || std::thread::available_parallelism().map_or(1, usize::from);
    asked.unwrap_or_else(cores).max(1)
}

impl RobotArgs {
    /// Loads the robot; with `fit` the regressor too.
    pub async fn load(&self, fit: bool, going: &Going) -> Result<Arc<Loaded>, Error> {
        let args = self.clone();
        let urdf = args.chain.choose(Default::default());
        let open = match self.without_rotors {
            true => Loaded::without_rotors,
            false => Loaded::open,
        };
        let work = going.blocking(move |_| open(&args.robot, &urdf, fit));
        let robot = going.unless_ended(work).await?;
        for note in robot.notes() {
            eprintln!("{}", note.trim_end());
        }
        Ok(Arc::new(robot))
    }

    /// Returns the name of the robot's functions: whoever has another file has other names, and
    /// a query is refused instead of answered by another robot.
    pub fn function_name(&self, robot: &Loaded) -> String {
        let stem = self.robot.file_stem().unwrap_or_default().to_string_lossy();
        let is_other = |c: char| !c.is_ascii_alphanumeric();
        let name = stem.to_ascii_lowercase().replace(is_other, "_");
        let [first, second, third, fourth, ..] = robot.robot().input_hash();
        format!("{name}_{first:02x}{second:02x}{third:02x}{fourth:02x}")
    }
}

/// Logs that can be queried.
pub struct Job {
    /// The robot, which counts what it evaluates.
    pub robot: Arc<Loaded>,
    pub engine: Engine,
    pub logs: Vec<Log>,
    pub progress: Arc<Progress>,
    pub going: Going,
    skip_bad: bool,
    threads: usize,
    /// Files that were converted live as long as this.
    _scratch: Scratch,
}

impl Job {
    /// Loads the robot, looks at the logs, and converts those that need it.
    pub async fn new(args: &LogArgs, fit: bool, going: &Going) -> Result<Job, Error> {
        let files = expand(&args.logs)?;
        let robot = args.robot.load(fit, going).await?;
        let columns = args.mapping.resolve(robot.robot())?;
        let threads = threads(args.threads);
        let progress = Arc::new(Progress::of(robot.evaluated()));
        let work = args.work.clone().unwrap_or_else(std::env::temp_dir);
        let scratch = Scratch::within(&work)?;
        let inspections = stream::iter(files.into_iter().enumerate()).map(|(place, path)| {
            let (columns, to) = (columns.clone(), scratch.file(&format!("{place}.parquet")));
            going.blocking(move |going| {
                let log = inspect(&path, &columns, going).and_then(|log| match log.converts() {
                    true => convert(&log, &to, going),
                    false => Ok(log),
                });
                Ok(log.map_err(|why| why.at(path.display())))
            })
        });
        let results: Vec<Result<_, Error>> = inspections.buffered(threads).collect().await;
        let logs = results.into_iter().collect::<Result<Vec<_>, _>>()?;
        let (memory, partitions) = (args.memory, threads);
        let limits = Limits { memory, partitions };
        let name = args.robot.function_name(&robot);
        let dynamics: Arc<dyn Dynamics> = robot.clone();
        #[cfg(feature = "cluster")]
        let engine = match &args.scheduler {
            Some(scheduler) => Engine::cluster(scheduler, &name, &dynamics, limits).await?,
            None => Engine::embedded(&name, &dynamics, limits)?,
        };
        #[cfg(not(feature = "cluster"))]
        let engine = Engine::embedded(&name, &dynamics, limits)?;
        let mut job = Job {
            robot,
            engine,
            logs: Vec::new(),
            progress,
            going: going.clone(),
            skip_bad: args.skip_bad,
            threads,
            _scratch: scratch,
        };
        job.logs = job.good(logs)?;
        job.progress.expect(job.rows());
        Ok(job)
    }

    pub fn rows(&self) -> u64 {
        self.logs.iter().map(|log| log.rows).sum()
    }

    /// Says of what a cluster does not compute that this machine does.
    pub fn tell_local(&self, what: &str) {
        if self.engine.is_cluster() {
            eprintln!("{what}: rows in order are computed by this machine and not by the cluster");
        }
    }

    /// Returns the findings about good files; names the bad ones.
    pub fn good<T>(&self, results: Vec<Result<T, Error>>) -> Result<Vec<T>, Error> {
        let total = results.len();
        let skipped = if self.skip_bad { "left out: " } else { "" };
        let tell = |bad: &Error| eprintln!("{skipped}{bad}");
        let results = results.into_iter();
        let good = Vec::from_iter(results.flat_map(|one| one.inspect_err(tell)));
        let bad = total - good.len();
        match bad {
            0 => Ok(good),
            _ if !self.skip_bad => Err(Error::new(format!(
                "{bad} of {total} files cannot be used, see above: fix them, or skip them with \
                 --skip-bad"
            ))),
            _ if good.is_empty() => Err(Error::new("no file can be used")),
            _ => Ok(good),
        }
    }

    /// Computes an aggregate of each log; logs that turn out bad are dropped, or an error.
    pub async fn aggregates(&mut self, suffix: &str) -> Result<Vec<Vec<u8>>, Error> {
        let progress = self.progress.clone();
        let is_cluster = self.engine.is_cluster();
        // States that a cluster evaluates are not counted here.
        let done = move |log: &Log| {
            if is_cluster {
                progress.add(log.rows)
            }
        };
        let computation = self.engine.over(suffix, &self.logs, &self.going, done);
        let results = computation.await?;
        self.keep(results)
    }

    /// Keeps the logs that something was found of; returns what it is.
    pub fn keep<T>(&mut self, results: Vec<Result<T, Error>>) -> Result<Vec<T>, Error> {
        let is_good: Vec<bool> = results.iter().map(Result::is_ok).collect();
        let values = self.good(results)?;
        let mut is_good = is_good.into_iter();
        self.logs.retain(|_| is_good.next().unwrap_or(false));
        Ok(values)
    }

    /// Calls with each log and its place on this machine's threads; returns the results in order.
    pub async fn each<T: Send + 'static>(
        &self,
        work: impl Fn(usize, &Log, &Going) -> Result<T, Error> + Clone + Send + 'static,
    ) -> Result<Vec<T>, Error> {
        let logs = self.logs.clone().into_iter().enumerate();
        let tasks = stream::iter(logs).map(|(place, log)| {
            let work = work.clone();
            self.going.blocking(move |going| work(place, &log, going))
        });
        let results: Vec<Result<T, Error>> = tasks.buffered(self.threads).collect().await;
        results.into_iter().collect()
    }
}
