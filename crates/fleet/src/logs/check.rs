//! The content of a file, and its faults: each with its row and reason.

use std::path::{Path, PathBuf};

use datafusion::arrow::array::{Array, AsArray};
use datafusion::arrow::datatypes::Float64Type;

use super::block::{ROWS, open, projection, seconds};
use super::format::foreign;
use super::is_mcap;
use super::mapping::{Columns, Layout, Source};
use crate::error::Error;
use crate::progress::Going;

/// A log that was looked at.
#[derive(Clone, Debug, PartialEq)]
pub struct Log {
    /// The file that it came as, which reports name.
    pub name: PathBuf,
    /// The file to read: another one if it was converted.
    pub path: PathBuf,
    pub rows: u64,
    /// The columns of the quantities in it.
    pub layout: Layout,
    /// Columns and units of the file to read.
    pub columns: Columns,
    /// Bytes of the largest row group: what a reader holds of it.
    pub group: u64,
    /// The conversion, if there was one.
    pub origin: Origin,
}

/// The rows and rates of a log that was converted.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Origin {
    /// Rows with a null, which are left out.
    pub nulls: u64,
    /// Rows at the ends, which have no derivatives and are left out.
    pub ends: u64,
    /// A sentence on what rates are differentiated from; empty if all were measured.
    pub rates: String,
}

impl Log {
    /// Says, a line each, how many rows a log of so many states left out, and where rates are from.
    pub fn told(&self, states: u64) -> String {
        let Origin { nulls, ends, rates } = &self.origin;
        // Queries have left out rows that no conversion has.
        let nulls = nulls + self.rows.saturating_sub(states);
        let rows = |count: u64, cause: &str| format!("{count} rows left out: {cause}");
        let facts = [
            (nulls > 0).then(|| rows(nulls, "a value is null")),
            (*ends > 0).then(|| rows(*ends, "at the ends there are no derivatives")),
            (!rates.is_empty()).then(|| rates.clone()),
        ];
        let line = |fact: String| format!("{}: {fact}\n", self.name.display());
        facts.into_iter().flatten().map(line).collect()
    }

    /// Returns true if no query can read it as it is: a recording of ROS 2, whose layout is empty,
    /// a log without rates, or lists in other units or of varying lengths.
    pub fn converts(&self) -> bool {
        let mut sources = self.layout.iter().zip(&self.columns.factors);
        sources.any(|(source, factors)| match source {
            None | Some(Source::Ragged(_)) => true,
            Some(Source::List(_)) => factors.iter().any(|factor| *factor != 1.0),
            Some(Source::Columns(_)) => false,
        })
    }
}

/// Times of a log, which have to increase.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Clock {
    last: Option<f64>,
}

impl Clock {
    pub(super) fn see(&mut self, row: u64, time: f64) -> Result<(), Error> {
        let why = match self.last.replace(time) {
            _ if !time.is_finite() => format!("the time is {time}"),
            Some(last) if time == last => format!("the time {time} s is that of the row before"),
            Some(last) if time < last => format!("time goes back from {last} s to {time} s"),
            _ => return Ok(()),
        };
        Err(Error::new(why).at_row(row))
    }
}

/// Looks at a file: its end, its columns, and every time.
pub fn inspect(path: &Path, columns: &Columns, going: &Going) -> Result<Log, Error> {
    let mut log = Log {
        name: path.to_owned(),
        path: path.to_owned(),
        rows: 0,
        layout: [const { None }; 4],
        columns: columns.clone(),
        group: 0,
        origin: Origin::default(),
    };
    if is_mcap(path) {
        return match foreign(path, true)? {
            Some(why) => Err(why),
            None => Ok(log),
        };
    }
    let builder = open(path)?;
    log.layout = columns.layout(builder.schema())?;
    let metadata = builder.metadata().clone();
    let groups = metadata.row_groups().iter();
    let sizes = groups.map(|group| group.compressed_size().max(0) as u64);
    log.group = sizes.max().unwrap_or(0);
    log.rows = metadata.file_metadata().num_rows().max(0) as u64;
    if log.rows == 0 {
        return Err(Error::new("it has no rows"));
    }
    let mask = projection(&builder, &[&columns.time]);
    let builder = builder.with_projection(mask).with_batch_size(ROWS);
    let mut clock = Clock::default();
    let mut row = 0;
    for batch in builder.build()? {
        let batch = batch.map_err(|why| Error::new(why).at(format!("after row {row}")))?;
        let seconds = seconds(batch.column(0), columns.time_factor)?;
        let times = seconds.as_primitive::<Float64Type>();
        for (place, time) in times.values().iter().enumerate() {
            row += 1;
            if times.is_valid(place) {
                clock.see(row, *time)?;
            }
        }
        going.check()?;
    }
    Ok(log)
}
