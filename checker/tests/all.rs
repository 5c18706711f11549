//! The tests of the second checker, as one program.

mod attacks;
mod certificates;
mod exact;
mod forgeries;
mod golden;
mod intervals;
mod lines;
mod mutations;
mod refusals;
mod support;
