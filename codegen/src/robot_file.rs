//! A robot file from a path.

use std::fs;
use std::io::ErrorKind;
use std::path::Path;

use dalembert_model::diagnostic::{Diagnostic, Diagnostics, closest};
use dalembert_model::read;
use dalembert_model::robot::Robot;
use dalembert_model::scene::Scene;

use crate::function::Function;
use crate::plan::{self, Plan};

/// A robot file that was read.
#[derive(Clone, Debug)]
pub struct RobotFile {
    /// The robot.
    pub robot: Robot,
    /// The functions that the file is for; empty if it does not say.
    pub outputs: Vec<Function>,
    /// Its scenes.
    pub scenes: Vec<Scene>,
    /// Warnings and notes.
    pub notes: Vec<Diagnostic>,
    /// The text, which the notes' spans are about.
    pub source: String,
    /// The plan beside the file, if there is one.
    pub plan: Option<Plan>,
}

impl RobotFile {
    /// Reads the file at a path; messages call it by the path.
    ///
    /// # Errors
    /// Everything that is wrong with the file.
    pub fn read(path: &Path) -> Result<RobotFile, Diagnostics> {
        Self::read_as(path, &path.display().to_string())
    }

    /// Reads the file at a path; messages call it by a shorter name.
    ///
    /// # Errors
    /// As [`RobotFile::read`].
    pub fn read_as(path: &Path, shown: &str) -> Result<RobotFile, Diagnostics> {
        let bytes = plan::file::bytes(path, read::MAX_BYTES)
            .map_err(|error| unreadable(path, shown, &error))?;
        let plan = plan::file::beside(path)?;
        let file = Self::parse_bytes(&bytes, shown)?;
        Ok(RobotFile { plan, ..file })
    }

    /// Reads the text of a robot file, which has no plan; messages call it by this name.
    ///
    /// ```
    /// use dalembert_codegen::RobotFile;
    ///
    /// let errors = RobotFile::parse("name = \"arm\"\nmas = 2", "arm.toml").unwrap_err();
    /// assert!(errors.to_string().contains("--> arm.toml:2:1"), "{errors}");
    /// ```
    ///
    /// # Errors
    /// Every error of the text.
    pub fn parse(text: &str, shown: &str) -> Result<RobotFile, Diagnostics> {
        Self::parse_bytes(text.as_bytes(), shown)
    }

    fn parse_bytes(bytes: &[u8], shown: &str) -> Result<RobotFile, Diagnostics> {
        let reading = read::parse_bytes(bytes).map_err(|errors| errors.in_file(shown))?;
        Ok(RobotFile {
            robot: reading.robot,
            outputs: reading.outputs,
            scenes: reading.scenes,
            notes: reading.notes,
            source: String::from_utf8_lossy(bytes).into_owned(),
            plan: None,
        })
    }
}

/// Returns the system's error about a path; messages call the file by a shorter name.
pub fn unreadable(path: &Path, shown: &str, error: &std::io::Error) -> Diagnostic {
    match error.kind() {
        ErrorKind::NotFound => {
            let help = meant(path, shown).map(|meant| format!("did you mean `{meant}`?"));
            Diagnostic::error(format!("`{shown}` does not exist"))
                .with_help(help.unwrap_or_default())
        }
        _ => Diagnostic::error(format!("cannot read `{shown}`: {error}")),
    }
}

fn meant(path: &Path, shown: &str) -> Option<String> {
    let parent = path.parent().filter(|p| !p.as_os_str().is_empty());
    let folder = parent.unwrap_or(Path::new("."));
    let entries = fs::read_dir(folder).into_iter().flatten();
    let files = entries.filter_map(|entry| entry.ok()?.file_name().into_string().ok());
    let mut robots: Vec<String> = files.filter(|name| name.ends_with(".toml")).collect();
    // The order of a folder differs between machines.
    robots.sort();
    let names: Vec<&str> = robots.iter().map(String::as_str).collect();
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    closest(&name, &names).map(|meant| match shown.strip_suffix(&*name) {
        Some(start) => format!("{start}{meant}"),
        None => meant.to_owned(),
    })
}
