//! The plan beside a robot file.

use std::fs::File;
use std::io::{ErrorKind, Read};
use std::path::{Path, PathBuf};

use super::Plan;
use super::parse::MOST_BYTES;

/// Where a robot file's plan is: `puma560.plan` beside `puma560.toml`.
pub fn path(robot_file: &Path) -> PathBuf {
    robot_file.with_extension("plan")
}

/// Reads the plan beside a robot file; there need not be one.
///
/// # Errors
/// A message that names the file, and the line if the text is wrong.
pub fn beside(robot_file: &Path) -> Result<Option<Plan>, String> {
    let path = path(robot_file);
    let shown = path.display();
    let mut bytes = Vec::new();
    let read =
        File::open(&path).and_then(|file| file.take(MOST_BYTES as u64 + 1).read_to_end(&mut bytes));
    match read {
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
        Err(error) => return Err(format!("cannot read `{shown}`: {error}")),
        Ok(_) => {}
    }
    let text = String::from_utf8(bytes).map_err(|_| format!("`{shown}` is not UTF-8"))?;
    Plan::parse(&text)
        .map(Some)
        .map_err(|error| format!("{shown}:{}: {}", error.line, error.message))
}
