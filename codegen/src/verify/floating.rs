//! What rounding costs.
