//! Long searches: their state in the bar, and Ctrl-C, which ends a thorough one with the best program
//! so far.
//!
//! Only the command uses clocks, terminals and signals; the library calls an [`Observer`].

use std::process;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use dalembert_codegen::workspace::{Observer, Progress};
use dalembert_codegen::{Effort, Function, Request, Watch};

use crate::terminal::{bar, note};

/// The exit code of a process that Ctrl-C ended: 128 + SIGINT.
const INTERRUPTED: i32 = 130;

/// A guard: searches are watched until it is dropped.
pub struct Session(Arc<SearchProgress>);

struct SearchProgress {
    functions: Vec<Function>,
    stop: AtomicBool,
    /// True if no search is left that Ctrl-C could end early.
    over: AtomicBool,
}

/// Watches the searches of a request; Ctrl-C ends thorough ones.
pub fn watch(request: &mut Request) -> Session {
    let progress = Arc::new(SearchProgress {
        functions: Function::in_order(&request.functions),
        stop: AtomicBool::new(false),
        over: AtomicBool::new(false),
    });
    if request.effort == Effort::Thorough {
        let heard = progress.clone();
        // If no handler can be set, Ctrl-C ends the process as usual.
        let _ = ctrlc::set_handler(move || heard.interrupt());
    }
    request.watch = Watch::new(progress.clone());
    Session(progress)
}

impl SearchProgress {
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

impl Observer for SearchProgress {
    fn step(&self, progress: &Progress) {
        let (function, part) = (progress.function, progress.part.name());
        let (round, rounds) = (progress.round, progress.rounds);
        let reached = match (&progress.best, rounds) {
            (Some(counts), _) => format!(": {counts}"),
            (None, 0) => format!(": {round} tried"),
            (None, _) => String::new(),
        };
        let functions = &self.functions;
        let count = functions.len();
        let place = match functions.iter().position(|one| *one == function) {
            Some(at) if count > 1 => format!("function {} of {count}: ", at + 1),
            _ => String::new(),
        };
        bar().set_message(format!("{place}{function}, {part}{reached}"));
        bar().set_length(rounds.max(1) as u64);
        bar().set_position(round.min(rounds) as u64);
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
