//! Numerical stability at the extremes: generated code and generic runtime
//! against a reference in 256 bits, where robots are not.
//!
//! - [`subject`]: what is tested: emitted code and runtime, f64 and f32
//! - [`scale`]: states of given magnitudes, and the torques to be met there
//! - [`deviation`]: errors in u, normwise and for each joint
//! - [`robots`], [`states`]: extremes made out of a robot
//! - [`category`]: the matrix of them, and what each is held to
//! - [`report`]: the matrix run on one robot
//! - [`singular`]: functions that divide, where D is nearest to singular
//!
//! The measured table of worst errors is in `README.md` of this folder.

pub mod category;
pub mod deviation;
pub mod report;
pub mod robots;
pub mod scale;
pub mod singular;
pub mod states;
pub mod subject;
