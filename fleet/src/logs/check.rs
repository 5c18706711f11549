//! What is wrong with a file: which row, and why.

use std::fmt;
use std::path::{Path, PathBuf};

use datafusion::arrow::array::{Array, AsArray};
use datafusion::arrow::datatypes::Float64Type;

use super::block::{ROWS, open, projection, seconds};
use super::is_mcap;
use super::mapping::{Columns, Layout, Source};
use crate::error::Error;

/// A file that cannot be used.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Bad {
    /// Its path.
    pub file: PathBuf,
    /// Row, from 1, or message, if it is one's fault.
    pub row: Option<u64>,
    /// What is wrong.
    pub reason: String,
}

impl Bad {
    /// Returns what is wrong with a file as a whole.
    pub fn whole(file: &Path, why: impl fmt::Display) -> Bad {
        Bad {
            file: file.to_owned(),
            row: None,
            reason: why.to_string(),
        }
    }

    /// Returns what is wrong with a row.
    pub fn row(file: &Path, row: u64, reason: impl fmt::Display) -> Bad {
        Bad {
            row: Some(row),
            ..Bad::whole(file, reason)
        }
    }
}

impl fmt::Display for Bad {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: ", self.file.display())?;
        match self.row {
            Some(row) => write!(f, "row {row}: {}", self.reason),
            None => f.write_str(&self.reason),
        }
    }
}

/// A log that was looked at.
#[derive(Clone, Debug, PartialEq)]
pub struct Log {
    /// The file that it came as, which reports name.
    pub name: PathBuf,
    /// The file to read: another one if it was converted.
    pub path: PathBuf,
    /// Number of rows.
    pub rows: u64,
    /// Where the quantities are in it.
    pub layout: Layout,
    /// Columns and units of the file to read.
    pub columns: Columns,
    /// Bytes of the largest row group: what a reader holds of it.
    pub group: u64,
}

impl Log {
    /// Returns true if it has to be converted before a query can read it: recordings of ROS 2,
    /// whose layout has nothing, logs without rates, and lists in other units.
    pub fn converts(&self) -> bool {
        let sources = self.layout.iter().enumerate();
        let mut needs = sources.map(|(quantity, source)| match source {
            None => true,
            Some(Source::List(_)) => !self.columns.is_plain(quantity),
            Some(Source::Columns(_)) => false,
        });
        needs.any(|needs| needs)
    }
}

/// Times of a log, which have to increase.
#[derive(Clone, Copy, Debug, Default)]
pub struct Clock {
    last: Option<f64>,
}

impl Clock {
    /// Sees the time of the next row; says what is wrong with it.
    pub fn see(&mut self, time: f64) -> Option<String> {
        if !time.is_finite() {
            return Some(format!("the time is {time}"));
        }
        let last = self.last.replace(time)?;
        if time == last {
            return Some(format!("the time {time} s is that of the row before"));
        }
        (time < last).then(|| format!("time goes back from {last} s to {time} s"))
    }
}

/// Looks at a file: its end, its columns, and every time.
///
/// # Errors
/// What is wrong with it.
pub fn inspect(path: &Path, columns: &Columns, goes_on: &dyn Fn() -> bool) -> Result<Log, Bad> {
    let mut log = Log {
        name: path.to_owned(),
        path: path.to_owned(),
        rows: 0,
        layout: [const { None }; 4],
        columns: columns.clone(),
        group: 0,
    };
    if is_mcap(path) {
        std::fs::File::open(path).map_err(|why| Bad::whole(path, why))?;
        return Ok(log);
    }
    let whole = |why: Error| Bad::whole(path, why);
    let builder = open(path).map_err(whole)?;
    log.layout = columns.layout(builder.schema()).map_err(whole)?;
    let metadata = builder.metadata().clone();
    let groups = metadata.row_groups().iter();
    let sizes = groups.map(|group| group.compressed_size().max(0) as u64);
    log.group = sizes.max().unwrap_or(0);
    log.rows = metadata.file_metadata().num_rows().max(0) as u64;
    if log.rows == 0 {
        return Err(Bad::whole(path, "it has no rows"));
    }
    let mask = projection(&builder, &[&columns.time]);
    let reader = builder.with_projection(mask).with_batch_size(ROWS).build();
    let mut clock = Clock::default();
    let mut row = 0;
    for batch in reader.map_err(|why| Bad::whole(path, why))? {
        let batch = batch.map_err(|why| Bad::whole(path, format!("after row {row}: {why}")))?;
        let times = seconds(batch.column(0), columns.time_factor).map_err(whole)?;
        let times = times.as_primitive::<Float64Type>();
        for (place, time) in times.values().iter().enumerate() {
            row += 1;
            if times.is_valid(place)
                && let Some(reason) = clock.see(*time)
            {
                return Err(Bad::row(path, row, reason));
            }
        }
        if !goes_on() {
            break;
        }
    }
    Ok(log)
}
