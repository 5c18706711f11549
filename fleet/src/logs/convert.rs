//! Logs that no query reads as they are: recordings of ROS 2, rates that are missing, lists in
//! other units. They become Parquet files of the columns that this program writes.

use std::path::Path;

use super::check::{Bad, Clock, Log, inspect};
use super::mapping::Columns;
use super::rates::Rates;
use super::states;
use super::write::{Table, canonical_names};
use crate::error::Error;

/// Converts a log; returns that of the file that was written.
///
/// # Errors
/// What is wrong with the log, with its row; nothing is said of a conversion that was ended.
pub fn convert(log: &Log, to: &Path, goes_on: &dyn Fn() -> bool) -> Result<Log, Bad> {
    let name = &log.name;
    let whole = |why: Error| Bad::whole(name, why);
    let columns = &log.columns;
    let n = columns.joints;
    let mut table = Table::create(to, &canonical_names(n), false).map_err(whole)?;
    let mut rates: Option<Rates> = None;
    let (mut clock, mut is_written) = (Clock::default(), false);
    for block in states(&log.path, columns).map_err(whole)? {
        let mut block = block.map_err(whole)?;
        for (row, time) in block.rows.iter().zip(&block.time) {
            if let Some(reason) = clock.see(*time) {
                return Err(Bad::row(name, *row, reason));
            }
        }
        if let Some((row, what)) = block.not_finite() {
            return Err(Bad::row(name, row, what));
        }
        if block.quantities[1].is_empty() || block.quantities[2].is_empty() {
            let rates = rates.get_or_insert_with(|| Rates::new(n, columns.motion_frequency));
            block = rates.next(block).map_err(|(row, why)| Bad {
                row,
                ..Bad::whole(name, why)
            })?;
        }
        if !block.is_empty() {
            let all = block.quantities.iter().map(Vec::as_slice);
            table.write("", &block.time, all).map_err(whole)?;
            is_written = true;
        }
        if !goes_on() {
            break;
        }
    }
    table.close().map_err(whole)?;
    if !is_written && goes_on() {
        return Err(Bad::whole(
            name,
            "it is too short to differentiate its positions: log velocities and accelerations",
        ));
    }
    let written = inspect(to, &Columns::canonical(n), goes_on);
    let mut written = written.map_err(|bad| Bad::whole(name, bad.reason))?;
    written.name = name.clone();
    Ok(written)
}
