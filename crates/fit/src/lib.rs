//! Parameters of a robot arm from its logs: least squares of τ = Y π over the base
//! parameters, in states that merge, and a robot file that says what was found.
//!
//! In the order in which they use each other:
//! - [`error`]: what is wrong with a robot, a state or a log
//! - [`random`]: seeded random numbers, the same on every machine
//! - [`triangle`]: a QR factorization that grows row by row (TSQR)
//! - `dense`: triangular systems and singular values
//! - [`limits`]: how far and how fast joints move
//! - [`model`]: the columns of an arm's regressor, and the regressor at a state
//! - [`accumulator`]: the triangles of all joints: states in, merged, as bytes
//! - [`reference`](mod@reference): the motion that excitation is measured against
//! - [`unexcited`]: what data do not tell; [`fit`](mod@fit): parameters with standard errors
//! - [`consistent`](mod@consistent): the nearest bodies that exist
//! - [`robot_file`]: the robot that has them, and its file
//! - [`cross_validation`](mod@cross_validation): residuals on logs that a fit
//!   has not seen, and logs that disagree
//! - [`suspect`](mod@suspect): mistakes in a log that its residuals give away
//! - [`differentiate`](mod@differentiate): velocities and accelerations of encoders
//! - [`fourier`], [`excite`](mod@excite): a trajectory that tells the parameters apart
//! - [`simulate`]: seeded logs of an arm whose parameters are known
//! - [`watch`]: residuals that change
#![forbid(unsafe_code)]

pub mod accumulator;
pub mod consistent;
pub mod cross_validation;
mod dense;
pub mod differentiate;
pub mod error;
pub mod excite;
pub mod fit;
pub mod fourier;
pub mod limits;
pub mod model;
pub mod random;
pub mod reference;
pub mod robot_file;
pub mod simulate;
pub mod suspect;
pub mod triangle;
pub mod unexcited;
pub mod watch;

pub use accumulator::Accumulator;
pub use consistent::{Bodies, consistent};
pub use cross_validation::{Disagreement, FileResidual, cross_validation, disagreeing};
pub use differentiate::{Differentiator, differentiate};
pub use error::Error;
pub use excite::{Effort, excite};
pub use fit::{Fit, fit};
pub use fourier::Trajectory;
pub use limits::Limits;
pub use model::{Column, Model};
pub use robot_file::identified;
pub use suspect::{Change, Suspicion, suspect};
pub use watch::Watch;
