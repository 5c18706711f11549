//! The functions that can be generated: the model's table of outputs.

pub(crate) use dalembert_model::outputs::ErrorScale;
pub use dalembert_model::outputs::{
    Argument, Function, Quantity, RegressorColumns, RuntimeParameter, Sizes,
};
