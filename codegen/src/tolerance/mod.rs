//! Under a tolerance: the cheapest program that it admits. README.md has the mathematics.
//!
//! - [`budget`]: a function, what its results may be off, and the cheapest variant; [`refusals`]: the
//!   reasons why there is none
//! - [`input_box`]: the states for which a bound holds; [`scale`]: what errors are relative to;
//!   [`sample`]: states of a box
//! - [`search`]: the search; `greedy`: values that leave one program; `corrections`: its constants,
//!   corrected for that; `reduce`: smaller models to start from
//! - `net`: an edited program at many samples; `samples`: positions and motions; `linear`: least squares
//! - [`sines`]: polynomials for sines, as exact as a tolerance needs
//! - `reference`: the engine's decision about a program; `claim`: the document by which the checker
//!   decides about its text; [`definite`]: whether D stays positive definite; `turning`: a bound of D
//!   from below
//! - [`variant`]: the outcome; [`attempt`]: states that try to refute it
//! - [`overflow`]: steps that may overflow
//! - `shape`: a plan's variant fits the scene; `work`: work counted, for who cannot wait
//!
//! Samples rank, and decide nothing.

pub(crate) mod attempt;
pub(crate) mod budget;
pub(crate) mod claim;
mod corrections;
pub(crate) mod definite;
mod greedy;
pub(crate) mod input_box;
mod linear;
mod net;
pub(crate) mod overflow;
mod reduce;
pub(crate) mod reference;
pub(crate) mod refusals;
pub(crate) mod sample;
mod samples;
pub(crate) mod scale;
pub(crate) mod search;
mod shape;
mod sines;
mod turning;
pub(crate) mod variant;
pub(crate) mod work;
