//! How far a command is, and whether it is to end.

use std::fmt;
use std::io::{IsTerminal, Write};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, OnceLock};
use std::time::{Duration, Instant};

use dalembert_fit::{Accumulator, Model};
use tokio::sync::watch;

use crate::dynamics::{Dynamics, States};
use crate::error::Error;

/// Asks a command to end: the other end of [`Going`].
pub type End = watch::Sender<bool>;

/// Says whether a command goes on.
#[derive(Clone, Debug)]
pub struct Going(watch::Receiver<bool>);

impl Going {
    /// Returns one that nobody has ended, and what ends it.
    pub fn new() -> (End, Going) {
        let (end, going) = watch::channel(false);
        (end, Going(going))
    }

    /// Returns whether it goes on.
    pub fn goes_on(&self) -> bool {
        !*self.0.borrow()
    }

    /// Waits for work, or until it is to end.
    ///
    /// # Errors
    /// Those of the work, or that it was ended.
    pub async fn unless_ended<T>(
        &self,
        work: impl Future<Output = Result<T, Error>>,
    ) -> Result<T, Error> {
        let mut end = self.0.clone();
        let ended = async {
            // Where nobody is left who could end it, it never ends.
            if end.wait_for(|ended| *ended).await.is_err() {
                std::future::pending::<()>().await;
            }
        };
        tokio::select! {
            found = work => found,
            () = ended => Err(Error::new(INTERRUPTED)),
        }
    }

    /// Does work that computes or reads, beside what waits; it looks itself whether to go on.
    ///
    /// # Errors
    /// Those of the work, and that it was ended.
    pub async fn blocking<T: Send + 'static>(
        &self,
        work: impl FnOnce(&Going) -> Result<T, Error> + Send + 'static,
    ) -> Result<T, Error> {
        let going = self.clone();
        let found = tokio::task::spawn_blocking(move || work(&going)).await;
        self.check()?;
        found.map_err(Error::new)?
    }

    /// Returns an error if it was ended.
    ///
    /// # Errors
    /// That it was ended.
    pub fn check(&self) -> Result<(), Error> {
        match self.goes_on() {
            true => Ok(()),
            false => Err(Error::new(INTERRUPTED)),
        }
    }
}

/// What a command that was ended says.
pub const INTERRUPTED: &str = "interrupted: nothing was written";

/// Counts states, and tells on the terminal how many there are, how fast it goes, and how long
/// it takes.
#[derive(Debug, Default)]
pub struct Progress {
    total: AtomicU64,
    done: AtomicU64,
    /// When there was something to do.
    start: OnceLock<Instant>,
}

impl Progress {
    /// Adds states that are done.
    pub fn add(&self, states: u64) {
        self.done.fetch_add(states, Ordering::Relaxed);
    }

    /// Adds states that are to do.
    pub fn expect(&self, states: u64) {
        self.start.get_or_init(Instant::now);
        self.total.fetch_add(states, Ordering::Relaxed);
    }

    /// Shows it while work is done, where standard error is a terminal or `always`.
    pub async fn shown<T>(&self, always: bool, work: impl Future<Output = T>) -> T {
        if !always && !std::io::stderr().is_terminal() {
            return work.await;
        }
        let show = async {
            loop {
                tokio::time::sleep(Duration::from_millis(500)).await;
                let _ = write!(std::io::stderr(), "\r\x1b[K{self}");
            }
        };
        let found = tokio::select! {
            found = work => found,
            () = show => unreachable!("it shows until it is dropped"),
        };
        let _ = writeln!(std::io::stderr(), "\r\x1b[K{self}");
        found
    }
}

impl fmt::Display for Progress {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let done = self.done.load(Ordering::Relaxed) as f64;
        let total = self.total.load(Ordering::Relaxed) as f64;
        let elapsed = self
            .start
            .get()
            .map_or(0.0, |start| start.elapsed().as_secs_f64());
        let rate = done / elapsed.max(1e-9);
        write!(
            f,
            "{:.2} of {:.2} M states, {:.2} M/s",
            done / 1e6,
            total / 1e6,
            rate / 1e6
        )?;
        match rate > 0.0 && total > done {
            true => write!(f, ", {:.0} s left", (total - done) / rate),
            false => Ok(()),
        }
    }
}

/// A robot that counts the states which are evaluated.
#[derive(Debug)]
pub struct Counted {
    robot: Arc<dyn Dynamics>,
    progress: Arc<Progress>,
}

impl Counted {
    /// Counts the states of a robot.
    pub fn new(robot: Arc<dyn Dynamics>, progress: Arc<Progress>) -> Counted {
        Counted { robot, progress }
    }
}

impl Dynamics for Counted {
    fn joints(&self) -> usize {
        self.robot.joints()
    }

    fn inverse_dynamics(&self, states: States<'_>, tau: &mut [f64]) -> Result<(), Error> {
        self.progress.add(states.count as u64);
        self.robot.inverse_dynamics(states, tau)
    }

    fn model(&self) -> Option<&Model> {
        self.robot.model()
    }

    fn accumulate(
        &self,
        states: States<'_>,
        tau: &[f64],
        room: &mut Vec<f64>,
        into: &mut Accumulator,
    ) -> Result<(), Error> {
        self.progress.add(states.count as u64);
        self.robot.accumulate(states, tau, room, into)
    }
}
