//! What the commands over logs have in common: a robot, logs that were looked at, an engine.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use clap::Args;
use futures::stream::{self, StreamExt};

use crate::dynamics::{Dynamics, Loaded};
use crate::engine::{Engine, Limits};
use crate::error::Error;
use crate::logs::{Bad, Columns, Log, Mapping, convert, expand, inspect};
use crate::output::Scratch;
use crate::progress::{Counted, Going, Progress};

/// The robot of a command.
#[derive(Args, Clone, Debug)]
pub struct RobotArgs {
    /// Robot file, or URDF
    #[arg(long, value_name = "FILE")]
    pub robot: PathBuf,
    /// Of a URDF: the link that stands still
    #[arg(long, value_name = "LINK")]
    pub base: Option<String>,
    /// Of a URDF: the link that is the hand
    #[arg(long, value_name = "LINK")]
    pub tip: Option<String>,
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
    /// Leave out files that are bad; without it they are named and nothing is computed
    #[arg(long)]
    pub skip_bad: bool,
    /// How much memory reading may take, as 512M or 4G
    #[arg(long, value_name = "SIZE", default_value = "1G", value_parser = bytes)]
    pub memory: u64,
    /// Threads [default: the machine's]
    #[arg(long, value_name = "COUNT")]
    pub threads: Option<usize>,
    /// Folder for files that are converted; the executors of a cluster have to see it
    /// [default: the system's for temporary files]
    #[arg(long, value_name = "FOLDER")]
    pub work: Option<PathBuf>,
    /// Tell how far it is, also where standard error is no terminal
    #[arg(long)]
    pub progress: bool,
    /// The scheduler of a cluster
    #[cfg(feature = "cluster")]
    #[arg(long, value_name = "HOST:PORT")]
    pub scheduler: Option<String>,
}

