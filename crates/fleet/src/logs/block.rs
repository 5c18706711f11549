//! States of a log in the order of its rows, in SI units.

use std::fs::File;
use std::path::Path;
use std::sync::Arc;

use datafusion::arrow::array::{Array, ArrayRef, AsArray, RecordBatch};
use datafusion::arrow::compute::cast;
use datafusion::arrow::datatypes::{DataType, Float64Type, TimeUnit};
use parquet::arrow::ProjectionMask;
use parquet::arrow::arrow_reader::{
    ParquetRecordBatchReader, ParquetRecordBatchReaderBuilder as Builder,
};

use super::format::foreign;
use super::mapping::{Columns, Layout, QUANTITIES, Source};
use crate::arguments::list;
use crate::error::Error;

pub(crate) const ROWS: usize = 8192;

/// Some rows of a log; those with a null are left out.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Block {
    /// Row of each state in its file, from 1.
    pub rows: Vec<u64>,
    /// Times, s.
    pub time: Vec<f64>,
    /// q, q̇, q̈ and τ, each column by column; empty where the log has none.
    pub quantities: [Vec<f64>; 4],
}

impl Block {
    pub fn len(&self) -> usize {
        self.time.len()
    }

    pub fn is_empty(&self) -> bool {
        self.time.is_empty()
    }

    pub fn has(&self, quantity: usize) -> bool {
        !self.quantities[quantity].is_empty()
    }

    pub fn column(&self, quantity: usize, joint: usize) -> &[f64] {
        let count = self.len();
        &self.quantities[quantity][joint * count..(joint + 1) * count]
    }

    /// Checks that all values are finite; the error names the row of the first that is not.
    pub fn check(&self) -> Result<(), Error> {
        let first = |column: &[f64]| column.iter().position(|x| !x.is_finite());
        let mut defects = Vec::new();
        if let Some(place) = first(&self.time) {
            defects.push((place, format!("the time is {}", self.time[place])));
        }
        for (name, values) in QUANTITIES.iter().zip(&self.quantities) {
            for (i, column) in values.chunks_exact(self.len().max(1)).enumerate() {
                if let Some(place) = first(column) {
                    let (joint, value) = (i + 1, column[place]);
                    defects.push((place, format!("the {name} of joint {joint} is {value}")));
                }
            }
        }
        // The first one of those in the same row.
        match defects.into_iter().min_by_key(|(place, _)| *place) {
            Some((place, what)) => Err(Error::new(what).at_row(self.rows[place])),
            None => Ok(()),
        }
    }
}

/// Reads blocks of a Parquet file.
pub struct Blocks<'a> {
    reader: ParquetRecordBatchReader,
    columns: &'a Columns,
    layout: Layout,
    row: u64,
}

pub(crate) fn open(path: &Path) -> Result<Builder<File>, Error> {
    match Builder::try_new(File::open(path)?) {
        Ok(builder) => Ok(builder),
        Err(why) => match foreign(path, false)? {
            Some(foreign) => Err(foreign),
            None => Err(Error::new(why).at("it is cut off or damaged")),
        },
    }
}

pub(crate) fn projection(builder: &Builder<File>, names: &[&str]) -> ProjectionMask {
    let fields = builder.schema().fields().iter().enumerate();
    let wanted = fields.filter(|(_, field)| names.contains(&field.name().as_str()));
    ProjectionMask::roots(builder.parquet_schema(), wanted.map(|(place, _)| place))
}

