//! Robot files.
