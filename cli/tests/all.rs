//! One program of all test files: they share what they link, and both cores.

mod accuracy_campaign;
mod attacks;
mod attacks_on_the_proof;
mod bad_input;
mod certificates;
mod command;
mod couplings;
mod explain;
mod explained;
mod extremes;
mod extremes_growth;
mod extremes_not_finite;
mod extremes_of_chains;
mod extremes_of_robots;
mod extremes_support;
mod forged;
mod guide;
mod identities_in_time;
mod import;
mod json;
mod new;
mod outputs;
mod outputs_compared;
#[path = "../../codegen/tests/support/mod.rs"]
mod robots;
mod show;
mod sines;
mod states;
mod support;
mod terminal;
mod tolerance;
mod tradeoff;
