//! Generated dynamics at any number of states, with the vectors that the processor has.
//!
//! A generator that is asked for `batch: on` prints a function `NAME_columns` beside each of its
//! own, which ends here. States stand in columns: a slice for each entry of an argument or number
//! of the result. Arguments with a type, such as a load, stand in [`Rows`]: one a state, or in all.
//!
//! ```
//! use dalembert_batch::{Argument, Floats, Vector};
//!
//! // A generator prints this; here the torque that holds a pendulum of 1 kg and 1 m.
//! pub struct GravityBatch;
//! impl dalembert_batch::Function<1, 1, 1> for GravityBatch {
//!     type Scalar = f64;
//!     fn angles<V: Floats<f64>>(q: &[V; 1]) -> [V; 1] {
//!         [q[0]]
//!     }
//!     fn vectors<V: Vector<f64>>(_: &[V; 1], _sin: &[V; 1], cos: &[V; 1]) -> [V; 1] {
//!         [cos[0] * 9.81]
//!     }
//! }
//!
//! let q = [0.0, 0.5, 1.0];
//! let mut tau = [0.0; 3];
//! let columns = dalembert_batch::columns::<GravityBatch, 1, 1, 1, 0>;
//! columns(&[Argument::Columns(&[&q])], &mut [&mut tau])?;
//! assert_eq!(tau[1], 9.81 * 0.5f64.cos());
//!
//! let error = columns(&[Argument::Columns(&[&q[..2]])], &mut [&mut tau]);
//! let said = error.unwrap_err().to_string();
//! assert_eq!(said, "entry 1 of argument 1 has 2 states, the results have 3");
//! # Ok::<(), dalembert_batch::Unequal>(())
//! ```
//!
//! A state's results are those that it has alone, bit for bit: each lane does the same operations in
//! the same order, and none is contracted to a fused one. Only the bits of a NaN are the processor's
//! choice. A function that is [`FUSED`](Function::FUSED) says otherwise: its sines have fused
//! products, too, and its results the same bits in all vectors, but not those of a single call.
//!
//! With the feature `std` the processor is asked what it has, once a call: a plain release build
//! computes in vectors of AVX-512 or AVX2 where they are, by the crate
//! [`pulp`](https://docs.rs/pulp). Without it, code is compiled for the target as it is, and the
//! crate needs `core` alone. The feature `rayon` has the same on all cores, in `parallel`.
//!
//! - `function`: what a generator says of a function; which vectors there are of a float
//! - `argument`: columns and rows of numbers
//! - `unequal`: slices of different lengths
//! - `vector`: floats side by side, `x86` and `portable`: those of a processor
//! - `slices`: from columns to vectors and back
//! - `dispatch`: as wide as the processor's vectors are
//! - `parallel`: on all cores
#![no_std]
#![forbid(unsafe_code)]
#![cfg_attr(docsrs, feature(doc_cfg), doc(auto_cfg))]
#![warn(missing_docs)]

mod argument;
mod function;
mod unequal;
mod vector;

mod portable;
#[cfg(all(feature = "std", target_arch = "x86_64"))]
mod x86;

mod slices;

mod dispatch;

#[cfg(feature = "rayon")]
pub mod parallel;

pub use argument::{Argument, Rows};
#[doc(no_inline)]
pub use dalembert_sines::text::Floats;
pub use dispatch::{Vectors, columns, columns_in};
pub use function::{Float, Function};
pub use unequal::{Slice, Unequal};
pub use vector::Vector;
#[doc(hidden)]
pub use vector::{sqrt, sqrtf};
