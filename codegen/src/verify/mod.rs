//! Checks that trust neither the search nor the printer.

pub(crate) mod accuracy;
pub(crate) mod condition;
pub(crate) mod exact;
pub(crate) mod growth;
pub(crate) mod measure;
pub(crate) mod parameters;
mod points;
pub(crate) mod rounding;
pub(crate) mod singular;
pub(crate) mod truth;
