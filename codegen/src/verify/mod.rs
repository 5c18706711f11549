//! Checks that trust neither the search nor the printer.
//!
//! - [`accuracy`]: what rounding costs a program, for choices between them
//! - [`exact`]: the program equals Lagrange–Euler as written, in a prime field
//! - [`degree`]: how likely that check is to miss a difference
//! - [`text`]: the printed text is the program, every literal rounded once
//! - [`interpret`]: the printed text run bit for bit
//! - [`columns`]: the same at many states at once
//! - [`states`]: seeded states inside a robot's limits
//! - [`floating`]: what rounding costs: against the runtime and given states

pub mod accuracy;
pub mod columns;
pub mod degree;
pub mod exact;
pub mod floating;
pub mod interpret;
pub mod states;
pub mod text;
