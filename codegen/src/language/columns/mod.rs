//! Functions of any number of states in columns: entry i of all states stands in one slice.
//!
//! - `rust`: `NAME_columns`, by the crate `dalembert-batch`
//! - `c`: `NAME_batch` in C, a kernel in CUDA

mod c;
mod rust;

pub(crate) use c::batch;
pub(crate) use rust::columns;
