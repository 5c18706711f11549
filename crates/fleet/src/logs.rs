//! Logs: which columns are what, states in order, and what is wrong with a file.
//!
//! - `mapping`: columns and units
//! - `format`: what a file is that is neither Parquet nor MCAP
//! - `block`: states of a Parquet file; `mcap`: those of ROS 2's recordings
//! - `rates`: velocities and accelerations that a log does not have
//! - `check`: files that cannot be used, each with row and reason
//! - `write`: Parquet files of our own; `convert`: logs that no query can read as they are
//! - [`walk`]: residuals in the order of a log's rows, which a query does not keep

pub(crate) mod block;
mod check;
mod convert;
mod format;
mod mapping;
mod mcap;
mod rates;
mod write;

use std::path::{Path, PathBuf};

pub use block::{Block, Blocks};
pub use check::{Log, Origin, inspect};
pub use convert::convert;
pub use mapping::{Columns, Layout, Mapping, Source, TimeUnit, Units};
pub use mcap::Messages;
pub use write::{Table, canonical_names};

use crate::dynamics::Dynamics;
use crate::error::Error;
use crate::progress::Going;

/// Returns the files of patterns, in order and each once.
pub fn expand(patterns: &[String]) -> Result<Vec<PathBuf>, Error> {
    let mut paths = Vec::new();
    for pattern in patterns {
        // A file may be called what looks like a pattern.
        if Path::new(pattern).is_file() {
            paths.push(PathBuf::from(pattern));
            continue;
        }
        let before = paths.len();
        for path in glob::glob(pattern).map_err(|why| Error::new(why).at(pattern))? {
            let path = path.map_err(Error::new)?;
            paths.extend(path.is_file().then_some(path));
        }
        if paths.len() == before {
            return Err(Error::new(format!(
                "no file matches `{pattern}`: quote patterns as 'logs/**/*.parquet'"
            )));
        }
    }
    paths.sort();
    paths.dedup();
    Ok(paths)
}

pub fn is_mcap(path: &Path) -> bool {
    let extension = path.extension();
    extension.is_some_and(|extension| extension.eq_ignore_ascii_case("mcap"))
}

/// Opens a log of either kind.
pub fn states<'a>(
    path: &Path,
    columns: &'a Columns,
) -> Result<Box<dyn Iterator<Item = Result<Block, Error>> + 'a>, Error> {
    Ok(match is_mcap(path) {
        true => Box::new(Messages::open(path, columns)?),
        false => Box::new(Blocks::open(path, columns)?),
    })
}

/// Calls with blocks of states and their residuals, column by column.
pub fn walk(
    robot: &dyn Dynamics,
    log: &Log,
    going: &Going,
    mut call: impl FnMut(&Block, &[f64]) -> Result<(), Error>,
) -> Result<(), Error> {
    let mut residuals = Vec::new();
    for block in states(&log.path, &log.columns)? {
        let block = block?;
        going.check()?;
        // Every row of it may have a null.
        if !block.is_empty() {
            robot.residuals(block.len(), &block.quantities, &mut residuals)?;
            call(&block, &residuals)?;
        }
    }
    Ok(())
}
