//! The outputs of an arm: each is a row of the list below, and a file has
//! the formulas of those that belong together.
//!
//! - `registry`: the macro that makes [`Function`] and [`Quantity`] of the list below
//! - `function`: what a generated function is: its name, arguments and results
//! - `bundle`: several of them as one
//! - `at`: one of them at a frame of the robot
//! - `quantity`: what a result is: its [`Shape`], names, unit and error scale
//! - `shape`: the axes of a result, and what their lengths follow from
//! - `argument`: what functions read: joint vectors, and on request parameters, as a payload's load
//! - `formula`: what is said of a quantity, and what its formulas are given
//! - the others: quantities that belong together
//!
//! Readers of robot files and macros, scenes, traces, proofs, printing, reading back and the checks
//! in floating point all ask here, and none of them names an output. The checker alone has a list and
//! equations besides, since it trusts nothing of this. `docs/architecture.md` says how to add one.

mod argument;
mod at;
mod bundle;
mod formula;
mod function;
mod quantity;
#[macro_use]
mod registry;
mod shape;

mod centroidal;
mod contact;
mod derivatives;
mod energies;
mod forward_dynamics;
mod kinematics;
mod operational;
mod regressors;
mod torques;

use alloc::vec::Vec;

use crate::scalar::Divide;
use formula::Formula;

pub use argument::{Argument, PayloadDependence, RuntimeParameter};
pub use at::QuantityAt;
pub use formula::{Motion, Regrouped, Written};
pub use function::{NamedFunction, RegressorColumns};
pub use quantity::{ErrorScale, Facts, Index};
pub use shape::{Axis, Shape, Sizes};

