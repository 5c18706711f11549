//! Checks that trust neither the search nor the printer.
//!
//! - [`accuracy`]: which programs round well enough, for choices between them
//! - [`rounding`]: what rounding costs a program, estimated
//! - [`exact`]: the program equals Lagrange–Euler as written, modulo 2⁶¹ − 45
//! - `points`: points that are drawn from the statement; `degree`: degrees, from above
//! - [`parameters`]: base parameters give every torque, modulo 2⁶¹ − 45
//! - [`singular`]: whether D has an inverse, and which joint it lacks one for
//! - [`condition`]: how close D is to singular at a state
//! - [`truth`]: true values, to 60 digits
//! - [`measure`]: the generic runtime, and how many times more than others a quantity may err

pub(crate) mod accuracy;
pub(crate) mod condition;
mod degree;
pub(crate) mod exact;
pub(crate) mod measure;
pub(crate) mod parameters;
mod points;
pub(crate) mod rounding;
pub(crate) mod singular;
pub(crate) mod truth;
