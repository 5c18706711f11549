//! Checks that trust neither the search nor the printer.
//!
//! - [`accuracy`]: which programs round well enough, for choices between them
//! - [`rounding`]: what rounding costs a program, estimated; `lanes`: at states side by side
//! - [`exact`]: the program equals Lagrange–Euler as written, modulo primes
//! - [`challenge`]: which primes and points, drawn from what is to be proved
//! - [`parameters`]: base parameters give every torque, modulo primes
//! - [`reach`]: which constants follow a number of the robot file
//! - [`singular`]: whether D has an inverse, and which joint it lacks one for
//! - [`condition`]: how close D is to singular at a state
//! - [`miss`], [`degree`], [`ratio`], `size`: how likely that check is to miss a difference
//! - [`reference`](mod@reference): true values, to 60 digits
//! - [`running`]: how far code may be off at a state, from its own numbers
//! - [`floating`]: what rounding costs: against the runtime and given states

pub(crate) mod accuracy;
pub(crate) mod challenge;
pub(crate) mod condition;
pub(crate) mod degree;
pub(crate) mod exact;
pub(crate) mod floating;
mod lanes;
pub(crate) mod miss;
pub(crate) mod parameters;
pub(crate) mod ratio;
pub(crate) mod reach;
pub(crate) mod reference;
pub(crate) mod rounding;
pub(crate) mod running;
pub(crate) mod singular;
mod size;
