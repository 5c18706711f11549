//! Prime field.
