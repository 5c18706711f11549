//! One program of all test files: they share what they link, and both cores.

mod fuzz;
mod golden;
mod mimic;
mod mjcf;
mod mjcf_refusals;
mod parameters;
mod refusals;
mod support;
