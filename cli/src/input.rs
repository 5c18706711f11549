//! Robot files, and files of states.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use crate::states::GivenState;
use crate::states::file::{self, FileError};
use dalembert_codegen::workspace::{find_scene, generate_anew, plan_file};
use dalembert_codegen::{Asked, Generated, Problem, Request, RobotFileError, ScalarType};
use dalembert_model::read::{self, Reading};
use dalembert_model::robot::Robot;
use dalembert_model::scene::Scene;

use crate::outcome::Failure;
use crate::output;

/// The largest file of states.
const MAX_STATES_BYTES: u64 = 1 << 28;

/// Reads a robot file; its warnings and notes go to standard error.
pub fn robot(path: &Path) -> Result<Robot, Failure> {
    Ok(reading(path)?.robot)
}

/// A robot file, and what is asked of it.
pub struct Wanted {
    pub robot: Robot,
    /// The text of the file.
    pub source: String,
    pub request: Request,
}

/// Reads a robot file and what is asked of it, in these scalars where nobody says which; with the
/// plan beside the file, unless that is to be left alone.
pub fn wanted(path: &Path, asked: &Asked, scalars: &[ScalarType]) -> Result<Wanted, Failure> {
    let (reading, source) = read(path)?;
    let request = Request::parse(asked, scalars, &reading.outputs, &reading.scenes);
    let mut request = request.map_err(|problems| Failure::Input(problems_of(&problems)))?;
    if !request.has_no_plan {
        request.plan = plan_file::beside(path)
            .map_err(|message| Failure::Input(format!("error: {message}")))?;
    }
    Ok(Wanted {
        robot: reading.robot,
        source,
        request,
    })
}

/// Says what is wrong with what was asked, flag by flag.
fn problems_of(problems: &[Problem]) -> String {
    let one = |problem: &Problem| {
        let flag = problem.option.replace('_', "-");
        let help = match problem.help.as_str() {
            "" => String::new(),
            help => format!("\n  = help: {help}"),
        };
        format!("error: --{flag}: {}{help}", problem.message)
    };
    let each: Vec<String> = problems.iter().map(one).collect();
    each.join("\n\n")
}

/// Returns a scene of a robot file.
pub fn scene<'r>(path: &Path, reading: &'r Reading, name: &str) -> Result<&'r Scene, Failure> {
    find_scene(&reading.scenes, name).map_err(|error| {
        Failure::Input(format!(
            "error: {}: {}\n  = help: {}",
            path.display(),
            error.message(),
            error.help()
        ))
    })
}

/// Reads a robot file; its warnings and notes go to standard error.
pub fn reading(path: &Path) -> Result<Reading, Failure> {
    Ok(read(path)?.0)
}

/// Reads a robot file, and returns its text beside it.
fn read(path: &Path) -> Result<(Reading, String), Failure> {
    // One byte more than allowed: the reader says that it is too long.
    let bytes = begin(path, read::MAX_BYTES as u64 + 1)?;
    let source = String::from_utf8_lossy(&bytes).into_owned();
    let name = path.display().to_string();
    match read::parse_bytes(&bytes, &read::Options::default()) {
        Ok(reading) => {
            for note in &reading.notes {
                output::note(&note.render(&name, &source));
            }
            output::undenied()?;
            Ok((reading, source))
        }
        Err(errors) => Err(Failure::Input(errors.render(&name, &source))),
    }
}

/// Generates for a robot file; a plan that no longer fits it is a warning.
///
/// # Errors
/// Those of generating.
pub fn generated(path: &Path, robot: &Robot, request: &Request) -> Result<Generated, Failure> {
    let shown = path.display().to_string();
    Ok(generate_anew(robot, request, &shown)?)
}

/// Reads the states of a file for a robot of n joints.
pub fn states(path: &Path, n: usize) -> Result<Vec<GivenState>, Failure> {
    let name = path.display();
    file::read(&bytes(path, MAX_STATES_BYTES)?, n).map_err(|error| {
        Failure::Input(match error {
            FileError::Syntax {
                message,
                line,
                column,
            } => format!("error: {message}\n --> {name}:{line}:{column}"),
            FileError::Content(message) => format!("error: {name}: {message}"),
        })
    })
}

/// Returns a whole file.
///
/// # Errors
/// It cannot be read, or is longer than `most`.
pub fn bytes(path: &Path, most: u64) -> Result<Vec<u8>, Failure> {
    let bytes = begin(path, most + 1)?;
    if bytes.len() as u64 > most {
        return Err(Failure::Input(format!(
            "error: `{}` is longer than {} MiB, the most that is read",
            path.display(),
            most >> 20
        )));
    }
    Ok(bytes)
}

fn begin(path: &Path, most: u64) -> Result<Vec<u8>, Failure> {
    first(path, most).map_err(|error| {
        let shown = path.display().to_string();
        let said = RobotFileError::of_system(path, &shown, &error).to_string();
        let whole = std::path::absolute(path)
            .ok()
            .filter(|_| path.is_relative());
        Failure::Input(match whole {
            Some(whole) => format!("{said}\n  = note: its full path is `{}`", whole.display()),
            None => said,
        })
    })
}

/// Returns the first bytes of a file: no more are read, since a device may have no
/// end.
pub fn first(path: &Path, most: u64) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    File::open(path)?.take(most).read_to_end(&mut bytes)?;
    Ok(bytes)
}
