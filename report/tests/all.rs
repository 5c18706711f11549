//! One program of all test files: they share what they link, and both cores.

mod accuracy_campaign;
mod couplings;
mod explain;
mod extremes;
mod extremes_growth;
mod extremes_not_finite;
mod extremes_of_robots;
mod extremes_support;
mod identities_in_time;
mod outputs;
mod states;
#[path = "../../codegen/tests/support/mod.rs"]
mod support;