/// Reads a size, as 512M or 4G.
///
/// # Errors
/// A text that is none.
pub fn bytes(text: &str) -> Result<u64, String> {
    let bad = || format!("`{text}` is no size: 512M or 4G was expected");
    let digits = text.trim_end_matches(|c: char| c.is_ascii_alphabetic());
    let unit = match text[digits.len()..]
        .to_ascii_uppercase()
        .trim_end_matches("IB")
    {
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

impl RobotArgs {
    /// Loads the robot; with `fit` the regressor too.
    ///
    /// # Errors
    /// What is wrong with the file.
    pub async fn load(&self, fit: bool, going: &Going) -> Result<Arc<Loaded>, Error> {
        let own = self.clone();
        let urdf = dalembert_import::Options {
            base: own.base,
            tip: own.tip,
            ..Default::default()
        };
        let work = going.blocking(move |_| Loaded::open(&own.robot, &urdf, fit));
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
        let plain = |c: char| {
            if c.is_ascii_alphanumeric() {
                c.to_ascii_lowercase()
            } else {
                '_'
            }
        };
        let stem: String = stem.chars().map(plain).collect();
        let hash = robot.robot().input_hash();
        let hash: String = hash
            .iter()
            .take(4)
            .map(|byte| format!("{byte:02x}"))
            .collect();
        format!("{stem}_{hash}")
    }
}

/// Logs that can be queried.
pub struct Job {
    /// The robot, which counts what it evaluates.
    pub robot: Arc<dyn Dynamics>,
    /// The robot as it was loaded.
    pub loaded: Arc<Loaded>,
    /// Where queries run.
    pub engine: Engine,
    /// The logs, in order.
    pub logs: Vec<Log>,
    /// How far it is.
    pub progress: Arc<Progress>,
    going: Going,
    skip_bad: bool,
    threads: usize,
    is_remote: bool,
    /// Files that were converted live as long as this.
    _scratch: Scratch,
}

impl Job {
    /// Loads the robot, looks at the logs, and converts those that need it.
    ///
    /// # Errors
    /// What is wrong with robot or flags; bad files unless they are skipped.
    pub async fn new(args: &LogArgs, fit: bool, going: &Going) -> Result<Job, Error> {
        let files = expand(&args.logs)?;
        let loaded = args.robot.load(fit, going).await?;
        let columns = args.mapping.resolve(loaded.robot())?;
        let cores = std::thread::available_parallelism().map_or(1, usize::from);
        let threads = args.threads.unwrap_or(cores).max(1);
        let progress = Arc::new(Progress::default());
        let robot: Arc<dyn Dynamics> = loaded.clone();
        let robot: Arc<dyn Dynamics> = Arc::new(Counted::new(robot, progress.clone()));
        let work = args.work.clone().unwrap_or_else(std::env::temp_dir);
        let scratch = Scratch::within(&work)?;
        let found = looked_at(&files, &columns, &scratch, threads, going).await?;
        let limits = Limits {
            memory: args.memory,
            partitions: threads,
        };
        let name = args.robot.function_name(&loaded);
        let (engine, is_remote) = engine(args, &name, &robot, limits).await?;
        let mut job = Job {
            robot,
            loaded,
            engine,
            logs: Vec::new(),
            progress,
            going: going.clone(),
            skip_bad: args.skip_bad,
            threads,
            is_remote,
            _scratch: scratch,
        };
        job.logs = job.good(found)?;
        job.progress.expect(job.rows());
        Ok(job)
    }

    /// Returns the number of rows of all logs.
    pub fn rows(&self) -> u64 {
        self.logs.iter().map(|log| log.rows).sum()
    }

    /// Says of what a cluster does not compute that this machine does.
    pub fn tell_local(&self, what: &str) {
        if self.is_remote {
            eprintln!("{what}: rows in order, computed by this machine and not by the cluster");
        }
    }

    /// Returns what was found of good files; names the bad ones.
    ///
    /// # Errors
    /// That there are bad ones, unless they are skipped.
    pub fn good<T>(&self, found: Vec<Result<T, Bad>>) -> Result<Vec<T>, Error> {
        let (all, mut good, mut bad) = (found.len(), Vec::new(), 0);
        for one in found {
            match one {
                Ok(one) => good.push(one),
                Err(one) => {
                    bad += 1;
                    let skipped = if self.skip_bad { "left out: " } else { "" };
                    eprintln!("{skipped}{one}");
                }
            }
        }
        match bad {
            0 => Ok(good),
            _ if !self.skip_bad => Err(Error::new(format!(
                "{bad} of {all} files cannot be used, see above: mend them, or leave them out by \
                 --skip-bad"
            ))),
            _ if good.is_empty() => Err(Error::new("no file can be used")),
            _ => Ok(good),
        }
    }

    /// Computes an aggregate of each log; logs that turn out bad are dropped, or an error.
    ///
    /// # Errors
    /// Those of the engine and of [`Job::good`].
    pub async fn aggregates(&mut self, suffix: &str) -> Result<Vec<Vec<u8>>, Error> {
        let progress = self.progress.clone();
        let is_remote = self.is_remote;
        // What a cluster evaluates is not counted here.
        let done = move |log: &Log| {
            if is_remote {
                progress.add(log.rows)
            }
        };
        let found = self
            .engine
            .over(suffix, &self.logs, &self.going, done)
            .await?;
        self.keep(found)
    }

    /// Keeps the logs that something was found of; returns what it is.
    ///
    /// # Errors
    /// Those of [`Job::good`].
    pub fn keep<T>(&mut self, found: Vec<Result<T, Bad>>) -> Result<Vec<T>, Error> {
        let is_good: Vec<bool> = found.iter().map(Result::is_ok).collect();
        let found = self.good(found)?;
        let mut is_good = is_good.into_iter();
        self.logs.retain(|_| is_good.next().unwrap_or(false));
        Ok(found)
    }

    /// Does something with each log on the threads of this machine; returns it in their order.
    ///
    /// # Errors
    /// Those of the work, and that the command was ended.
    pub async fn each<T: Send + 'static>(
        &self,
        work: impl Fn(&Log, &Going) -> Result<T, Error> + Clone + Send + 'static,
    ) -> Result<Vec<T>, Error> {
        let each = stream::iter(self.logs.clone()).map(|log| {
            let work = work.clone();
            self.going.blocking(move |going| work(&log, going))
        });
        let found: Vec<Result<T, Error>> = each.buffered(self.threads).collect().await;
        found.into_iter().collect()
    }
}

/// Looks at all files, and converts those that have to be.
async fn looked_at(
    files: &[PathBuf],
    columns: &Columns,
    scratch: &Scratch,
    threads: usize,
    going: &Going,
) -> Result<Vec<Result<Log, Bad>>, Error> {
    let each = stream::iter(files.iter().enumerate()).map(|(place, path)| {
        let (path, columns) = (path.clone(), columns.clone());
        let to = scratch.file(&format!("{place}.parquet"));
        going.blocking(move |going| Ok(usable(&path, &columns, &to, going)))
    });
    let found: Vec<Result<_, Error>> = each.buffered(threads).collect().await;
    found.into_iter().collect()
}

fn usable(path: &Path, columns: &Columns, to: &Path, going: &Going) -> Result<Log, Bad> {
    let goes_on = || going.goes_on();
    let log = inspect(path, columns, &goes_on)?;
    match log.converts {
        true => convert(&log, to, &goes_on),
        false => Ok(log),
    }
}

#[cfg(feature = "cluster")]
async fn engine(
    args: &LogArgs,
    name: &str,
    robot: &Arc<dyn Dynamics>,
    limits: Limits,
) -> Result<(Engine, bool), Error> {
    match &args.scheduler {
        Some(scheduler) => Ok((Engine::cluster(scheduler, name, robot, limits).await?, true)),
        None => Ok((Engine::embedded(name, robot, limits)?, false)),
    }
}

#[cfg(not(feature = "cluster"))]
async fn engine(
    _: &LogArgs,
    name: &str,
    robot: &Arc<dyn Dynamics>,
    limits: Limits,
) -> Result<(Engine, bool), Error> {
    Ok((Engine::embedded(name, robot, limits)?, false))
}
