//! Errors, each in a sentence.

use std::fmt;

use datafusion::error::DataFusionError;

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Error(String);

impl Error {
    pub fn new(text: impl fmt::Display) -> Error {
        Error(text.to_string().trim_end().to_owned())
    }

    /// Puts the place where it happened before the message.
    #[must_use]
    pub fn at(self, place: impl fmt::Display) -> Error {
        Error(format!("{place}: {}", self.0))
    }

    pub(crate) fn at_row(self, row: u64) -> Error {
        self.at(format_args!("row {row}"))
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for Error {}

macro_rules! from {
    ($($other:ty),*) => {$(
        impl From<$other> for Error {
            fn from(other: $other) -> Error {
                Error::new(other)
            }
        }
    )*};
}
from!(
    dalembert_fit::Error,
    datafusion::arrow::error::ArrowError,
    parquet::errors::ParquetError,
    std::io::Error
);

impl From<DataFusionError> for Error {
    fn from(other: DataFusionError) -> Error {
        // Where in the engine it was found is of no use to whoever asked.
        Error::new(other.strip_backtrace())
    }
}

impl From<Error> for DataFusionError {
    fn from(error: Error) -> DataFusionError {
        DataFusionError::External(Box::new(error))
    }
}
