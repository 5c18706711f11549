//! Verified, flat robot dynamics generated for one arm.
//!
//! ```
//! dalembert::dynamics! {
//!     /// Two links in a vertical plane.
//!     pub mod planar {
//!         convention: standard;
//!         gravity: [0, -9.81, 0];
//!         joint { name: shoulder, kind: revolute, a: 1, mass: 1, com: [-0.5, 0, 0], inertia: [0, 1/12, 1/12, 0, 0, 0] }
//!         joint { name: elbow, kind: revolute, a: 1, mass: 1, com: [-0.5, 0, 0], inertia: [0, 1/12, 1/12, 0, 0, 0] }
//!     }
//!     outputs: inverse_dynamics, gravity;
//!     scalar: f64;
//! }
//!
//! // The torques that hold it still, stretched out.
//! let load = planar::gravity(&[0.0, 0.0]);
//! assert!((load[0] - 2.0 * 9.81).abs() < 1e-12 && (load[1] - 0.5 * 9.81).abs() < 1e-12);
//! assert_eq!(load, planar::inverse_dynamics(&[0.0; 2], &[0.0; 2], &[0.0; 2]));
//! ```
//!
//! `dynamics!` is the macro; [`robot`], [`equations`] and [`mod@reference`]
//! are the description of a robot and its dynamics without generated code.
//! Without the default features the crate is `no_std`: `macros` alone gives
//! the macro, `model` the description, for which it needs an allocator.
#![no_std]
#![forbid(unsafe_code)]

#[cfg(feature = "model")]
pub use dalembert_model::{equations, number, reference, robot, scalar};

#[cfg(feature = "std")]
pub use dalembert_model::read;

/// Generates verified dynamics of one robot as a module of flat functions.
///
/// ```
/// # mod example {
/// dalembert::dynamics! {
///     /// Unimation PUMA 560.
///     pub mod puma560 = "generated/robots/puma560.toml";
///     outputs: inverse_dynamics, gravity;
///     scalar: f64, f32;
/// }
/// # }
/// # use example::*;
/// let tau: [f64; 6] = puma560::inverse_dynamics(&[0.1; 6], &[0.2; 6], &[0.3; 6]);
/// let hold: [f32; 6] = puma560_f32::gravity(&[0.1; 6]);
/// # assert!(tau[1] > 30.0 && hold[1] > 30.0);
/// ```
///
/// The module is `pub`, `pub(crate)` or private as it says, has the
/// documentation and attributes that stand above it, and continues the
/// documentation with the DH table, the operation counts and the proof.
/// Functions take arrays by reference and return arrays.
///
/// # The robot
///
/// A robot file by its path, relative to `CARGO_MANIFEST_DIR`; editing it
/// expands the macro again. Or the robot itself, in braces:
///
/// ```
/// dalembert::dynamics! {
///     mod gantry {
///         convention: standard;                   // or modified (Craig)
///         gravity: [0, 0, -9.81];                 // m/s², in base axes
///         joint {
///             name: lift,                         // optional
///             kind: prismatic,                    // or revolute
///             alpha: -pi/2, a: 0, offset: 0.1,    // DH; the offset is added to q
///             theta: 90deg,                       // `d` of a revolute joint
///             mass: 4.5,                          // kg
///             com: [0, 0.01, 0],                  // m, in the link frame
///             inertia: [0.1, 0.1, 0.05, 0, 0, 0], // xx yy zz xy yz xz about the com, kg·m²
///             viscous: 0.5, armature: 0.2,        // optional
///             limits: { position: [-0.5, 0.5], velocity: 1 },
///         }
///     }
///     outputs: gravity;
/// }
/// assert_eq!(gantry::gravity(&[0.0]), [4.5 * 9.81]);
/// ```
///
/// Keys and meanings are those of the robot file. Numbers are exact, as they
/// are written: `0.3` is 3/10, `1/3` a third, `pi/2` a right angle, and so is
/// `90deg`.
///
/// # Clauses
///
/// - `outputs: …;` of `inverse_dynamics`, `gravity`, `inertia`, `coriolis`,
///   `manipulator_equation`, `dynamic_coefficients`. There is no default:
///   every function costs compile time.
/// - `scalar: f64;` or `f32`. With `f64, f32` there are two modules, `NAME` and
///   `NAME_f32`. The default is `f64`.
/// - `formulation: auto;` tries all of `newton_euler`, `dalembert` and
///   `lagrange_euler` and keeps the cheapest; naming one tries that only.
/// - `effort: quick;` or `thorough`, which takes minutes and finds a few
///   operations less.
/// - `sincos: auto;` takes polynomials for sines where a scene's tolerance
///   admits them; `polynomial` takes them always, over the joints' limits,
///   with `sincos_error: 1e-9;` or 1e-6; `libm` never.
/// - `crate = path;` is where this crate is, if not at `::dalembert`.
#[cfg(feature = "macros")]
pub use dalembert_macros::dynamics;

/// For generated code only.
#[doc(hidden)]
pub mod __private {
    /// What bodies call, by one name whichever library it is from.
    pub mod math {
        pub use libm::{cos, cosf, sin, sincos, sincosf, sinf};
    }
}
