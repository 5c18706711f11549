//! One program of all test files: they share what they link, and both cores.

mod fuzz;
mod golden;
mod mimic;
mod parameters;
mod reports;
mod support;
mod trees;
