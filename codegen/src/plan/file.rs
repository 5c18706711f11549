//! The plan beside a robot file.

use std::fs::{self, File};
use std::io::{ErrorKind, Read};
use std::path::{Path, PathBuf};

use dalembert_checker::claim::MOST_BYTES;
use dalembert_model::diagnostic::Diagnostic;

use super::Plan;

/// Returns where a robot file's plan is: `puma560.plan` beside `puma560.toml`.
pub fn path(robot_file: &Path) -> PathBuf {
    robot_file.with_extension("plan")
}

/// Makes cargo notice a plan that was not there before.
///
/// A macro that was expanded without a plan could not name it to the compiler. It did name the
/// robot file, so that gets a new time.
pub fn announce(robot_file: &Path) -> std::io::Result<()> {
    let file = File::options().append(true).open(robot_file)?;
    file.set_modified(std::time::SystemTime::now())
}

/// One byte more than `most` is enough to refuse a file; the path may be a device without end.
pub(crate) fn bytes(path: &Path, most: usize) -> std::io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    let file = File::open(path)?;
    file.take(most as u64 + 1).read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// Reads the plan beside a robot file; there need not be one.
pub fn beside(robot_file: &Path) -> Result<Option<Plan>, Diagnostic> {
    let path = path(robot_file);
    let shown = path.display();
    // Opening a pipe would wait for somebody who writes into it.
    if fs::metadata(&path).is_ok_and(|metadata| !metadata.is_file()) {
        let why = format!("cannot read `{shown}`: a plan is a file");
        return Err(Diagnostic::error(why));
    }
    let bytes = match bytes(&path, MOST_BYTES) {
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
        Err(error) => return Err(Diagnostic::error(format!("cannot read `{shown}`: {error}"))),
        Ok(bytes) => bytes,
    };
    let text = String::from_utf8(bytes)
        .map_err(|_| Diagnostic::error(format!("`{shown}` is not UTF-8")))?;
    let plan = Plan::parse(&text).map_err(|why| Diagnostic::error(format!("{shown}: {why}")))?;
    Ok(Some(plan))
}
