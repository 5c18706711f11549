//! Logs that no query reads as they are: recordings of ROS 2, rates that are missing, lists in
//! other units. They become Parquet files of the columns that this program writes.

use std::path::Path;

use super::block::open;
use super::check::{Bad, Clock, Log};
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
    let (mut clock, mut rows) = (Clock::default(), 0);
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
            let each = (0..4).flat_map(|of| (0..n).map(move |i| (of, i)));
            let each = each.map(|(quantity, joint)| block.column(quantity, joint));
            let all: Vec<&[f64]> = std::iter::once(&block.time[..]).chain(each).collect();
            table.write("", &all).map_err(whole)?;
            rows += block.len() as u64;
        }
        if !goes_on() {
            break;
        }
    }
    table.close().map_err(whole)?;
    if rows == 0 && goes_on() {
        return Err(Bad::whole(
            name,
            "it is too short to differentiate its positions: log velocities and accelerations",
        ));
    }
    let canonical = Columns::canonical(n);
    let written = open(to).map_err(whole)?;
    let groups = written.metadata().row_groups().iter();
    let group = groups
        .map(|group| group.compressed_size().max(0) as u64)
        .max();
    Ok(Log {
        name: name.clone(),
        path: to.to_owned(),
        rows,
        layout: canonical.layout(written.schema()).map_err(whole)?,
        columns: canonical,
        group: group.unwrap_or(0),
        converts: false,
    })
}
