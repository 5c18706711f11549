//! One program of all test files: they share what they link, and both cores.

mod fuzz;
mod golden;
mod mjcf;
mod refusals;
mod support;
