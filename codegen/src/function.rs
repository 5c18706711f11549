//! The functions that can be generated: the model's registry of outputs.

pub use dalembert_model::outputs::{
    Argument, BundleError, Columns, ErrorScale, Function, Quantity, RuntimeParameter, Sizes,
};
