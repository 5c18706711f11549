//! Robot files, and states in the format of the golden files.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use dalembert_codegen::function::Quantity;
use dalembert_codegen::generate::Request;
use dalembert_codegen::plan;
use dalembert_codegen::scene;
use dalembert_codegen::sincos::SinCos;
use dalembert_codegen::verify::floating::GivenState;
use dalembert_codegen::verify::states::JointState;
use dalembert_model::read::{self, Reading};
use dalembert_model::robot::Robot;
use dalembert_model::scene::Scene;
use serde_json::Value;

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
    let mut request = request(path, choice)?;
    if let Some(name) = &choice.scene {
        let scene = scene(path, &reading, name)?;
        let (outputs, scalars) = (!choice.outputs.is_empty(), choice.scalar.is_some());
        request = request.in_scene(scene, outputs, scalars);
    }
    Ok((reading.robot, request))
}

/// A scene of a robot file.
pub fn scene<'r>(path: &Path, reading: &'r Reading, name: &str) -> Result<&'r Scene, Failure> {
    scene::find(&reading.scenes, name).map_err(|error| {
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
            Ok(reading)
        }
        Err(errors) => Err(Failure::Input(errors.render(&name, &source))),
    }
}

/// The request of a choice, with the plan beside the robot file unless the
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

/// Reads the states of a golden file for a robot of n joints.
pub fn states(path: &Path, n: usize) -> Result<Vec<GivenState>, Failure> {
    let name = path.display();
    let fail = |why: String| Failure::Input(format!("error: {name}: {why}"));
    let bytes = bytes(path, MAX_STATES_BYTES)?;
    let json: Value = serde_json::from_slice(&bytes).map_err(|error| {
        let (line, column) = (error.line(), error.column());
        Failure::Input(format!("error: {error}\n --> {name}:{line}:{column}"))
    })?;
    let list = json
        .get("states")
        .and_then(Value::as_array)
        .ok_or_else(|| fail("there is no list `states`".into()))?;
    if list.is_empty() {
        return Err(fail("the list `states` is empty".into()));
    }
    let state =
        |(index, value)| state(value, n).map_err(|why| fail(format!("state {}: {why}", index + 1)));
    list.iter().enumerate().map(state).collect()
}

fn state(value: &Value, n: usize) -> Result<GivenState, String> {
    let need = |key: &str| vector(value, key, n)?.ok_or_else(|| format!("`{key}` is missing"));
    let state = JointState {
        q: need("q")?,
        qd: need("qd")?,
        qdd: need("qdd")?,
    };
    let mut known = BTreeMap::new();
    for (key, quantity) in [
        ("tau", Quantity::Torque),
        ("h", Quantity::Coriolis),
        ("c", Quantity::Gravity),
    ] {
        if let Some(values) = vector(value, key, n)? {
            known.insert(quantity, values);
        }
    }
    if let Some(values) = vector(value, "D", n * n)? {
        known.insert(Quantity::Inertia, values);
    }
    Ok(GivenState { state, known })
}

/// A list of numbers, or a matrix as rows or row by row.
fn vector(value: &Value, key: &str, len: usize) -> Result<Option<Vec<f64>>, String> {
    let Some(value) = value.get(key) else {
        return Ok(None);
    };
    let list = value
        .as_array()
        .ok_or_else(|| format!("`{key}` is not a list"))?;
    let mut numbers = Vec::new();
    for item in list {
        match item {
            Value::Array(row) => numbers.extend(row.iter().map(Value::as_f64)),
            other => numbers.push(other.as_f64()),
        }
    }
    let numbers: Option<Vec<f64>> = numbers.into_iter().collect();
    let numbers = numbers.ok_or_else(|| format!("`{key}` has an entry that is no number"))?;
    if numbers.len() != len {
        return Err(format!("`{key}` has {} numbers, not {len}", numbers.len()));
    }
    Ok(Some(numbers))
}

/// A whole file.
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
        Failure::Input(format!(
            "error: `{}` cannot be read: {error}",
            path.display()
        ))
    })
}

/// The first bytes of a file: no more are read, since a device may have no
/// end.
pub fn first(path: &Path, most: u64) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    File::open(path)?.take(most).read_to_end(&mut bytes)?;
    Ok(bytes)
}
