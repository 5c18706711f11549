//! D, h and c in one function: a bundle that is always there.

use super::function::Definition;
use super::{Function, Quantity};

pub(super) const FUNCTION: Definition = Definition {
    name: "manipulator_equation",
    summary: "D(q), h(q, q̇) and c(q), with shared work.",
    results: &[Quantity::Inertia, Quantity::Coriolis, Quantity::Gravity],
    structure: Some("ManipulatorEquation"),
    parts: &[Function::Inertia, Function::Coriolis, Function::Gravity],
    ..Definition::PLAIN
};
