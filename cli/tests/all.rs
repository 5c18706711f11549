//! One program of all test files: they share what they link, and both cores.

mod attacks;
mod attacks_on_the_proof;
mod bad_input;
mod certificates;
mod command;
mod explain;
mod extremes;
mod forged;
mod guide;
mod import;
mod json;
mod new;
mod outputs;
mod show;
mod sines;
mod support;
mod terminal;
mod tolerance;
mod tradeoff;
