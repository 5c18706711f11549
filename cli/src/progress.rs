//! Long runs: a progress bar on a terminal after two seconds, and Ctrl-C, which ends a thorough
//! search with the best program so far.
//!
//! Only the command uses clocks, terminals and signals; the library calls an [`Observer`].

use std::io::{self, IsTerminal};
use std::process;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::Duration;

use dalembert_codegen::workspace::{Observer, Progress};
use dalembert_codegen::{Effort, Function, Request, Watch};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::output::note;

/// The time before the bar appears.
const QUIET: Duration = Duration::from_secs(2);

/// The exit code of a process that Ctrl-C ended: 128 + SIGINT.
const INTERRUPTED: i32 = 130;

/// The bar of the run; there is only one, since there is one terminal.
static BAR: Mutex<Option<ProgressBar>> = Mutex::new(None);

/// A guard: the bar is shown until it is dropped.
pub struct Shown;

/// Starts the bar of a run; it appears on a terminal after two seconds.
pub fn begin() -> Shown {
    let bar = ProgressBar::with_draw_target(Some(1), ProgressDrawTarget::hidden());
    if let Ok(style) = ProgressStyle::with_template("{elapsed} {bar:24} {wide_msg}") {
        bar.set_style(style);
    }
    *BAR.lock().unwrap_or_else(PoisonError::into_inner) = Some(bar.clone());
    if io::stderr().is_terminal() {
        thread::spawn(move || {
            thread::sleep(QUIET);
            if !bar.is_finished() {
                bar.set_draw_target(ProgressDrawTarget::stderr());
                bar.enable_steady_tick(Duration::from_millis(500));
            }
        });
    }
    Shown
}

impl Drop for Shown {
    fn drop(&mut self) {
        bar().finish_and_clear();
    }
}

/// Runs `print` while the bar is hidden.
pub fn aside<R>(print: impl FnOnce() -> R) -> R {
    bar().suspend(print)
}

/// Sets the number of steps of a long run.
pub fn steps(steps: usize) {
    bar().set_length(steps as u64);
}

/// Starts the next step of a long run and shows its name.
pub fn step(name: &str) {
    bar().set_message(name.to_owned());
    bar().inc(1);
}

/// Returns the bar of the run.
fn bar() -> ProgressBar {
    let bar = BAR.lock().unwrap_or_else(PoisonError::into_inner).clone();
    bar.unwrap_or_else(ProgressBar::hidden)
}

/// A guard: searches are watched until it is dropped.
pub struct Session(Arc<Seen>);

/// The state of an observer.
struct Seen {
    /// The functions in the order of their searches.
    functions: Vec<Function>,
    stop: AtomicBool,
    /// Whether no search is left that Ctrl-C could end early.
    over: AtomicBool,
}

/// Watches the searches of a request; Ctrl-C ends thorough ones.
pub fn watch(request: &mut Request) -> Session {
    let seen = Arc::new(Seen {
        functions: Function::in_order(&request.functions),
        stop: AtomicBool::new(false),
        over: AtomicBool::new(false),
    });
    if request.effort == Effort::Thorough {
        let heard = seen.clone();
        // If no handler can be set, Ctrl-C ends the process as usual.
        let _ = ctrlc::set_handler(move || heard.interrupt());
    }
    request.watch = Watch::new(seen.clone());
    Session(seen)
}

impl Seen {
    /// Ends the search at the first Ctrl-C and the process at the second; after the search, the
    /// first one ends the process.
    fn interrupt(&self) {
        let over = self.over.load(Ordering::Relaxed);
        if self.stop.swap(true, Ordering::Relaxed) || over {
            bar().finish_and_clear();
            process::exit(INTERRUPTED);
        }
        note(
            "ending the search after this round; its best program is then compared with a quick \
             search's, proved and measured. Press Ctrl-C again to quit without a result",
        );
    }
}

impl Observer for Seen {
    fn step(&self, progress: &Progress) {
        let Progress {
            function,
            part,
            round,
            rounds,
            best,
        } = progress;
        let reached = match (best, rounds) {
            (Some(counts), _) => format!(": {counts}"),
            (None, 0) => format!(": {round} tried"),
            (None, _) => String::new(),
        };
        let place = place(&self.functions, *function);
        bar().set_message(format!("{place}{function}, {part}{reached}"));
        bar().set_length((*rounds).max(1) as u64);
        bar().set_position((*round).min(*rounds) as u64);
    }

    fn stop(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }
}

impl Drop for Session {
    fn drop(&mut self) {
        self.0.over.store(true, Ordering::Relaxed);
        if self.0.stop() {
            note("the search ended early: a longer search may find a cheaper program");
        }
    }
}

/// Returns `function 2 of 6: ` if there are several functions.
fn place(functions: &[Function], function: Function) -> String {
    let at = functions.iter().position(|one| *one == function);
    match (at, functions.len()) {
        (Some(at), 2..) => format!("function {} of {}: ", at + 1, functions.len()),
        _ => String::new(),
    }
}