impl<'a> Blocks<'a> {
    pub fn open(path: &Path, columns: &'a Columns) -> Result<Blocks<'a>, Error> {
        let builder = open(path)?;
        let layout = columns.layout(builder.schema())?;
        let mut names = vec![columns.time.as_str()];
        for source in layout.iter().flatten() {
            names.extend(source.columns().iter().map(String::as_str));
        }
        let mask = projection(&builder, &names);
        let builder = builder.with_projection(mask).with_batch_size(ROWS);
        Ok(Blocks {
            reader: builder.build()?,
            columns,
            layout,
            row: 0,
        })
    }

    fn block(&mut self, batch: &RecordBatch) -> Result<Block, Error> {
        let named = |name: &String| {
            let column = batch.column_by_name(name).cloned();
            column.ok_or_else(|| Error::new(format!("there is no column `{name}`")))
        };
        let mut valid = vec![true; batch.num_rows()];
        let time = seconds(&named(&self.columns.time)?, self.columns.time_factor)?;
        without_nulls(&time, 1, &mut valid);
        // For each joint an array, how many entries of it a row has, and which is the joint's.
        let mut columns: [Vec<(ArrayRef, usize, usize)>; 4] = Default::default();
        for (source, columns) in self.layout.iter().zip(&mut columns) {
            match source {
                None => {}
                Some(Source::Columns(names)) => {
                    for name in names {
                        let array = cast(&named(name)?, &DataType::Float64)?;
                        without_nulls(&array, 1, &mut valid);
                        columns.push((array, 1, 0));
                    }
                }
                Some(Source::List(name) | Source::Ragged(name)) => {
                    let n = self.columns.joints;
                    let array = named(name)?;
                    // A row of another length becomes a null.
                    let lists = cast(&array, &list(n))?;
                    let is_other = |row: &usize| lists.is_null(*row) && array.is_valid(*row);
                    if let Some(row) = (0..lists.len()).find(is_other) {
                        let count = length(&array, row);
                        let why = format!("column `{name}` has {count} numbers; expected {n}");
                        return Err(Error::new(why).at_row(self.row + 1 + row as u64));
                    }
                    without_nulls(&lists, 1, &mut valid);
                    let values = lists.as_fixed_size_list().values();
                    without_nulls(values, n, &mut valid);
                    columns.extend((0..n).map(|i| (values.clone(), n, i)));
                }
            }
        }
        let places: Vec<usize> = (0..valid.len()).filter(|place| valid[*place]).collect();
        let rows = places.iter().map(|place| self.row + 1 + *place as u64);
        let mut block = Block {
            rows: rows.collect(),
            time: picked(&time, &places, 1, 0, 1.0).collect(),
            ..Block::default()
        };
        for (quantity, columns) in columns.iter().enumerate() {
            let factors = &self.columns.factors[quantity];
            for ((array, width, i), factor) in columns.iter().zip(factors) {
                let values = picked(array, &places, *width, *i, *factor);
                block.quantities[quantity].extend(values);
            }
        }
        self.row += batch.num_rows() as u64;
        Ok(block)
    }
}

impl Iterator for Blocks<'_> {
    type Item = Result<Block, Error>;

    fn next(&mut self) -> Option<Result<Block, Error>> {
        let after = self.row;
        let batch = self.reader.next()?;
        let batch = batch.map_err(|why| Error::new(why).at(format!("after row {after}")));
        Some(batch.and_then(|batch| self.block(&batch)))
    }
}

pub(crate) fn per(unit: TimeUnit) -> f64 {
    match unit {
        TimeUnit::Second => 1.0,
        TimeUnit::Millisecond => 1e-3,
        TimeUnit::Microsecond => 1e-6,
        TimeUnit::Nanosecond => 1e-9,
    }
}

pub(crate) fn seconds(array: &ArrayRef, factor: f64) -> Result<ArrayRef, Error> {
    let (array, factor) = match array.data_type() {
        DataType::Timestamp(unit, _) => (cast(array, &DataType::Int64)?, per(*unit)),
        _ => (array.clone(), factor),
    };
    // Whole numbers are cast as `as` casts them: to the nearest.
    let floats = cast(&array, &DataType::Float64)?;
    let doubles = floats.as_primitive::<Float64Type>();
    Ok(Arc::new(doubles.unary::<_, Float64Type>(|x| x * factor)))
}

fn length(array: &ArrayRef, row: usize) -> usize {
    match (array.as_list_opt::<i32>(), array.as_list_opt::<i64>()) {
        (Some(lists), _) => lists.value(row).len(),
        (_, Some(lists)) => lists.value(row).len(),
        (None, None) => 0,
    }
}

fn without_nulls(array: &ArrayRef, width: usize, valid: &mut [bool]) {
    if let Some(nulls) = array.nulls().filter(|nulls| nulls.null_count() > 0) {
        for (place, valid) in valid.iter_mut().enumerate() {
            *valid &= (0..width).all(|k| nulls.is_valid(place * width + k));
        }
    }
}

fn picked<'a>(
    array: &'a ArrayRef,
    places: &'a [usize],
    width: usize,
    i: usize,
    factor: f64,
) -> impl Iterator<Item = f64> + 'a {
    let values = array.as_primitive::<Float64Type>().values();
    let value = move |place: &usize| values[place * width + i] * factor;
    places.iter().map(value)
}
