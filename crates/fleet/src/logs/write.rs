//! Parquet files of numbers.

use std::fs::File;
use std::path::Path;
use std::sync::Arc;

use datafusion::arrow::array::{ArrayRef, Float64Array, RecordBatch, StringArray};
use datafusion::arrow::datatypes::{DataType, Field, Schema};
use parquet::arrow::ArrowWriter;
use parquet::basic::Compression;
use parquet::file::properties::WriterProperties;

use crate::error::Error;

/// Rows that are compressed together, and that a reader holds: 25 MB of a six-joint arm.
const GROUP: usize = 1 << 17;

pub struct Table {
    writer: ArrowWriter<File>,
    schema: Arc<Schema>,
    has_file: bool,
}

/// Returns the columns of a log as this program writes it.
pub fn canonical_names(joints: usize) -> Vec<String> {
    let quantities = ["q", "qd", "qdd", "tau"].iter();
    let names = quantities.flat_map(|name| (1..=joints).map(move |i| format!("{name}{i}")));
    std::iter::once("time".to_owned()).chain(names).collect()
}

impl Table {
    /// Creates a table of columns of numbers; with `file`, the first is one of names.
    pub fn create(path: &Path, names: &[String], file: bool) -> Result<Table, Error> {
        Table::compressed(path, names, file, Compression::SNAPPY)
    }

    pub fn compressed(
        path: &Path,
        names: &[String],
        file: bool,
        compression: Compression,
    ) -> Result<Table, Error> {
        let first = file.then(|| Field::new("file", DataType::Utf8, false));
        let number = |name| Field::new(name, DataType::Float64, false);
        let fields: Vec<Field> = first.into_iter().chain(names.iter().map(number)).collect();
        let schema = Arc::new(Schema::new(fields));
        // Numbers of a log do not repeat, names of files do.
        let properties = WriterProperties::builder()
            .set_dictionary_enabled(false)
            .set_column_dictionary_enabled("file".into(), true)
            .set_max_row_group_row_count(Some(GROUP))
            .set_compression(compression)
            .build();
        let out = File::create(path)?;
        let writer = ArrowWriter::try_new(out, schema.clone(), Some(properties))?;
        Ok(Table {
            writer,
            schema,
            has_file: file,
        })
    }

    /// Writes rows: their times, and quantities, each column by column.
    pub fn write<'a>(
        &mut self,
        file: &str,
        time: &'a [f64],
        quantities: impl IntoIterator<Item = &'a [f64]>,
    ) -> Result<(), Error> {
        let rows = time.len();
        let mut arrays: Vec<ArrayRef> = Vec::with_capacity(self.schema.fields().len());
        if self.has_file {
            let names = std::iter::repeat_n(file, rows);
            arrays.push(Arc::new(StringArray::from_iter_values(names)));
        }
        let quantities = quantities.into_iter();
        let columns = quantities.flat_map(|of| of.chunks_exact(rows.max(1)));
        for column in std::iter::once(time).chain(columns) {
            arrays.push(Arc::new(Float64Array::from(column.to_vec())));
        }
        let batch = RecordBatch::try_new(self.schema.clone(), arrays)?;
        Ok(self.writer.write(&batch)?)
    }

    /// Writes what stands at the end of the file.
    pub fn close(self) -> Result<(), Error> {
        let mut file = self.writer.into_inner()?;
        Ok(std::io::Write::flush(&mut file)?)
    }
}
