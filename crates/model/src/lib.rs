//! Robots with exact parameters, and their dynamics written once over any scalar.
//!
//! - [`number`]: exact rationals, angles and the constants made of them
//! - [`robot`]: the description: DH rows, masses, centres of mass, inertias, limits
//! - [`placed`]: joints that are placed by frames, and the DH rows that they have
//! - [`scene`]: what a robot is used for: locked joints, payload, box, tolerance
//! - [`read`]: robot files and what is wrong with them (feature `std`)
//! - [`scalar`]: the arithmetic that every formula is generic over
//! - [`diagnostic`]: mistakes, warnings and notes, as users see them
//! - [`equations`]: Lagrange–Euler, Newton–Euler, generalized D'Alembert
//! - [`mod@reference`]: the generic runtime in f64 and f32, nalgebra at its surface (feature
//!   `reference`)
//! - [`outputs`]: what can be asked about an arm, a file each
#![no_std]
#![forbid(unsafe_code)]
#![cfg_attr(docsrs, feature(doc_cfg), doc(auto_cfg))]
#![warn(missing_docs, clippy::missing_errors_doc)]

extern crate alloc;
#[cfg(feature = "std")]
extern crate std;

pub mod diagnostic;
pub mod equations;
pub mod number;
pub mod outputs;
pub mod placed;
#[cfg(feature = "std")]
pub mod read;
#[cfg(feature = "reference")]
pub mod reference;
pub mod robot;
pub mod scalar;
pub mod scene;
