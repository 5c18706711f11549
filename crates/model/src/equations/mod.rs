//! The dynamics formulas, each written once, generic over the [`Scalar`].
//!
//! | module | formulas |
//! |---|---|
//! | [`arm`](Arm) | the DH matrices ⁱ⁻¹A_i, eq. 2.1, both conventions |
//! | [`lagrange_euler`] | U_ij, U_ijk, J_i, D_ik, h_ikm, c_i, eqs. 2.2–2.15 |
//! | [`newton_euler`] | the recursions, Table 1 (base axes) and Table 2 (link axes) |
//! | [`dalembert`] | generalized D'Alembert, D^rot, D^tran, h^rot, h^tran, eqs. 4.1–4.5 |
//! | [`energy`] | T, U, D q̇, ∂T/∂q and C of every formulation |
//! | [`derivatives`] | ∂τ/∂q, ∂τ/∂q̇ and second ones of every formulation, by duals |
//! | `floating` | a base that floats, as six joints |
//! | [`forward`] | q̈, D⁻¹ and slopes of q̈ of every formulation |
//! | [`following`] | joints that follow others, by the chain rule |
//! | [`friction`] | what joints take of torque while they move |
//! | [`factor`] | D = U diag(d) Uᵀ, solved and inverted |
//! | [`articulated`] | q̈ by articulated bodies |
//! | [`frames`] | frames that are fixed to links, in which axes they are asked for |
//! | [`kinematics`] | poses, Jacobians and their rates, wrenches at the joints |
//! | `joint_axes` | columns of a Jacobian in the axes of the joints |
//! | [`link_axes`] | the hand's velocity in the axes of links |
//! | [`operational`] | Λ, J̄, bias force and null space at the hand |
//! | [`contact`] | Jᵀw of a wrench at the hand, and the wrench of torques |
//! | `centroidal` | the centre of mass, momentum about it, and a base that nothing holds |
//! | [`Formulation`] | every output from every formulation, by name |
//! | [`Arm::from_robot`], [`pose_of`], [`exact_pose`], [`Arm::fold_base`] | exact parameters in any scalar; what a fixed base cannot feel |
//! | [`regressor`] | Y in τ = Y π of every formulation, the parameters that its columns are of |
//! | [`load`] | what a payload adds to regrouped parameters |
//! | [`screws`] | twists and wrenches |
//! | [`matrix`] | the vector and matrix products all of them are made of |
//!
//! τ_i = Σ_k D_ik q̈_k + h_i + c_i + (b_i + F_i r_i) q̇_i in every form: armature is
//! part of D_ii, friction of τ alone.
//!
//! Slices of joint values are indexed from the base and as long as [`Arm::links`]; a shorter one
//! panics. [`Reference`](crate::reference::Reference) checks lengths.
//!
//! [`Scalar`]: crate::scalar::Scalar

mod arm;
pub mod articulated;
mod centroidal;
pub mod chain;
pub mod contact;
pub mod dalembert;
pub mod derivatives;
pub mod energy;
pub mod factor;
mod floating;
pub mod following;
mod formulation;
pub mod forward;
pub mod frames;
pub mod friction;
mod from_robot;
mod joint_axes;
pub mod kinematics;
pub mod lagrange_euler;
pub mod link_axes;
pub mod load;
pub mod matrix;
pub mod newton_euler;
pub mod operational;
pub mod regressor;
pub mod screws;
#[cfg(test)]
mod trees;

pub use crate::scalar::SinCosPair;
pub use arm::{Arm, At, DhVariables, JointPosition, Link};
pub use floating::{BASE_COORDINATES, base_position};
pub use formulation::Formulation;
pub use from_robot::{exact_pose, pose_of};
