//! The tests of the second checker, as one program.

mod attacks;
mod forgeries;
mod identity;
mod intervals;
mod lagrange;
mod lines;
mod numbers;
mod read;
mod refusals;
mod support;
