//! A long run: its steps on the bar, and Ctrl-C to end a thorough search with the best so far.
//!
//! Only the command knows clocks, terminals and signals; the library is told
//! through an [`Observer`].

use std::io::{self, IsTerminal};
use std::process;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use crate::sweep::Point;
use crate::sweep::ladder::Waiting;
use dalembert_codegen::workspace::{Observer, Progress};
use dalembert_codegen::{Effort, Function, Request, Watch};

use crate::bar::bar;
use crate::output;

/// The exit code of a process that Ctrl-C ended: 128 + SIGINT.
const INTERRUPTED: i32 = 130;

/// Watches a search while it lives.
pub struct Session(Arc<Terminal>);

struct Terminal {
    /// The functions that are searched for, in this order.
    functions: Vec<Function>,
    stop: AtomicBool,
    /// Nothing is left to be ended.
    over: AtomicBool,
}

/// Watches the searches of a request; Ctrl-C ends thorough ones.
pub fn watch(request: &mut Request) -> Session {
    let terminal = Arc::new(Terminal {
        functions: Function::in_order(&request.functions),
        stop: AtomicBool::new(false),
        over: AtomicBool::new(false),
    });
    if request.effort == Effort::Thorough {
        let heard = terminal.clone();
        // Without a handler Ctrl-C ends the process, as ever.
        let _ = ctrlc::set_handler(move || heard.interrupt());
    }
    request.watch = Watch::by(terminal.clone());
    Session(terminal)
}

/// The steps of a long run, on a terminal.
pub struct Steps(Arc<StepObserver>);

/// The step that is done at the moment.
struct StepObserver {
    name: Mutex<String>,
}

impl Steps {
    /// Begins to count so many of them.
    pub fn new(steps: usize) -> Steps {
        bar().set_length(steps as u64);
        let name = Mutex::default();
        Steps(Arc::new(StepObserver { name }))
    }

    /// Shows how far searches within a step have come.
    pub fn watch(&self) -> Watch {
        Watch::by(self.0.clone())
    }
}

impl Waiting for Steps {
    fn begin(&self, name: &str) {
        bar().set_message(name.to_owned());
        bar().inc(1);
        let mut current = self.0.name.lock().unwrap_or_else(PoisonError::into_inner);
        name.clone_into(&mut current);
    }

    /// Prints a line where there is no terminal that shows a bar.
    fn done(&self, tolerance: f64, variants: &[Point]) {
        if !io::stderr().is_terminal() {
            output::note(&line(tolerance, variants));
        }
    }
}

/// Describes the variants of a tolerance in one line.
fn line(tolerance: f64, variants: &[Point]) -> String {
    let variants = variants.iter().map(|point| {
        let certificate = &point.certificate;
        let by = if certificate.sines.is_empty() {
            ""
        } else {
            " with polynomials"
        };
        let operations = point.counts().operations();
        let error = point.certified;
        format!(
            "{operations} operations in {}{by} ({error:.1e})",
            certificate.scalar
        )
    });
    let variants: Vec<String> = variants.collect();
    let found = match variants.is_empty() {
        true => "no scalar is that exact".to_owned(),
        false => variants.join(", "),
    };
    format!("tolerance {tolerance:e}: {found}")
}

impl Observer for StepObserver {
    fn step(&self, progress: &Progress) {
        let name = self.name.lock().unwrap_or_else(PoisonError::into_inner);
        let Progress {
            part,
            round,
            rounds,
            ..
        } = progress;
        let round = match rounds {
            0 => round.to_string(),
            _ => format!("{round}/{rounds}"),
        };
        let reached = reached(progress);
        bar().set_message(format!("{name}, {part} {round}{reached}"));
    }

    /// Never ends a search early: every tolerance has its own variants.
    fn stop(&self) -> bool {
        false
    }
}

/// Returns `function 2 of 6: `, where there are several.
fn place(functions: &[Function], function: Function) -> String {
    let at = functions.iter().position(|one| *one == function);
    match (at, functions.len()) {
        (Some(at), 2..) => format!("function {} of {}: ", at + 1, functions.len()),
        _ => String::new(),
    }
}

/// Returns the best program so far, or how many were tried.
fn reached(progress: &Progress) -> String {
    match (progress.best, progress.rounds) {
        (Some(counts), _) => format!(": {counts}"),
        (None, 0) => format!(": {} tried", progress.round),
        (None, _) => String::new(),
    }
}

impl Terminal {
    /// Asks for an end the first time, and ends the second time; what comes after the search has
    /// no end but that.
    fn interrupt(&self) {
        let over = self.over.load(Ordering::Relaxed);
        if self.stop.swap(true, Ordering::Relaxed) || over {
            bar().finish_and_clear();
            process::exit(INTERRUPTED);
        }
        output::note(
            "ending the search after this round; its best program is then compared with a quick \
             search's, proved and measured. Press Ctrl-C again to quit without a result",
        );
    }
}

impl Observer for Terminal {
    fn step(&self, progress: &Progress) {
        let Progress {
            function,
            part,
            round,
            rounds,
            ..
        } = progress;
        let known = *rounds > 0;
        bar().set_length(if known { *rounds as u64 } else { 1 });
        bar().set_position(if known { *round as u64 } else { 0 });
        let reached = reached(progress);
        let place = place(&self.functions, *function);
        bar().set_message(format!("{place}{function}, {part}{reached}"));
    }

    fn stop(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }
}

impl Drop for Session {
    fn drop(&mut self) {
        self.0.over.store(true, Ordering::Relaxed);
        if self.0.stop() {
            output::note("the search was ended early: more might be found");
        }
    }
}

#[cfg(test)]
mod tests {
    use dalembert_codegen::Function;

    use super::place;

    #[test]
    fn which_function_of_how_many() {
        assert_eq!(
            place(&Function::by_default(), Function::Gravity),
            "function 2 of 7: "
        );
        assert_eq!(place(&[Function::Gravity], Function::Gravity), "");
    }
}
