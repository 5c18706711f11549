//! The terminal: what is printed, failures too, and the bar of a long run, which gives way to it.

use std::cell::Cell;
use std::fmt::Display;
use std::io::{self, IsTerminal, Write};
use std::sync::{Mutex, PoisonError};
use std::thread;
use std::time::Duration;

use anstream::{AutoStream, ColorChoice};
use dalembert_codegen::workspace::Disproof;
use dalembert_codegen::{Diagnostic, Diagnostics, GenerateError};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::args::as_flags;

/// The failure of a run, with its text for standard error.
#[derive(Debug)]
pub enum Failure {
    /// A check failed: exit code 1.
    Check(String),
    /// The input cannot be used: exit code 2.
    Input(String),
}

impl Failure {
    pub fn input(why: impl Display) -> Failure {
        Failure::Input(format!("error: {why}"))
    }
}

impl From<Diagnostic> for Failure {
    fn from(error: Diagnostic) -> Self {
        Failure::from(Diagnostics(vec![error]))
    }
}

impl From<Diagnostics> for Failure {
    fn from(errors: Diagnostics) -> Self {
        Failure::Input(as_flags(errors.render().trim_end()))
    }
}

impl From<GenerateError> for Failure {
    fn from(error: GenerateError) -> Self {
        let text = as_flags(&format!("error: {error}"));
        match error {
            // Failed proofs, runs and text checks are failed checks; all other errors come
            // from the robot or the request.
            GenerateError::Disproved(_, Disproof::Unfit | Disproof::Large) => Failure::Input(text),
            GenerateError::Disproved(..) | GenerateError::Defect(..) => Failure::Check(text),
            _ => Failure::Input(text),
        }
    }
}

/// The options that all subcommands share, and whether there was a warning.
pub struct Context {
    pub json: bool,
    pub force: bool,
    pub denies_warnings: bool,
    pub warned: Cell<bool>,
}

impl Context {
    /// Prints notes and warnings, and records whether there was a warning.
    pub fn say(&self, text: &str) {
        self.heard(text.lines().any(|line| line.starts_with("warning")));
        note(text);
    }

    /// Records whether there was a warning, without printing it.
    pub fn heard(&self, is_warning: bool) {
        self.warned.set(self.warned.get() || is_warning);
    }

    pub fn undenied(&self) -> Result<(), Failure> {
        if self.warned.get() && self.denies_warnings {
            let why = "error: --deny-warnings is set, and there were warnings";
            return Err(Failure::Check(why.into()));
        }
        Ok(())
    }
}

const QUIET: Duration = Duration::from_secs(2);

static BAR: Mutex<Option<ProgressBar>> = Mutex::new(None);

/// A guard: the bar is shown until it is dropped.
pub struct BarGuard;

/// Starts the bar of a run; it appears on a terminal after two seconds.
pub fn begin() -> BarGuard {
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
    BarGuard
}

impl Drop for BarGuard {
    fn drop(&mut self) {
        bar().finish_and_clear();
    }
}

/// Starts the next step of a long run and shows its name.
pub fn step(name: &str) {
    bar().set_message(name.to_owned());
    bar().inc(1);
}

pub fn bar() -> ProgressBar {
    let bar = BAR.lock().unwrap_or_else(PoisonError::into_inner).clone();
    bar.unwrap_or_else(ProgressBar::hidden)
}

/// Prints to standard output. A closed pipe, as in `… | head`, is no failure.
pub fn print(text: &str) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    match bar().suspend(|| out.write_all(text.as_bytes()).and_then(|()| out.flush())) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            let why = format!("standard output cannot be written: {error}");
            Err(Failure::input(why))
        }
        _ => Ok(()),
    }
}

const COLOURS: [(&str, &str); 6] = [
    ("error", "1;31"),
    ("warning", "1;33"),
    ("note", "1;36"),
    ("  = help", "1;32"),
    ("  = note", "1;36"),
    (" --> ", "1;34"),
];

/// Hides a control character, which would move the cursor of a message's reader.
pub fn printable(c: char) -> char {
    if c.is_control() { '\u{fffd}' } else { c }
}

/// Writes control characters out, which would move the cursor of whoever reads a file's words.
pub fn escaped(text: &str) -> String {
    let plain = |c: char| match c.is_control() && !['\n', '\t'].contains(&c) {
        true => format!("\\u{:04x}", u32::from(c)),
        false => c.to_string(),
    };
    text.chars().map(plain).collect()
}

/// Prints lines on standard error: in colour on a terminal, unless the environment says otherwise
/// (`NO_COLOR`, `CLICOLOR_FORCE`).
pub fn note(text: &str) {
    let plain = AutoStream::choice(&io::stderr()) == ColorChoice::Never;
    let coloured = |line: &str| match COLOURS.iter().find(|(mark, _)| line.starts_with(mark)) {
        Some((mark, code)) if !plain => {
            format!("\x1b[{code}m{mark}\x1b[0m{}", &line[mark.len()..])
        }
        _ => line.to_owned(),
    };
    let lines: Vec<String> = escaped(text.trim_end()).split('\n').map(coloured).collect();
    bar().suspend(|| {
        // No stream is left on which to report an error.
        let _ = writeln!(io::stderr().lock(), "{}", lines.join("\n"));
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_of_a_file_move_no_cursor() {
        let text = "line 2: `\u{1b}[2J\r\u{9b}8m`\n\tτ";
        assert_eq!(escaped(text), "line 2: `\\u001b[2J\\u000d\\u009b8m`\n\tτ");
    }
}
