//! What can be asked about an arm: an output is one file.
//!
//! - `registry`: the macro that makes [`Function`] and [`Quantity`] of the list below
//! - `function`: what a generated function is: its name, arguments and results
//! - `bundle`: several of them as one
//! - `at`: one of them at a frame of the robot
//! - `quantity`: what a result is: its [`Shape`], names, unit and error scale
//! - `shape`: the axes of a result, and what their lengths follow from
//! - `select`: entries over some rows of an arm from those over others
//! - `argument`: what functions read
//! - `runtime`: parameters of the arm that are arguments on request
//! - `formula`: what a quantity's file says, and what its formulas are given
//! - the others: an output each
//!
//! Readers of robot files and macros, scenes, traces, proofs, printing, reading
//! back and the checks in floating point all ask here; none of them knows an
//! output by name. To add one: write its file, and add its module and its line
//! to the lists below.

mod argument;
mod at;
mod bundle;
mod formula;
mod function;
mod quantity;
#[macro_use]
mod registry;
mod runtime;
mod select;
mod shape;

mod consistent_inverse;
mod contact_wrench;
mod coriolis;
mod coriolis_matrix;
mod dalembert_terms;
mod dynamic_coefficients;
mod forward_dynamics;
mod forward_dynamics_derivatives;
mod forward_dynamics_second_derivatives;
mod forward_dynamics_with_wrench;
mod forward_kinematics;
mod full_regressor;
mod gravity;
mod inertia;
mod inertia_inverse;
mod inverse_dynamics;
mod inverse_dynamics_derivatives;
mod inverse_dynamics_second_derivatives;
mod inverse_dynamics_with_wrench;
mod jacobian;
mod jacobian_rate;
mod kinetic_energy;
mod link_poses;
mod load;
mod manipulator_equation;
mod momentum;
mod momentum_observer;
mod null_space_projector;
mod operational_bias;
mod operational_inertia;
mod operational_inertia_inverse;
mod passivity;
mod passivity_regressor;
mod potential_energy;
mod reaction_wrenches;
mod regressor;

pub use argument::Argument;
pub use at::{FunctionAt, QuantityAt};
pub use bundle::{Bundle, BundleError};
pub use formula::{Motion, Regrouped, Shared, Written};
pub use function::Columns;
pub use quantity::{ErrorScale, Index};
pub use runtime::{PayloadDependence, RuntimeParameter};
pub use shape::{Axis, Shape, Sizes};

registry! {
    /// τ(q, q̇, q̈): torques and forces, viscous damping included.
    inverse_dynamics: InverseDynamics { Torque }
    /// c(q): the gravity load.
    gravity: Gravity { Gravity }
    /// D(q): the inertia matrix.
    inertia: Inertia { Inertia }
    /// h(q, q̇): the Coriolis and centripetal load.
    coriolis: Coriolis { Coriolis }
    /// D, h and c in one function that shares their work.
    manipulator_equation: ManipulatorEquation {}
    /// D, every h_ikm and c in one function.
    dynamic_coefficients: DynamicCoefficients { Christoffel }
    /// T(q, q̇): the kinetic energy.
    kinetic_energy: KineticEnergy { KineticEnergy }
    /// U(q): the potential energy.
    potential_energy: PotentialEnergy { PotentialEnergy }
    /// D q̇ and Cᵀq̇.
    momentum: Momentum { Momentum, MomentumSlope }
    /// C(q, q̇): the Coriolis matrix.
    coriolis_matrix: CoriolisMatrix { CoriolisMatrix }
    /// Contributions of the links' rotation and translation to D and h, and c.
    dalembert_terms: DalembertTerms {
        RotationInertia, TranslationInertia, RotationCoriolis, TranslationCoriolis
    }
    /// The pose of the hand.
    forward_kinematics: ForwardKinematics { Pose }
    /// The pose of every link.
    link_poses: LinkPoses { LinkPoses }
    /// J(q): the Jacobian of the hand.
    jacobian: Jacobian { Jacobian }
    /// J̇ q̇: the acceleration of the hand that velocities alone give.
    jacobian_rate: JacobianRate { JacobianRate }
    /// Force and moment at every joint.
    reaction_wrenches: ReactionWrenches { Wrench }
    /// ∂τ/∂q, ∂τ/∂q̇ and D.
    inverse_dynamics_derivatives: InverseDynamicsDerivatives {
        TorqueByPosition, TorqueByVelocity
    }
    /// D a + C v + c + b∘v.
    passivity: Passivity { Passivity }
    /// q̈(q, q̇, τ): forward dynamics.
    forward_dynamics: ForwardDynamics { Acceleration }
    /// D⁻¹(q): the inverse of the inertia matrix.
    inertia_inverse: InertiaInverse { InertiaInverse }
    /// ∂q̈/∂q, ∂q̈/∂q̇ and ∂q̈/∂τ.
    forward_dynamics_derivatives: ForwardDynamicsDerivatives {
        AccelerationByPosition, AccelerationByVelocity, AccelerationByTorque
    }
    /// Y over the base parameters: τ = Y π.
    regressor: Regressor { BaseRegressor }
    /// Y over all inertial parameters of all links.
    full_regressor: FullRegressor { LinkRegressor }
    /// Y over the base parameters: D a + C v + c + b∘v = Y π.
    passivity_regressor: PassivityRegressor { PassivityRegressor }
    /// D q̇ and Cᵀq̇ − c − b∘q̇: what an observer of outside forces integrates.
    momentum_observer: MomentumObserver { MomentumDrift }
    /// τ(q, q̇, q̈) beside a wrench that acts on the hand.
    inverse_dynamics_with_wrench: InverseDynamicsWithWrench { ContactTorque }
    /// q̈(q, q̇, τ) under a wrench that acts on the hand.
    forward_dynamics_with_wrench: ForwardDynamicsWithWrench { ContactAcceleration }
    /// The wrench on the hand that joint torques say.
    contact_wrench: ContactWrench { ContactWrench }
    /// Λ⁻¹ = J D⁻¹ Jᵀ: the mobility of the hand.
    operational_inertia_inverse: OperationalInertiaInverse { OperationalInertiaInverse }
    /// Λ: the inertia of the hand.
    operational_inertia: OperationalInertia { OperationalInertia }
    /// J̄ = D⁻¹ Jᵀ Λ.
    consistent_inverse: ConsistentInverse { ConsistentInverse }
    /// μ = Λ (J D⁻¹ (h + c) − J̇ q̇).
    operational_bias: OperationalBias { OperationalBias }
    /// N = 1 − J̄ J.
    null_space_projector: NullSpaceProjector { NullSpace }
    /// Second derivatives of λᵀτ.
    inverse_dynamics_second_derivatives: InverseDynamicsSecondDerivatives {
        TorqueByPositions, TorqueByPositionAndVelocity, TorqueByVelocities,
        TorqueByAccelerationAndPosition
    }
    /// Second derivatives of λᵀq̈.
    forward_dynamics_second_derivatives: ForwardDynamicsSecondDerivatives {
        AccelerationByPositions, AccelerationByPositionAndVelocity, AccelerationByVelocities,
        AccelerationByTorqueAndPosition
    }

    ; beside them:

    /// The regrouped parameters of the arm with a payload.
    load: Load { Load }
}
