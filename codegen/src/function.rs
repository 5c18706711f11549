//! The functions that can be generated: the model's table of outputs.

pub use dalembert_model::outputs::{
    Argument, Columns, Function, Quantity, RuntimeParameter, Sizes,
};
pub(crate) use dalembert_model::outputs::{BundleError, ErrorScale};
