//! What all subcommands share.

use std::cell::Cell;

use crate::failure::Failure;
use crate::terminal::note;

/// The options that all subcommands share, and whether there was a warning.
pub struct Context {
    pub json: bool,
    pub force: bool,
    denies_warnings: bool,
    warned: Cell<bool>,
}

impl Context {
    pub fn new(json: bool, force: bool, denies_warnings: bool) -> Context {
        Context {
            json,
            force,
            denies_warnings,
            warned: Cell::new(false),
        }
    }

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
    ///
    /// # Errors
    /// A failed check.
    pub fn undenied(&self) -> Result<(), Failure> {
        match self.warned.get() && self.denies_warnings {
            true => Err(Failure::Check(
                "error: --deny-warnings is set, and there were warnings".into(),
            )),
            false => Ok(()),
        }
    }
}
