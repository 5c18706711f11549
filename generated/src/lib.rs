//! Flat, verified dynamics of six robots, in f64 and f32.
//!
//! Each module was generated from the robot file beside it in
//! `robots/`; its documentation has the DH table, the operation counts and how it was
//! checked. `dalembert renew --check` generates every file again and compares.
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
pub mod panda;
#[path = "../robots/panda_f32.rs"]
pub mod panda_f32;
#[path = "../robots/planar2r.rs"]
pub mod planar2r;
#[path = "../robots/planar2r_f32.rs"]
pub mod planar2r_f32;
#[path = "../robots/planar3r.rs"]
pub mod planar3r;
#[path = "../robots/planar3r_f32.rs"]
pub mod planar3r_f32;
#[path = "../robots/puma560.rs"]
pub mod puma560;
#[path = "../robots/puma560_f32.rs"]
pub mod puma560_f32;
#[path = "../robots/stanford.rs"]
pub mod stanford;
#[path = "../robots/stanford_f32.rs"]
pub mod stanford_f32;
#[path = "../robots/ur10.rs"]
pub mod ur10;
#[path = "../robots/ur10_f32.rs"]
pub mod ur10_f32;
