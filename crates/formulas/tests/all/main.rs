//! One program of all test files.

mod couplings;
#[path = "../../../../codegen/tests/support/draw.rs"]
#[allow(dead_code)]
mod draw;
mod latex;
mod python;
mod sizes;
mod values;
