//! Any arm's dynamics as machine code in memory, without a compiler on the machine.
//!
//! [`Arm::load`] reads a robot file or a URDF, searches for the cheapest functions, proves
//! each equal to Lagrange–Euler, as the command does, and compiles them by Cranelift:
//!
//! ```no_run
//! use dalembert_jit::{Arm, Load, Scalar};
//!
//! let arm = Arm::load("panda.urdf", &Load::default())?;
//! let dynamics = arm.function("inverse_dynamics", Scalar::F64).ok_or("not generated")?;
//! let (q, qd, qdd) = ([0.1; 7], [0.2; 7], [0.3; 7]);
//! let mut tau = [0.0; 7];
//! dynamics.native().call(&[&q, &qd, &qdd], &mut tau)?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # The same bits
//!
//! The code does what the generated Rust does, operation by operation: results are equal
//! to the last bit, for one state ([`Native::call`]), and for many in vectors of two
//! doubles or four floats ([`Native::call_rows`]). Sines are those of `dalembert-sines`,
//! whose text is run on values of the code that is made, and so compiled in. Only the bits
//! of a NaN are left open, as they are in Rust.
//!
//! Before a function is returned, it is compared with the exact interpreter of its
//! program at [`STATES`] states drawn from a hash, infinities and NaN among them; one
//! bit that differs is an error.
//!
//! # Parts
//!
//! - `arm`, `request`: a robot and what is wanted of it; `make`: what is generated for it;
//!   `cache`: what is kept
//! - `compile`: functions around a program; `program`: its instructions, `sines`: those of
//!   its sines; `emit`: instructions on one number or a vector
//! - `native`: the code in memory and its calls: all that is `unsafe`; `rows`: where
//!   numbers of many states lie; `check`: the comparison
#![deny(unsafe_code)]
#![warn(missing_docs, unreachable_pub)]

mod arm;
mod cache;
mod check;
mod compile;
mod emit;
mod error;
mod make;
mod native;
mod program;
mod request;
mod rows;
mod sines;

pub use arm::{Arm, Function};
pub use check::STATES;
pub use compile::Signature;
pub use error::Error;
pub use native::{MOST_ARGUMENTS, Native, Real};
pub use request::{Cache, Load};
pub use rows::Place;

#[doc(inline)]
pub use dalembert_codegen::ScalarType as Scalar;
#[doc(inline)]
pub use dalembert_codegen::workspace::{Observer, Progress, Quantity};
#[doc(inline)]
pub use dalembert_codegen::{Asked, Function as Output, OPTIONS, Watch};
