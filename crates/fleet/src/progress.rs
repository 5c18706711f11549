//! The progress of a command, and the request that it end.

use std::fmt;
use std::io::{IsTerminal, Write};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, OnceLock};
use std::time::{Duration, Instant};

use tokio::sync::watch;

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

    /// Waits for work, or until it is to end.
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
            result = work => result,
            () = ended => Err(Error::new(INTERRUPTED)),
        }
    }

    /// Does work that computes or reads, beside what waits; it looks itself whether to go on.
    pub async fn blocking<T: Send + 'static>(
        &self,
        work: impl FnOnce(&Going) -> Result<T, Error> + Send + 'static,
    ) -> Result<T, Error> {
        let going = self.clone();
        let result = tokio::task::spawn_blocking(move || work(&going)).await;
        self.check()?;
        result.map_err(Error::new)?
    }

    pub fn check(&self) -> Result<(), Error> {
        match *self.0.borrow() {
            true => Err(Error::new(INTERRUPTED)),
            false => Ok(()),
        }
    }
}

/// The message of a command that was ended.
pub const INTERRUPTED: &str = "interrupted: nothing was written";

/// Counts states, and tells on the terminal how many they are, how fast, and for how long.
#[derive(Debug, Default)]
pub struct Progress {
    total: AtomicU64,
    done: Arc<AtomicU64>,
    start: OnceLock<Instant>,
}

impl Progress {
    /// Returns that of states which others count.
    pub fn of(done: Arc<AtomicU64>) -> Progress {
        Progress {
            done,
            ..Progress::default()
        }
    }

    pub fn add(&self, states: u64) {
        self.done.fetch_add(states, Ordering::Relaxed);
    }

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
        let output = tokio::select! {
            output = work => output,
            () = show => unreachable!("it shows until it is dropped"),
        };
        let _ = writeln!(std::io::stderr(), "\r\x1b[K{self}");
        output
    }
}

impl fmt::Display for Progress {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let done = self.done.load(Ordering::Relaxed) as f64;
        let total = self.total.load(Ordering::Relaxed) as f64;
        let start = self.start.get();
        let elapsed = start.map_or(0.0, |start| start.elapsed().as_secs_f64());
        let rate = done / elapsed.max(1e-9);
        let [millions, of, speed] = [done, total, rate].map(|count| count / 1e6);
        write!(f, "{millions:.2} of {of:.2} M states, {speed:.2} M/s")?;
        match rate > 0.0 && total > done {
            true => write!(f, ", {:.0} s left", (total - done) / rate),
            false => Ok(()),
        }
    }
}
