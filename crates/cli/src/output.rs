//! The frame of all subcommands: each takes a [`Context`] and returns [`Done`] or a [`Failure`], and
//! [`Context::finish`] prints and writes it.

use std::cell::Cell;
use std::fmt::Display;
use std::path::PathBuf;

use dalembert_codegen::workspace::{Disproof, plan_file};
use dalembert_codegen::{Diagnostic, Diagnostics, GenerateError};

use crate::args::as_flags;
use crate::files::{self, Target};
use crate::report::Report;
use crate::terminal::{escaped, note, print};

/// The result of a subcommand.
pub type Outcome = Result<Done, Failure>;

/// The failure of a run, with its text for standard error.
#[derive(Debug)]
pub enum Failure {
    /// A check failed: exit code 1.
    Check(String),
    /// The input cannot be used: exit code 2.
    Input(String),
}

impl Failure {
    /// Returns the failure of an input that cannot be used.
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

/// The report, the files and the notes of a subcommand.
#[derive(Default)]
pub struct Done {
    /// The report to print.
    pub report: Report,
    /// True if the report's text goes to standard error, because a file may go to standard output.
    pub is_aside: bool,
    /// The files to write: all or none.
    pub files: Vec<(Target, String)>,
    /// The robot file that gets a new modification time, so that macros notice its first plan.
    pub announced: Option<PathBuf>,
    /// Lines that are printed on standard error after everything is written.
    pub notes: Vec<String>,
    /// The reasons why the check failed; with any, the exit code is 1.
    pub failed: Vec<String>,
}

impl From<Report> for Done {
    fn from(report: Report) -> Done {
        Done {
            report,
            ..Done::default()
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

    /// Fails if there was a warning and warnings are denied.
    pub fn undenied(&self) -> Result<(), Failure> {
        if self.warned.get() && self.denies_warnings {
            let why = "error: --deny-warnings is set, and there were warnings";
            return Err(Failure::Check(why.into()));
        }
        Ok(())
    }

    /// Writes the files of a run and prints its report; after denied warnings, only a JSON report.
    pub fn finish(&self, done: Done) -> Result<(), Failure> {
        let denied = self.undenied();
        if denied.is_ok() {
            files::write(&done.files)?;
        }
        let text = escaped(&match self.json {
            // This cannot fail: all keys of reports are strings.
            true => serde_json::to_string_pretty(&done.report).unwrap_or_default() + "\n",
            false => done.report.to_string(),
        });
        match done.is_aside && !self.json {
            _ if denied.is_err() && !self.json => {}
            _ if text.is_empty() => {}
            true => note(&text),
            false => print(&text)?,
        }
        denied?;
        if let Some(robot) = &done.announced
            && let Err(error) = plan_file::announce(robot)
        {
            note(&format!(
                "warning: the modification time of `{}` cannot be updated ({error}): save the file again so that \
                 macros and build scripts use the new plan",
                robot.display()
            ));
        }
        done.notes.iter().for_each(|line| note(line));
        match done.failed.is_empty() {
            true => Ok(()),
            false => Err(Failure::Check(done.failed.join("\n"))),
        }
    }
}
