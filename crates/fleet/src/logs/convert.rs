//! Logs that no query reads as they are: recordings of ROS 2, rates that are missing, lists in
//! other units. They become Parquet files of the columns that this program writes.

use std::path::Path;

use super::check::{Clock, Log, inspect};
use super::mapping::Columns;
use super::rates::Rates;
use super::states;
use super::write::{Table, canonical_names};
use crate::error::Error;
use crate::progress::Going;

/// Converts a log; returns that of the file that was written.
///
/// # Errors
/// The fault in the log, with its row; or that the command was ended.
pub fn convert(log: &Log, to: &Path, going: &Going) -> Result<Log, Error> {
    let columns = &log.columns;
    let n = columns.joints;
    let mut table = Table::create(to, &canonical_names(n), false)?;
    let mut rates: Option<Rates> = None;
    let (mut clock, mut is_written) = (Clock::default(), false);
    for block in states(&log.path, columns)? {
        let mut block = block?;
        for (row, time) in block.rows.iter().zip(&block.time) {
            clock.see(*row, *time)?;
        }
        block.check()?;
        if block.quantities[1].is_empty() || block.quantities[2].is_empty() {
            let rates = rates.get_or_insert_with(|| Rates::new(n, columns.motion_frequency));
            block = rates.next(block)?;
        }
        if !block.is_empty() {
            let all = block.quantities.iter().map(Vec::as_slice);
            table.write("", &block.time, all)?;
            is_written = true;
        }
        going.check()?;
    }
    table.close()?;
    if !is_written {
        return Err(Error::new(
            "it is too short to differentiate its positions: log velocities and accelerations",
        ));
    }
    Ok(Log {
        name: log.name.clone(),
        ..inspect(to, &Columns::canonical(n), going)?
    })
}
