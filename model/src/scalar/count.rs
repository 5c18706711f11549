//! Operation counts.
