//! All test files in one program: it is linked once, and its tests share the cores.

mod accuracy_campaign;
mod documents;
mod extremes_growth;
mod extremes_not_finite;
mod extremes_of_chains;
mod extremes_of_robots;
mod outputs_in_scenes;
#[path = "../../../codegen/tests/support/mod.rs"]
mod robots;
mod show;
mod steps;
