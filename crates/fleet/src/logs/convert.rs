//! Logs that no query reads as they are: recordings of ROS 2, rates that are missing, lists in
//! other units or of any length. They become Parquet files of the columns that this program writes.

use std::path::Path;

use super::check::{Clock, Log, Origin, inspect};
use super::mapping::Columns;
use super::rates::Rates;
use super::states;
use super::write::{Table, canonical_names};
use crate::error::Error;
use crate::progress::Going;

/// Converts a log. Measured velocities are used unless they are not the positions' rates.
pub fn convert(log: &Log, to: &Path, going: &Going) -> Result<Log, Error> {
    let (converted, wrong) = attempt(log, to, going, true)?;
    let Some(joint) = wrong else {
        return Ok(converted);
    };
    let (mut converted, _) = attempt(log, to, going, false)?;
    let joint = joint + 1;
    converted.origin.rates +=
        &format!(", since the measured velocities of joint {joint} are not their rates");
    Ok(converted)
}

/// Returns a joint whose velocities are wrong, too.
fn attempt(
    log: &Log,
    to: &Path,
    going: &Going,
    velocities: bool,
) -> Result<(Log, Option<usize>), Error> {
    let columns = &log.columns;
    let n = columns.joints;
    let mut table = Table::create(to, &canonical_names(n), false)?;
    let mut rates: Option<Rates> = None;
    let (mut clock, mut read, mut written) = (Clock::default(), 0, 0);
    for block in states(&log.path, columns)? {
        let mut block = block?;
        for (row, time) in block.rows.iter().zip(&block.time) {
            clock.see(*row, *time)?;
        }
        block.check()?;
        let measured = [velocities && block.has(1), block.has(2)];
        if rates.is_none() && measured != [true; 2] && !block.is_empty() {
            rates = Some(Rates::new(n, columns.motion_frequency, measured));
        }
        read += block.len() as u64;
        if let Some(rates) = &mut rates {
            block = rates.next(block)?;
        }
        if !block.is_empty() {
            let quantities = block.quantities.iter().map(Vec::as_slice);
            table.write("", &block.time, quantities)?;
            written += block.len() as u64;
        }
        going.check()?;
    }
    table.close()?;
    if written == 0 {
        return Err(Error::new(match read {
            0 => "every row has a null",
            _ => "it is too short to differentiate its positions: log velocities and accelerations",
        }));
    }
    let origin = Origin {
        nulls: log.rows.saturating_sub(read),
        ends: read - written,
        rates: rates.as_ref().map_or(String::new(), Rates::told),
    };
    let converted = Log {
        name: log.name.clone(),
        origin,
        ..inspect(to, &Columns::canonical(n), going)?
    };
    Ok((converted, rates.and_then(|rates| rates.disagreeing())))
}
