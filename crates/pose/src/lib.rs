//! The pose of a base that floats, beside the functions that dalembert generates for such a
//! robot: gravity in the base's axes, a pose after a step, the step between two poses, and
//! velocities and accelerations in the axes of other libraries.
//!
//! ```
//! use dalembert_pose::{Axes, Pose, Quaternion};
//!
//! // A base that pitches by 0.2 rad, as MuJoCo gives its orientation.
//! let orientation = Quaternion::from_wxyz([0.995004165278026, 0.0, 0.0998334166468282, 0.0]);
//! let g = orientation.rotate_back([0.0, 0.0, -9.81]);
//! assert!((g[0] - 1.94895_f64).abs() < 1e-5 && g[2] < -9.6);
//!
//! let pose = Pose { position: [0.0, 0.0, 0.32], orientation };
//! let twist = [0.5, 0.0, 0.0, 0.0, 0.3, 0.0];
//! let next = pose.integrate(twist.map(|rate| 0.001 * rate));
//! assert!((pose.difference(&next)[0] - 0.0005).abs() < 1e-16);
//! let in_world = pose.velocity_in(Axes::Mixed, twist);
//! assert!(in_world[2] < -0.09);
//! ```
//!
//! An array is not a quaternion, since nothing would say where w stands:
//!
//! ```compile_fail,E0308
//! let orientation = [0.995004165278026, 0.0, 0.0998334166468282, 0.0];
//! let pose = dalembert_pose::Pose { position: [0.0, 0.0, 0.32], orientation };
//! ```
//!
//! The crate takes `core` alone. [`C_HEADER`] is the same in C99, and returns the same bits.

#![no_std]
#![forbid(unsafe_code)]

mod pose;

pub use pose::{Axes, Pose, Quaternion, Real};

/// The text of this crate for C99 and CUDA, a header: `dalembert pose -o pose.h` writes it.
pub const C_HEADER: &str = include_str!("pose.h");

/// The text of this crate as a module of Rust that depends on nothing.
pub const RUST_MODULE: &str = include_str!("pose.rs");
