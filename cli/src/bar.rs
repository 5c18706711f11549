//! The bar of a run, which appears on a terminal after two seconds.

use std::io::{self, IsTerminal};
use std::sync::{Mutex, PoisonError};
use std::thread;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// The time that a run takes without a bar.
const QUIET: Duration = Duration::from_secs(2);

/// The bar of the run: there is one terminal.
static BAR: Mutex<Option<ProgressBar>> = Mutex::new(None);

/// Shows a bar as long as it lives.
pub struct Shown;

/// Begins a run, whose bar appears on a terminal when it has taken two seconds.
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

/// Returns the bar of the run.
pub fn bar() -> ProgressBar {
    let bar = BAR.lock().unwrap_or_else(PoisonError::into_inner).clone();
    bar.unwrap_or_else(ProgressBar::hidden)
}

/// Prints while the bar is away.
pub fn aside<R>(print: impl FnOnce() -> R) -> R {
    bar().suspend(print)
}

impl Drop for Shown {
    fn drop(&mut self) {
        bar().finish_and_clear();
    }
}
