//! D, h and c in one function.

use super::Quantity;
use super::function::Definition;

pub(super) const FUNCTION: Definition = Definition {
    name: "manipulator_equation",
    summary: "D(q), h(q, q̇) and c(q), with shared work.",
    results: &[Quantity::Inertia, Quantity::Coriolis, Quantity::Gravity],
    structure: Some("ManipulatorEquation"),
    by_default: true,
};
