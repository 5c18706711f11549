//! The tests of the second checker, as one program.

mod attacks;
mod certificates;
mod forgeries;
mod golden;
mod identity;
mod intervals;
mod lagrange;
mod lines;
mod mutations;
mod numbers;
mod read;
mod refusals;
mod support;
