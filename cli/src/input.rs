//! Robot files, and files of states.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use dalembert_codegen::RobotFileError;
use dalembert_codegen::workspace::generate::{GenerateError, Generated, generate, generate_anew};
use dalembert_codegen::workspace::plan;
use dalembert_codegen::workspace::sincos::SinCos;
use dalembert_codegen::workspace::task::Request;
use dalembert_codegen::workspace::task::in_scene::find;
use dalembert_model::read::{self, Reading};
use dalembert_model::robot::Robot;
use dalembert_model::scene::Scene;
use dalembert_report::states::GivenState;
use dalembert_report::states::file::{self, FileError};

use crate::args::Choice;
use crate::outcome::Failure;
use crate::output;

/// The largest file of states.
const MAX_STATES_BYTES: u64 = 1 << 28;

/// Reads a robot file; its warnings and notes go to standard error.
pub fn robot(path: &Path) -> Result<Robot, Failure> {
    Ok(reading(path)?.robot)
}

/// Reads a robot file and makes the request of a choice, its scene included.
pub fn robot_and_request(path: &Path, choice: &Choice) -> Result<(Robot, Request), Failure> {
    let reading = reading(path)?;
    let name = choice.scene.as_ref();
    let scene = name.map(|name| self::scene(path, &reading, name));
    let scene = scene.transpose()?;
    let outputs = (!choice.outputs.is_empty()).then(|| choice.outputs.clone());
    let scalars = choice.scalar.map(|scalar| vec![scalar]);
    let request = request(path, choice)?.for_file(&reading.outputs);
    let request = request.choose(outputs, scalars, scene);
    Ok((reading.robot, request))
}

/// Returns a scene of a robot file.
pub fn scene<'r>(path: &Path, reading: &'r Reading, name: &str) -> Result<&'r Scene, Failure> {
    find(&reading.scenes, name).map_err(|error| {
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
    // One byte more than allowed: the reader says that it is too long.
    let bytes = begin(path, read::MAX_BYTES as u64 + 1)?;
    let source = String::from_utf8_lossy(&bytes);
    let name = path.display().to_string();
    match read::parse_bytes(&bytes, &read::Options::default()) {
        Ok(reading) => {
            for note in &reading.notes {
                output::note(&note.render(&name, &source));
            }
            output::undenied()?;
            Ok(reading)
        }
        Err(errors) => Err(Failure::Input(errors.render(&name, &source))),
    }
}

/// Generates for a robot file; a plan that no longer fits it is a warning, and an error
/// where what is generated is compared.
///
/// # Errors
/// Those of generating.
pub fn generated(
    path: &Path,
    robot: &Robot,
    request: &Request,
    compared: bool,
) -> Result<Generated, Failure> {
    if !compared {
        let shown = path.display().to_string();
        return Ok(generate_anew(robot, request, &shown)?);
    }
    generate(robot, request).map_err(|error| {
        let stale = matches!(
            error,
            GenerateError::StalePlan { .. } | GenerateError::StaleScene { .. }
        );
        match Failure::from(error) {
            Failure::Input(text) if stale => Failure::Input(format!(
                "{text}\n --> {}\n  = help: --no-plan searches without it",
                plan::file::path(path).display()
            )),
            other => other,
        }
    })
}

/// Returns the request of a choice, with the plan beside the robot file unless the
/// choice does without.
fn request(robot_file: &Path, choice: &Choice) -> Result<Request, Failure> {
    let mut request = choice.request();
    if choice.sincos_error.is_some() && !matches!(request.sincos, SinCos::Polynomial { .. }) {
        return Err(Failure::Input(
            "error: only polynomials have an error to choose: add --sincos polynomial".into(),
        ));
    }
    if !choice.no_plan {
        request.plan = plan::file::beside(robot_file)
            .map_err(|message| Failure::Input(format!("error: {message}")))?;
    }
    Ok(request)
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
