//! Verified, flat robot dynamics generated for one arm.
//!
//! ```
//! dalembert::dynamics! {
//!     /// Two links in a vertical plane.
//!     pub mod planar = r#"
//!         name = "planar"
//!         convention = "standard"
//!         gravity = [0, -9.81, 0]
//!         [[joint]]
//!         name = "shoulder"
//!         kind = "revolute"
//!         a = 1
//!         mass = 1
//!         com = [-0.5, 0, 0]
//!         inertia = [0, "1/12", "1/12", 0, 0, 0]
//!         [[joint]]
//!         name = "elbow"
//!         kind = "revolute"
//!         a = 1
//!         mass = 1
//!         com = [-0.5, 0, 0]
//!         inertia = [0, "1/12", "1/12", 0, 0, 0]
//!     "#;
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
#![cfg_attr(docsrs, feature(doc_cfg), doc(auto_cfg))]

#[cfg(feature = "model")]
pub use dalembert_model::{equations, number, reference, robot, scalar};

#[cfg(all(feature = "model", feature = "std"))]
pub use dalembert_model::read;

#[cfg(feature = "batch")]
pub use dalembert_batch as batch;

#[cfg(feature = "nalgebra")]
pub mod matrices;

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
/// The module is `pub`, `pub(crate)` or private as it says, has the documentation and attributes
/// that stand above it, and continues the documentation with the DH table, the operation counts and
/// the proof. Functions take arrays by reference and return arrays.
///
/// # The generated file
///
/// `robots/arm.rs` beside `robots/arm.toml`, called after the module, is taken as it stands if its
/// first lines say that it was generated from this robot file with what the clauses ask, and its text
/// is as it was written; more outputs than these may be in it. `dalembert generate` writes it, and
/// `dalembert renew` makes it new from its own first lines.
///
/// Otherwise the feature `search` of this crate, which is on by default, generates while compiling. Without
/// it there is one error that says what has changed, and the command that helps: a crate then
/// compiles in seconds.
///
/// # The robot
///
/// A robot file by its path, relative to `CARGO_MANIFEST_DIR` or, where there is none, to the
/// folder of the file with the macro; editing it expands the macro again. With the feature `search`
/// a plan that `dalembert generate --save-plan` puts beside it is replayed, and there may be the
/// text of a robot file, several lines of TOML in a raw string:
///
/// ```
/// dalembert::dynamics! {
///     mod gantry = r#"
///         name = "gantry"
///         convention = "standard"             # or "modified" (Craig)
///         gravity = [0, 0, -9.81]             # m/s², in base axes
///         [[joint]]
///         name = "lift"                       # optional
///         kind = "prismatic"                  # or "revolute"
///         alpha = "-pi/2"                     # DH; a is 0 if left out
///         offset = 0.1                        # added to q
///         theta = "90deg"                     # `d` of a revolute joint
///         mass = 4.5                          # kg
///         com = [0, 0.01, 0]                  # m, in the link frame
///         inertia = [0.1, 0.1, 0.05, 0, 0, 0] # xx yy zz xy yz xz about the com, kg·m²
///         viscous = 0.5                       # optional
///         armature = 0.2
///         coulomb = 3
///         coulomb_width = 0.01
///         limits = { position = [-0.5, 0.5], velocity = 1 }
///     "#;
///     outputs: gravity;
/// }
/// assert_eq!(gantry::gravity(&[0.0]), [4.5 * 9.81]);
/// ```
///
/// Numbers are exact: `0.3` is 3/10, `"1/3"` a third, `"pi/2"` and `"90deg"` are a right angle.
///
/// An oddity of a robot, such as an inertia that no body has or lengths that look
/// like millimetres, is a warning, in macro, build script and command. Silence it
/// by its name, which its help says: `allow = ["impossible_inertia"]` in the robot file.
///
/// # Clauses
///
/// - `outputs: …;` of the names that the guide lists, such as `inverse_dynamics`. The default is what
///   the robot file names, or the seven that a controller calls: every function costs
///   compile time. `servo = inverse_dynamics + jacobian` among
///   them is one function of that name ([below](#several-at-once)).
/// - `scalar: f64;` or `f32`. With `f64, f32` there are two modules, `NAME` and
///   `NAME_f32`. The default is `f64`.
/// - `formulation: auto;` tries all of `newton_euler`, `dalembert` and
///   `lagrange_euler` and keeps the cheapest; naming one tries that only.
/// - `effort: quick;` or `thorough`, which takes minutes and finds a few operations less.
/// - `prefer: operations;` takes the cheapest code even where its rounding error
///   is more than four times the textbook form's, which `accuracy`, the default,
///   does not. It says nothing about code that a plan keeps.
/// - `fma: on;` makes one operation of a product and the sum that alone reads it:
///   `t1.mul_add(t2, t3)`, rounded once. It needs `std`, and a build for a processor
///   that has it: `-C target-cpu=native`, or `-C target-feature=+fma` on x86-64; aarch64
///   always does. Any other calls a function of C for each, slower by far than the
///   two operations are. With `off`, the default, every operation is rounded.
/// - `sincos: auto;` takes polynomials for sines and cosines where a scene's tolerance admits them,
///   else calls libm angle by angle, as `libm` always does. `together` computes those of all angles
///   together, within 0.90 ulp, in vectors up to 8192 rad (f32: 100) and by libm beyond: in a third
///   to a fifth of libm's time, where code is optimised. `polynomial` takes polynomials over the
///   joints' limits, or the scene's box; outside they are wrong. For a joint without limits, whole
///   turns are taken off first: they hold to ±1e6 rad, in f32 to ±1e3.
/// - `sincos_error: 1e-9;` is the largest error of each sine and cosine, for `sincos: polynomial;`
///   alone. The default is `1e-6`, or the least error of two digits that the scalar can have; in a
///   scene with a tolerance that decides, and no error is given.
/// - `batch: on;` adds `NAME_columns` to each function, for any number of states
///   ([below](#many-states)).
/// - `parameters: payload;`, `gravity`, `bodies`, `armature` or `viscous` make arguments of what are
///   constants of the robot otherwise ([below](#parameters-at-run-time)); `bodies: 2, 5;` takes the
///   bodies of these links alone, and `keep_zeros: on;` keeps numbers of bodies that are zero.
/// - `scene: NAME;` generates only what that scene of the robot file needs. Then `outputs`
///   and `scalar` may be left out: they are the scene's.
/// - `crate = path;` is where this crate is, if not at `::dalembert`.
///
/// # Several at once
///
/// For several quantities at one state, ask for one function of them, a
/// bundle, which shares all work that they have in common:
///
/// ```
/// dalembert::dynamics! {
///     mod arm = "generated/robots/planar2r.toml";
///     outputs: servo = inverse_dynamics + jacobian + forward_kinematics;
/// }
/// let (q, qd, qdd) = ([0.3, -0.5], [0.7, 0.2], [0.0, 0.0]);
/// let arm::Servo { tau, jacobian, pose } = arm::servo(&q, &qd, &qdd);
/// // dx/dq1 = -y: what turns about the base.
/// assert!((jacobian[0][0] + pose[1][3]).abs() < 1e-15 && tau[0] > 0.0);
/// ```
///
/// Its struct is called after it and has a field a quantity, in the order in which
/// the parts stand; its arguments are all that a part reads. No quantity can be in
/// it twice. `manipulator_equation` is a bundle that is always there.
///
/// # Parameters at run time
///
/// The load of the hand changes with the tool, and the direction of gravity with the
/// base. Functions take both as arguments, after the state:
///
/// ```
/// dalembert::dynamics! {
///     mod arm = "generated/robots/planar2r.toml";
///     outputs: gravity, inertia;
///     parameters: payload, gravity;
/// }
/// use arm::{Gravity, Load, Payload};
/// // Mass, centre of mass in the last link's frame, inertia about it as in a robot
/// // file: once for each tool.
/// let tool = Payload::new(0.5, [0.0, 0.0, 0.1], [1e-3, 1e-3, 1e-3, 0.0, 0.0, 0.0]);
/// let tool = tool.expect("a body has these numbers");
/// let load: Load = arm::load(&tool);
/// # assert_eq!(tool[0], 0.5);
/// let q = [0.3, -0.5];
/// let upright = arm::gravity(&q, &Gravity([0.0, -9.81, 0.0]), &load);
/// let on_its_side = arm::gravity(&q, &Gravity([9.81, 0.0, 0.0]), &load);
/// // Joints that turn about z feel nothing of gravity along it; D never does.
/// assert_eq!(arm::gravity(&q, &Gravity([0.0, 0.0, -9.81]), &load), [0.0, 0.0]);
/// assert!(upright[0] > 0.0 && on_its_side[0] > 0.0);
/// assert!(arm::inertia(&q, &load)[0][0] > arm::inertia(&q, &arm::load(&Payload::NONE))[0][0]);
/// ```
///
/// No body has a negative mass, or a moment of inertia above the sum of the other two:
///
/// ```
/// # dalembert::dynamics! {
/// #     mod arm = "generated/robots/planar2r.toml";
/// #     outputs: gravity;
/// #     parameters: payload;
/// # }
/// assert_eq!(arm::Payload::new(-1.0, [0.0; 3], [0.0; 6]), None);
/// assert_eq!(arm::Payload::new(1.0, [0.0; 3], [1.0, 1.0, 3.0, 0.0, 0.0, 0.0]), None);
/// assert_eq!(arm::Payload::new(0.0, [0.0; 3], [0.0; 6]), Some(arm::Payload::NONE));
/// // A rod, and a plate whose moments are rounded.
/// assert!(arm::Payload::new(1.0, [0.0; 3], [0.0, 1.0, 1.0, 0.0, 0.0, 0.0]).is_some());
/// assert!(arm::Payload::new(1.0, [0.0; 3], [0.1, 0.2, 0.3000001, 0.0, 0.0, 0.0]).is_some());
/// ```
///
/// A payload is no load, and neither is gravity:
///
/// ```compile_fail
/// # dalembert::dynamics! {
/// #     mod arm = "generated/robots/planar2r.toml";
/// #     outputs: gravity;
/// #     parameters: payload, gravity;
/// # }
/// let tool = arm::Payload::NONE;
/// arm::gravity(&[0.3, -0.5], &arm::Gravity([0.0, -9.81, 0.0]), &tool);
/// ```
///
/// `load` gives the regrouped parameters that the payload changes, which stand where constants
/// stood, so that a payload costs a call little. Every function is proved with the payload's ten
/// numbers as variables. Kinematics take none; what depends on more of a payload than joints feel
/// (`potential_energy`, `reaction_wrenches`, `dalembert_terms`) is refused. A plan keeps their
/// programs beside those of the robot's own parameters.
///
/// `bodies` are the masses, centres of mass and inertias of the links, in the frames that the robot
/// file gives them in. `BODIES` are those of the file, and `with` puts another in a place from zero.
/// `armature` and `viscous` friction have an entry a row, and the constants `ARMATURE` and `VISCOUS`:
///
/// ```
/// dalembert::dynamics! {
///     mod arm = "generated/robots/planar2r.toml";
///     outputs: inverse_dynamics;
///     parameters: bodies, viscous;
/// }
/// use arm::{BODIES, Body, VISCOUS};
/// // Mass in kg, centre of mass in m, inertia about it in kg·m².
/// let heavy = Body::new(3.0, [-0.4, 0.0, 0.0], [0.0, 0.25, 0.25, 0.0, 0.0, 0.0]);
/// let bodies = BODIES.with(1, heavy.expect("a body has these numbers"));
/// let (own, other) = (arm::load(&BODIES, &VISCOUS), arm::load(&bodies, &[0.1, 0.2]));
/// let (q, qd, qdd) = ([0.3, -0.5], [0.7, 0.2], [0.0, 0.0]);
/// let [before, after] = [&own, &other].map(|load| arm::inverse_dynamics(&q, &qd, &qdd, load));
/// assert!(after[0] > 2.0 * before[0]);
/// ```
///
/// # Many states
///
/// Many states at once are computed in the vectors that the processor has:
///
#[cfg_attr(feature = "batch", doc = "```")]
#[cfg_attr(not(feature = "batch"), doc = "```ignore (needs the feature batch)")]
/// dalembert::dynamics! {
///     mod arm = "generated/robots/planar2r.toml";
///     outputs: gravity;
///     batch: on;
/// }
/// // A slice for each joint.
/// let (shoulder, elbow) = (vec![0.3; 1000], vec![-0.5; 1000]);
/// let (mut first, mut second) = (vec![0.0; 1000], vec![0.0; 1000]);
/// arm::gravity_columns(&[&shoulder, &elbow], &mut [&mut first, &mut second])?;
/// assert_eq!([first[999], second[999]], arm::gravity(&[0.3, -0.5]));
/// # Ok::<(), dalembert::batch::Unequal>(())
/// ```
///
/// Batches need the feature `batch` of this crate; with `std` too they take the
/// vectors that the processor has, whatever the build is for. `Load` and `Gravity` are slices with one
/// a state, or with one for all. Every state has
/// the results that it has alone, to the last bit. With `sincos: together` and `polynomial`
/// sines are computed in vectors; libm's are called for one state after the other.
///
/// # Scenes
///
/// A scene says what a robot is used for, so that nothing else is computed. It is a
/// table `[scene.NAME]` of the robot file, and a clause names it. All of its keys may be left out:
///
/// ```
/// dalembert::dynamics! {
///     /// An arm that picks, in a vertical plane.
///     mod arm = r#"
///         name = "arm"
///         convention = "standard"
///         gravity = [0, -9.81, 0]
///         [[joint]]
///         name = "shoulder"
///         kind = "revolute"
///         a = 0.5
///         mass = 2
///         com = [-0.25, 0, 0]
///         inertia = [0, 0.1, 0.1, 0, 0, 0]
///         limits = { position = [-2.2, 2.2], velocity = 3, acceleration = 20, torque = 60 }
///         [[joint]]
///         name = "elbow"
///         kind = "revolute"
///         a = 0.4
///         mass = 1
///         com = [-0.2, 0, 0]
///         inertia = [0, 0.1, 0.1, 0, 0, 0]
///         limits = { position = [-2.2, 2.2], velocity = 3, acceleration = 20, torque = 30 }
///         [[joint]]
///         name = "wrist"
///         kind = "revolute"
///         a = 0.1
///         mass = 0.2
///         com = [0, 0, 0]
///         inertia = [0, 0, 0, 0, 0, 0]
///         limits = { position = [-2.2, 2.2], velocity = 3, acceleration = 20, torque = 5 }
///         [scene.pick]
///         outputs = ["inverse_dynamics"]
///         ## Torques wanted, by number from 1 or by name: all that are not locked, if left out.
///         joints = [1, "elbow"]
///         ## Joints that stay where they are.
///         lock = { wrist = "pi/6" }
///         ## Instead of the robot's.
///         gravity = [0, -9.81, 0]
///         ## These terms and their argument are gone; or acceleration = "zero".
///         velocity = "zero"
///         ## What the last link carries, in its frame; a point without `inertia`.
///         payload = { mass = 0.5, com = [0, 0, 0.05], inertia = [0.01, 0.01, 0.01, 0, 0, 0] }
///         ## Where bounds hold: an entry a joint. Entries left out are the joints' limits.
///         box = { position = [[-1, 1], [0, 2], [0, 1]], acceleration = [5, 10, 10] }
///         ## Of the actuators' torque limits, or `range`: of a torque that the model attains
///         ## in the box, at or just below its largest. A value, or a list of them, one a joint.
///         tolerance = { value = 1e-2, relative_to = "actuator" }
///         ## Without it, the cheapest that the tolerance admits.
///         scalar = "f64"
///     "#;
///     scene: pick;
/// }
/// let (q, qdd) = ([0.3, 0.5, 0.0], [1.0, 2.0, 0.0]);
/// let tau: [f64; 2] = arm::inverse_dynamics(&q, &qdd);
/// ```
///
/// Arguments keep an entry for every joint, results are over `joints`. With a tolerance each
/// function's documentation has its bounds: how far it is from the full model at most, in the box.
/// Where functions hold in a box only, be it for a tolerance or for polynomials, the module has
/// that as `BOX` and a function `in_box`, which takes what they take and says whether it is inside.
/// A joint without limits has one turn in it, -π to π. A box that a joint never reaches is an
/// error, one that goes beyond its limits is taken as it stands. To find what a tolerance admits
/// takes longer than other clauses: keep it in a plan with the command (`generate --scene NAME
/// --save-plan`).
#[cfg(feature = "macros")]
pub use dalembert_macros::dynamics;

/// For generated code only.
#[doc(hidden)]
pub mod __private {
    #[cfg(feature = "sines")]
    pub use dalembert_sines;
    pub use libm;
}
