//! The tests of the second checker, as one program.

mod attacks;
mod certificates;
mod forgeries;
mod golden;
mod intervals;
mod mutations;
mod refusals;
mod support;
