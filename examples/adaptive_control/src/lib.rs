//! An arm that learns what it carries while it moves: the adaptive controller of
//! Slotine and Li (1987).
//!
//! With the reference velocity v = q̇_d − Λ(q − q_d), a = v̇ and s = q̇ − v, the law is
//!
//! ```text
//! τ = Y π̂ − K s,    dπ̂/dt = −Γ Yᵀ s,    Y π = D a + C v + c + b∘v
//! ```
//!
//! Y is `passivity_regressor(q, q̇, v, a)`. The arm moves by D q̈ + C q̇ + c + b∘q̇ = τ, so
//! D ṡ + C s + b∘s = Y(π̂ − π) − K s, and the energy of the error,
//! V = ½ sᵀD s + ½ (π̂ − π)ᵀ Γ⁻¹ (π̂ − π), falls:
//!
//! ```text
//! dV/dt = −sᵀ(K + b) s + ½ sᵀ(Ḋ − 2C) s + (π̂ − π)ᵀ(Yᵀ s + Γ⁻¹ dπ̂/dt) = −sᵀ(K + b) s
//! ```
//!
//! since Ḋ − 2C is skew-symmetric for the C of the Christoffel symbols. `regressor(q, v, a)` cannot
//! replace Y: it has C(q, v) v in the place of C(q, q̇) v.
//!
//! - [`control`]: the law
//! - [`run`]: the target motion, and the controller on the arm with its payload
#![forbid(unsafe_code)]

pub mod control;
pub mod run;

dalembert::dynamics! {
    /// The arm as the controller knows it: empty.
    pub mod arm = "robots/arm.toml";
    outputs: passivity_regressor;
    scalar: f64;
}

dalembert::dynamics! {
    /// The simulated arm with its payload, which the controller does not know.
    pub mod loaded = "robots/arm.toml";
    scene: loaded;
    outputs: forward_dynamics, inertia, passivity, regressor, passivity_regressor;
    scalar: f64;
}

/// A value for each joint.
pub type Joints = [f64; arm::N];

/// A value for each base parameter.
pub type Parameters = [f64; arm::PASSIVITY_PARAMETERS.len()];

/// Positions and velocities of the arm.
pub type State = example_shared::State<{ arm::N }>;
