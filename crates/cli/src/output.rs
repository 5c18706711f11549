//! The frame of all subcommands: each takes a [`Context`] and returns [`Done`] or a [`Failure`], and
//! [`Context::finish`] prints and writes it.

use std::path::PathBuf;

use dalembert_codegen::workspace::plan_file;

use crate::files::{self, Target};
use crate::report::Report;
pub use crate::terminal::{Context, Failure};
use crate::terminal::{escaped, note, print};

pub type Outcome = Result<Done, Failure>;

/// The report, the files and the notes of a subcommand.
#[derive(Default)]
pub struct Done {
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

impl Context {
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
