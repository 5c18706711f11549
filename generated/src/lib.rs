//! Flat, verified dynamics of six robots, in f64 and f32.
//!
//! Each module was generated from the robot file beside its source in
//! `robots/`; its header has the DH table, the operation counts and how it was
//! checked. A test of the workspace regenerates every file and compares.
//!
//! ```
//! use dalembert_generated::puma560;
//!
//! let q = [0.1, -0.6, 0.8, 0.0, 0.3, 0.0];
//! let holding = puma560::gravity(&q);
//! let rest = [0.0; puma560::N];
//! let tau = puma560::inverse_dynamics(&q, &rest, &rest);
//! assert!((tau[1] - holding[1]).abs() < 1e-12);
//! ```
#![no_std]
#![forbid(unsafe_code)]

#[path = "../robots/panda.rs"]
mod panda_source;
#[path = "../robots/planar2r.rs"]
mod planar2r_source;
#[path = "../robots/planar3r.rs"]
mod planar3r_source;
#[path = "../robots/puma560.rs"]
mod puma560_source;
#[path = "../robots/stanford.rs"]
mod stanford_source;
#[path = "../robots/ur10.rs"]
mod ur10_source;

pub use panda_source::{panda, panda_f32};
pub use planar2r_source::{planar2r, planar2r_f32};
pub use planar3r_source::{planar3r, planar3r_f32};
pub use puma560_source::{puma560, puma560_f32};
pub use stanford_source::{stanford, stanford_f32};
pub use ur10_source::{ur10, ur10_f32};
