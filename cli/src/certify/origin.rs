//! The robot that a certificate or generated file names, compared with the robot file that is given.

use std::path::Path;
use std::slice;

use dalembert_model::read::{Options, parse};
use serde_json::Value;

use crate::outcome::Failure;

/// Refuses a file that names another robot; returns a note where it names this one before an edit.
///
/// # Errors
/// The file names another robot.
pub fn check(
    file: &Path,
    source: &str,
    path: &Path,
    robot: &str,
) -> Result<Option<String>, Failure> {
    // The checker says what is wrong with a robot file.
    let Ok(reading) = parse(robot, &Options::default()) else {
        return Ok(None);
    };
    let robot = reading.robot;
    let hash: String = (robot.input_hash().iter())
        .map(|byte| format!("{byte:02x}"))
        .collect();
    let origins = named(source).into_iter();
    let others = origins.filter(|(_, input)| input.len() < 16 || !hash.starts_with(input));
    // Another robot before an edited one.
    let Some((name, input)) = others.min_by_key(|(name, _)| *name == robot.name) else {
        return Ok(None);
    };
    let found = format!(
        "`{}` is of robot `{name}`, input {input:.16}; `{}` is robot `{}`, input {hash:.16}",
        file.display(),
        path.display(),
        robot.name
    );
    if name == robot.name {
        return Ok(Some(format!("note: {found}: it was edited since")));
    }
    Err(Failure::Check(format!(
        "error: {found}\n  = help: --robot takes the robot file that it was generated from"
    )))
}

/// Returns the robots, and the hashes of what their files say, that a generated file has in its
/// documentation, and certificates in their fields.
fn named(source: &str) -> Vec<(String, String)> {
    let documentation = source.split_once("Dynamics of the robot `");
    let origin = documentation.and_then(|(_, rest)| {
        let (robot, rest) = rest.split_once('`')?;
        let input = rest.split_once("Input hash ")?.1.split('.').next()?;
        Some((robot.to_owned(), input.to_owned()))
    });
    let document: Value = serde_json::from_str(source).unwrap_or_default();
    let one = slice::from_ref(&document);
    let certificates = document.as_array().map_or(one, Vec::as_slice).iter();
    let fields = certificates.filter_map(|certificate| {
        let field = |key: &str| Some(certificate[key].as_str()?.to_owned());
        Some((field("robot")?, field("input")?))
    });
    origin.into_iter().chain(fields).collect()
}
