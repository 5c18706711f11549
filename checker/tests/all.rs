//! The tests of the second checker, as one program.

mod attacks;
mod certificates;
mod exact;
mod forgeries;
mod golden;
mod headers;
mod identity;
mod intervals;
mod lagrange;
mod lines;
mod mutations;
mod numbers;
mod placements;
mod read;
mod refusals;
mod support;
mod tried;