registry! {
    inverse_dynamics: InverseDynamics { torques: Torque }
        "Inverse dynamics: the joint torques (forces) τ = D q̈ + h + c + b∘q̇.", by_default: true;
    gravity: Gravity { torques: Gravity }
        "Gravity load c(q): the torques that hold the arm still.", by_default: true;
    inertia: Inertia { torques: Inertia }
        "Inertia matrix D(q), symmetric; armature is on its diagonal.", by_default: true;
    coriolis: Coriolis { torques: Coriolis }
        "Coriolis and centripetal load h(q, q̇), damping not included.", by_default: true;
    manipulator_equation: ManipulatorEquation {}
        "D(q), h(q, q̇) and c(q), with shared work.",
        results: &[Quantity::Inertia, Quantity::Coriolis, Quantity::Gravity],
        parts: &[Function::Inertia, Function::Coriolis, Function::Gravity],
        structure: Some("ManipulatorEquation");
    dynamic_coefficients: DynamicCoefficients { torques: Christoffel }
        "D(q), every Christoffel symbol h_ikm(q) and c(q), with shared work.",
        results: &[Quantity::Inertia, Quantity::Christoffel, Quantity::Gravity],
        structure: Some("DynamicCoefficients");
    kinetic_energy: KineticEnergy { energies: KineticEnergy }
        "Kinetic energy T = ½ q̇ᵀ D q̇ in joules, the rotors' part included.";
    potential_energy: PotentialEnergy { energies: PotentialEnergy }
        "Potential energy U = -Σ m g·r in joules, r from the base's origin.";
    momentum: Momentum { energies: Momentum, MomentumSlope }
        "Momentum p = D q̇ and its slope Cᵀq̇ = ∂T/∂q: ṗ = τ + Cᵀq̇ - c - b∘q̇.";
    coriolis_matrix: CoriolisMatrix { torques: CoriolisMatrix }
        "Coriolis matrix C(q, q̇) of the Christoffel symbols: C q̇ = h, and Ḋ - 2C is skew.";
    dalembert_terms: DalembertTerms {
        torques: RotationInertia, TranslationInertia, RotationCoriolis, TranslationCoriolis
    }
        "What rotation and translation of the links contribute: D^rot, D^tran, h^rot, h^tran, and c; armature in neither D.",
        results: &[
            Quantity::RotationInertia, Quantity::TranslationInertia, Quantity::RotationCoriolis,
            Quantity::TranslationCoriolis, Quantity::Gravity,
        ];
    forward_kinematics: ForwardKinematics { kinematics: Pose }
        "Forward kinematics: the pose [R | p] of the last frame in base axes, 3×4, lengths in metres.",
        by_default: true;
    link_poses: LinkPoses { kinematics: LinkPoses }
        "Poses [R | p] of every link's frame in base axes, n×3×4, lengths in metres.";
    jacobian: Jacobian { kinematics: Jacobian }
        "Jacobian J(q) of the last frame in base axes, 6×n: linear over angular velocity, at its origin.",
        by_default: true;
    jacobian_rate: JacobianRate { kinematics: JacobianRate }
        "J̇q̇, the acceleration of the last frame that its velocities alone give, linear over angular.";
    reaction_wrenches: ReactionWrenches { kinematics: Wrench }
        "Force and moment that link i-1 exerts on link i in base axes, gravity included, n×6: for bearings and links.";
    inverse_dynamics_derivatives: InverseDynamicsDerivatives {
        derivatives: TorqueByPosition, TorqueByVelocity
    }
        "Derivatives of the inverse dynamics: ∂τ/∂q, ∂τ/∂q̇ and ∂τ/∂q̈ = D.",
        results: &[Quantity::TorqueByPosition, Quantity::TorqueByVelocity, Quantity::Inertia];
    passivity: Passivity { torques: Passivity }
        "Passivity-based control: D a + C v + c + b∘v, with C of the Christoffel symbols.";
    forward_dynamics: ForwardDynamics { forward_dynamics: Acceleration }
        "Forward dynamics: the accelerations q̈ = D⁻¹ (τ - h - c - b∘q̇).", by_default: true;
    inertia_inverse: InertiaInverse { forward_dynamics: InertiaInverse }
        "Inverse D⁻¹(q) of the inertia matrix, symmetric.";
    forward_dynamics_derivatives: ForwardDynamicsDerivatives {
        derivatives: AccelerationByPosition, AccelerationByVelocity, AccelerationByTorque
    }
        "Derivatives of the forward dynamics: ∂q̈/∂q, ∂q̈/∂q̇ and ∂q̈/∂τ = D⁻¹.";
    regressor: Regressor { regressors: BaseRegressor }
        "Regressor Y(q, q̇, q̈) over the base parameters, n×k: the joint torques (forces) are τ = Y π.";
    full_regressor: FullRegressor { regressors: LinkRegressor }
        "Regressor Y(q, q̇, q̈) over all links' parameters, n×10n: the links' part of the joint torques is Y π. A link has m, m x, m y, m z, Ixx, Iyy, Izz, Ixy, Iyz, Ixz about the origin of its frame, as `link_poses` has it.";
    passivity_regressor: PassivityRegressor { regressors: PassivityRegressor }
        "Regressor Y(q, q̇, v, a) of passivity-based control over the base parameters, n×k: D a + C v + c + b∘v = Y π, with C of the Christoffel symbols.";
    momentum_observer: MomentumObserver { energies: MomentumDrift }
        "Momentum p = D q̇ and its drift β = Cᵀq̇ - c - b∘q̇: ṗ = τ + β but for outside forces.",
        results: &[Quantity::Momentum, Quantity::MomentumDrift],
        structure: Some("MomentumObserver");
    inverse_dynamics_with_wrench: InverseDynamicsWithWrench { contact: ContactTorque }
        "Inverse dynamics while a wrench w acts on the hand: τ = D q̈ + h + c + b∘q̇ - Jᵀw.";
    forward_dynamics_with_wrench: ForwardDynamicsWithWrench { contact: ContactAcceleration }
        "Forward dynamics while a wrench w acts on the hand: q̈ = D⁻¹ (τ + Jᵀw - h - c - b∘q̇).";
    contact_wrench: ContactWrench { contact: ContactWrench }
        "The wrench on the hand that the torques τ come from: ŵ = (J Jᵀ + λ² 1)⁻¹ J τ.";
    operational_inertia_inverse: OperationalInertiaInverse { operational: OperationalInertiaInverse }
        "Mobility of the hand, the inverse of its inertia: Λ⁻¹ = J D⁻¹ Jᵀ, symmetric.";
    operational_inertia: OperationalInertia { operational: OperationalInertia }
        "Inertia of the hand, damped where the arm is singular: Λ = (J D⁻¹ Jᵀ + λ² 1)⁻¹, symmetric.";
    consistent_inverse: ConsistentInverse { operational: ConsistentInverse }
        "Dynamically consistent inverse of the Jacobian: J̄ = D⁻¹ Jᵀ Λ, n×6.";
    operational_bias: OperationalBias { operational: OperationalBias }
        "Bias force of the hand: μ = Λ (J D⁻¹ (h + c) - J̇q̇), without friction.";
    null_space_projector: NullSpaceProjector { operational: NullSpace }
        "Null-space projector N = 1 - J̄ J of velocities; Nᵀ is that of torques.";
    centre_of_mass: CentreOfMass { centroidal: CentreOfMass }
        "Centre of mass of all links in base axes, from the base's origin, in metres.";
    centroidal_momentum_matrix: CentroidalMomentumMatrix { centroidal: CentroidalMomentumMatrix }
        "Momentum about the centre of mass is A q̇: A(q) in base axes, 6×n, linear over angular.";
    centroidal_bias: CentroidalBias { centroidal: CentroidalBias }
        "Ȧ q̇, the rate of the momentum about the centre of mass that velocities alone give, linear over angular.";
    joint_torques_free: JointTorquesFree { centroidal: FreeTorque, BaseAcceleration }
        "Torques that give the joints q̈ while nothing holds the base, and the base's accelerations then; those in q̈ are not read.",
        structure: Some("JointTorquesFree");
    inertia_blocks: InertiaBlocks { centroidal: BaseInertia, CouplingInertia, LimbInertia }
        "Inertia matrix D(q) of a robot whose base floats, without the zeros between its limbs: the base's six rows and columns, the coupling of base and joints, and one block a limb.",
        structure: Some("InertiaBlocks");
    contact_jacobians: ContactJacobians { contact: ContactJacobians }
        "Velocities of points in contact by each coordinate, 3k×n, in base axes: `contact_jacobians@left_foot,right_foot`.";
    contact_bias: ContactBias { contact: ContactBias }
        "J̇q̇ of points in contact, 3k: their accelerations in base axes that velocities alone give.";
    contact_forward_dynamics: ContactForwardDynamics { contact: HeldAcceleration, ContactForces }
        "Forward dynamics while forces f hold points where they are: D q̈ - Jᵀf = τ - h - c - b∘q̇ and J q̈ + λ² f = -J̇q̇.",
        structure: Some("ContactForwardDynamics");
    inverse_dynamics_second_derivatives: InverseDynamicsSecondDerivatives {
        derivatives: TorqueByPositions, TorqueByPositionAndVelocity, TorqueByVelocities,
        TorqueByAccelerationAndPosition
    }
        "Second derivatives of the inverse dynamics, of λᵀτ for a given λ.";
    forward_dynamics_second_derivatives: ForwardDynamicsSecondDerivatives {
        derivatives: AccelerationByPositions, AccelerationByPositionAndVelocity,
        AccelerationByVelocities, AccelerationByTorqueAndPosition
    }
        "Second derivatives of the forward dynamics, of λᵀq̈ for a given λ.";
}
