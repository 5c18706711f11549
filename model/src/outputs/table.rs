//! The outputs as rows of two tables: functions by their names, and the quantities that they
//! return with all that is known of these beside their formulas.

use alloc::vec::Vec;

use super::Argument::{
    Acceleration as A, Damping, Multiplier, Payload, Position as Q, ReferenceAcceleration,
    ReferenceVelocity, Torque as T, Velocity as V, Wrench as W,
};
use super::Axis::{BaseParameters, Fixed, Joints, LinkParameters};
use super::function::Definition;
use super::quantity::{ErrorScale, FrameChoice, Row};
use super::unit::Unit::{self, Powers};
use super::{Argument, Axis, PayloadDependence, Shape, at, bundle};
use crate::equations::chain::Choice::{CompositeH, Flows, HandAxes, NormalEquations, Shoulder};

/// The arguments of a controller that is based on passivity.
const WISHED: &[Argument] = &[Q, V, ReferenceVelocity, ReferenceAcceleration];
const TWIST: Shape = Shape(&[Fixed(6)]);
const TWISTS: Shape = Shape(&[Fixed(6), Fixed(6)]);

/// A line a function: its documentation, its name in Rust and in generated code, the quantities
/// that it returns, and its summary.
macro_rules! functions {
    (
        $($(#[$doc:meta])* $name:ident: $function:ident [$($result:ident),*] $summary:literal;)*
        ; beside them:
        $($(#[$along_doc:meta])* $along_name:ident: $along:ident [$part:ident] $along_summary:literal;)*
    ) => {
        /// A function that can be generated.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub enum Function {
            $($(#[$doc])* $function,)*
            $($(#[$along_doc])* $along,)*
            /// Several of these in one, by a name of the user's.
            Bundle(bundle::Bundle),
            /// One of these at a frame.
            At(at::FunctionAt),
        }

        impl Function {
            /// Every function that can be asked for by its name alone, in the order of
            /// generated files: bundles have theirs from the user.
            pub const ALL: [Function; [$(Function::$function),*].len()] = [$(Function::$function),*];

            pub(super) fn definition(self) -> &'static Definition {
                match self {
                    $(Function::$function => &const { Definition {
                        name: stringify!($name),
                        summary: $summary,
                        results: &[$(Quantity::$result),*],
                        structure: match [$(Quantity::$result),*].len() {
                            1 => None,
                            _ => Some(stringify!($function)),
                        },
                        parts: &[],
                    } },)*
                    $(Function::$along => &const { Definition {
                        name: stringify!($along_name),
                        summary: $along_summary,
                        results: &[Quantity::$part],
                        structure: None,
                        parts: &[],
                    } },)*
                    Function::Bundle(bundle) => bundle.definition(),
                    Function::At(at) => at.definition(),
                }
            }
        }
    };
}

functions! {
    /// τ(q, q̇, q̈): torques and forces, viscous damping included.
    inverse_dynamics: InverseDynamics [Torque]
        "Inverse dynamics: the joint torques (forces) τ = D q̈ + h + c + b∘q̇.";
    /// c(q): the gravity load.
    gravity: Gravity [Gravity] "Gravity load c(q): the torques that hold the arm still.";
    /// D(q): the inertia matrix.
    inertia: Inertia [Inertia] "Inertia matrix D(q), symmetric; armature is on its diagonal.";
    /// h(q, q̇): the Coriolis and centripetal load.
    coriolis: Coriolis [Coriolis]
        "Coriolis and centripetal load h(q, q̇), damping not included.";
    /// D, h and c in one function that shares their work.
    manipulator_equation: ManipulatorEquation [Inertia, Coriolis, Gravity]
        "D(q), h(q, q̇) and c(q), with shared work.";
    /// D, every h_ikm and c in one function.
    dynamic_coefficients: DynamicCoefficients [Inertia, Christoffel, Gravity]
        "D(q), every Christoffel symbol h_ikm(q) and c(q), with shared work.";
    /// T(q, q̇): the kinetic energy.
    kinetic_energy: KineticEnergy [KineticEnergy]
        "Kinetic energy T = ½ q̇ᵀ D q̇ in joules, the rotors' part included.";
    /// U(q): the potential energy.
    potential_energy: PotentialEnergy [PotentialEnergy]
        "Potential energy U = -Σ m g·r in joules, r from the base's origin.";
    /// D q̇ and Cᵀq̇.
    momentum: Momentum [Momentum, MomentumSlope]
        "Momentum p = D q̇ and its slope Cᵀq̇ = ∂T/∂q: ṗ = τ + Cᵀq̇ - c - b∘q̇.";
    /// C(q, q̇): the Coriolis matrix.
    coriolis_matrix: CoriolisMatrix [CoriolisMatrix]
        "Coriolis matrix C(q, q̇) of the Christoffel symbols: C q̇ = h, and Ḋ - 2C is skew.";
    /// Contributions of the links' rotation and translation to D and h, and c (eqs. 4.2–4.5).
    dalembert_terms: DalembertTerms [
        RotationInertia, TranslationInertia, RotationCoriolis, TranslationCoriolis, Gravity
    ]
        "What rotation and translation of the links contribute: D^rot, D^tran, h^rot, h^tran, and c; armature in neither D.";
    /// The pose of the hand (eq. 2.1).
    forward_kinematics: ForwardKinematics [Pose]
        "Forward kinematics: the pose [R | p] of the last frame in base axes, 3×4, lengths in metres.";
    /// The pose of every link.
    link_poses: LinkPoses [LinkPoses]
        "Poses [R | p] of every link's frame in base axes, n×3×4, lengths in metres.";
    /// J(q): the Jacobian of the hand.
    jacobian: Jacobian [Jacobian]
        "Jacobian J(q) of the last frame in base axes, 6×n: linear over angular velocity, at its origin.";
    /// J̇ q̇: the acceleration of the hand that velocities alone give.
    jacobian_rate: JacobianRate [JacobianRate]
        "J̇q̇, the acceleration of the last frame that its velocities alone give, linear over angular.";
    /// Force and moment at every joint (Table 1).
    reaction_wrenches: ReactionWrenches [Wrench]
        "Force and moment that link i-1 exerts on link i in base axes, gravity included, n×6: for bearings and links.";
    /// ∂τ/∂q, ∂τ/∂q̇ and D.
    inverse_dynamics_derivatives: InverseDynamicsDerivatives [
        TorqueByPosition, TorqueByVelocity, Inertia
    ]
        "Derivatives of the inverse dynamics: ∂τ/∂q, ∂τ/∂q̇ and ∂τ/∂q̈ = D.";
    /// D a + C v + c + b∘v (Slotine and Li), with v and a a controller's reference.
    passivity: Passivity [Passivity]
        "Passivity-based control: D a + C v + c + b∘v, with C of the Christoffel symbols.";
    /// q̈(q, q̇, τ): forward dynamics.
    forward_dynamics: ForwardDynamics [Acceleration]
        "Forward dynamics: the accelerations q̈ = D⁻¹ (τ - h - c - b∘q̇).";
    /// D⁻¹(q): the inverse of the inertia matrix.
    inertia_inverse: InertiaInverse [InertiaInverse]
        "Inverse D⁻¹(q) of the inertia matrix, symmetric.";
    /// ∂q̈/∂q, ∂q̈/∂q̇ and ∂q̈/∂τ.
    forward_dynamics_derivatives: ForwardDynamicsDerivatives [
        AccelerationByPosition, AccelerationByVelocity, AccelerationByTorque
    ]
        "Derivatives of the forward dynamics: ∂q̈/∂q, ∂q̈/∂q̇ and ∂q̈/∂τ = D⁻¹.";
    /// Y over the base parameters: τ = Y π.
    regressor: Regressor [BaseRegressor]
        "Regressor Y(q, q̇, q̈) over the base parameters, n×k: the joint torques (forces) are τ = Y π.";
    /// Y over all inertial parameters of all links.
    full_regressor: FullRegressor [LinkRegressor]
        "Regressor Y(q, q̇, q̈) over all links' parameters, n×10n: the links' part of the joint torques is Y π. A link has m, m x, m y, m z, Ixx, Iyy, Izz, Ixy, Iyz, Ixz, about the origin of its DH frame.";
    /// Y over the base parameters: D a + C v + c + b∘v = Y π. It is not the regressor of torques at
    /// other arguments: C(q, q̇) v has two velocities, and Ḋ − 2C must be skew.
    passivity_regressor: PassivityRegressor [PassivityRegressor]
        "Regressor Y(q, q̇, v, a) of passivity-based control over the base parameters, n×k: D a + C v + c + b∘v = Y π, with C of the Christoffel symbols.";
    /// D q̇ and Cᵀq̇ − c − b∘q̇: what an observer of outside forces integrates (De Luca and
    /// Mattone, "Sensorless robot collision detection and hybrid force/motion control", 2005).
    momentum_observer: MomentumObserver [Momentum, MomentumDrift]
        "Momentum p = D q̇ and its drift β = Cᵀq̇ - c - b∘q̇: ṗ = τ + β but for outside forces.";
    /// τ(q, q̇, q̈) beside a wrench that acts on the hand.
    inverse_dynamics_with_wrench: InverseDynamicsWithWrench [ContactTorque]
        "Inverse dynamics while a wrench w acts on the hand: τ = D q̈ + h + c + b∘q̇ - Jᵀw.";
    /// q̈(q, q̇, τ) under a wrench that acts on the hand.
    forward_dynamics_with_wrench: ForwardDynamicsWithWrench [ContactAcceleration]
        "Forward dynamics while a wrench w acts on the hand: q̈ = D⁻¹ (τ + Jᵀw - h - c - b∘q̇).";
    /// The wrench on the hand that joint torques of its alone say.
    contact_wrench: ContactWrench [ContactWrench]
        "The wrench on the hand that the torques τ come from: ŵ = (J Jᵀ + λ² 1)⁻¹ J τ.";
    /// Λ⁻¹ = J D⁻¹ Jᵀ: the mobility of the hand, its acceleration under a unit wrench.
    operational_inertia_inverse: OperationalInertiaInverse [OperationalInertiaInverse]
        "Mobility of the hand, the inverse of its inertia: Λ⁻¹ = J D⁻¹ Jᵀ, symmetric.";
    /// Λ: the inertia of the hand.
    operational_inertia: OperationalInertia [OperationalInertia]
        "Inertia of the hand, damped where the arm is singular: Λ = (J D⁻¹ Jᵀ + λ² 1)⁻¹, symmetric.";
    /// J̄ = D⁻¹ Jᵀ Λ, the inverse of J that moves the hand with the least kinetic energy.
    consistent_inverse: ConsistentInverse [ConsistentInverse]
        "Dynamically consistent inverse of the Jacobian: J̄ = D⁻¹ Jᵀ Λ, n×6.";
    /// μ = Λ (J D⁻¹ (h + c) − J̇ q̇): the wrench that keeps the hand's velocity.
    operational_bias: OperationalBias [OperationalBias]
        "Bias force of the hand: μ = Λ (J D⁻¹ (h + c) - J̇q̇), without friction.";
    /// N = 1 − J̄ J: torques through Nᵀ do not accelerate the hand.
    null_space_projector: NullSpaceProjector [NullSpace]
        "Null-space projector N = 1 - J̄ J of velocities; Nᵀ is that of torques.";
    /// Second derivatives of λᵀτ.
    inverse_dynamics_second_derivatives: InverseDynamicsSecondDerivatives [
        TorqueByPositions, TorqueByPositionAndVelocity, TorqueByVelocities,
        TorqueByAccelerationAndPosition
    ]
        "Second derivatives of the inverse dynamics, of λᵀτ for a given λ.";
    /// Second derivatives of λᵀq̈, which differential dynamic programming adds to the first: λ is
    /// the slope of the cost to go. By τ and q̇, and by τ and τ, they vanish.
    forward_dynamics_second_derivatives: ForwardDynamicsSecondDerivatives [
        AccelerationByPositions, AccelerationByPositionAndVelocity, AccelerationByVelocities,
        AccelerationByTorqueAndPosition
    ]
        "Second derivatives of the forward dynamics, of λᵀq̈ for a given λ.";

    ; beside them:

    /// The regrouped parameters of the arm with a payload: those of the last link and, by its
    /// mass, some of the links before. They stand in all other functions where constants stood.
    load: Load [Load]
        "Load: the regrouped parameters of the arm with a payload, once for each tool.";
}

/// A line a quantity: the function that defines it, its documentation and its name in Rust; its
/// field in structs, its letter and a line of documentation; arguments, shape and unit; then
/// the row that it shares the rest with, and what differs from that.
macro_rules! quantities {
    ($(
        $function:ident: $(#[$doc:meta])* $quantity:ident $field:literal $letter:literal $summary:literal
        ($arguments:expr) $shape:expr, $unit:expr; $base:ident { $($key:ident: $value:expr),* $(,)? }
    )*) => {
        /// A quantity that a function returns.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub enum Quantity {
            $(
                #[doc = concat!("Of [`Function::", stringify!($function), "`].")]
                $(#[$doc])*
                $quantity,
            )*
            /// One of these at a frame.
            At(at::QuantityAt),
        }

        impl Quantity {
            /// Every quantity of a function that can be asked for, in the order of these: all but
            /// the last, which comes along with others.
            pub const ALL: &[Quantity] = [$(Quantity::$quantity,)*].split_last().unwrap().1;

            pub(super) fn row(self) -> &'static Row {
                match self {
                    $(Quantity::$quantity => &const { Row {
                        function: Function::$function,
                        field: $field,
                        letter: $letter,
                        summary: $summary,
                        arguments: $arguments,
                        shape: $shape,
                        unit: $unit,
                        $($key: $value,)*
                        ..Row::$base
                    } },)*
                    Quantity::At(at) => at.row(),
                }
            }
        }
    };
}

quantities! {
    InverseDynamics: Torque "tau" "τ" "Torques τ."
        (&Argument::STATE) Shape::VECTOR, Unit::LOAD;
        CHAIN { choices: Some(&[CompositeH]), scale: ErrorScale::Load, given: Some("tau"),
                starts_from_recursion: true, gravity: true }
    Gravity: Gravity "c" "c" "Gravity load c."
        (&[Q]) Shape::VECTOR, Unit::LOAD;
        CHAIN { choices: Some(&[CompositeH]), scale: ErrorScale::Load, given: Some("c"),
                gravity: true }
    Inertia: Inertia "d" "D" "Inertia matrix D."
        (&[Q]) Shape::MATRIX, Unit::INERTIA;
        CHAIN { scale: ErrorScale::Inertia, given: Some("D"), definite: true }
    Coriolis: Coriolis "h" "h" "Coriolis and centripetal load h."
        (&[Q, V]) Shape::VECTOR, Unit::LOAD;
        CHAIN { choices: Some(&[CompositeH]), scale: ErrorScale::Load, given: Some("h") }
    DynamicCoefficients: Christoffel "h" "h"
        "`h[i][k][m]` = h_ikm, zero-based, symmetric in k and m."
        (&[Q]) Shape::CUBE, Powers([1, 0, -1, 0], &[1, 1, 1]);
        CHAIN { symbol: "h_ikm", scale: ErrorScale::Coefficient,
                given_as: Some((Quantity::Coriolis, contracted)), by_differences: true }
    KineticEnergy: KineticEnergy "kinetic" "T" "Kinetic energy T."
        (&[Q, V]) Shape::SCALAR, Unit::Named("J");
        CHAIN { given: Some("kinetic") }
    PotentialEnergy: PotentialEnergy "potential" "U" "Potential energy U."
        (&[Q]) Shape::SCALAR, Unit::Named("J");
        PLAIN { given: Some("potential"), depends_on_base: true, gravity: true,
                payload_dependence: PayloadDependence::Full }
    Momentum: Momentum "p" "p" "Momentum p = D q̇."
        (&[Q, V]) Shape::VECTOR, Powers([1, 0, 1, -1], &[1]);
        CHAIN {}
    Momentum: MomentumSlope "ct_qd" "s" "Its slope Cᵀq̇ = ∂T/∂q."
        (&[Q, V]) Shape::VECTOR, Unit::LOAD;
        CHAIN { symbol: "Cᵀq̇" }
    CoriolisMatrix: CoriolisMatrix "c_matrix" "C" "Coriolis matrix C."
        (&[Q, V]) Shape::MATRIX, Powers([0, 1, -1, 1], &[1, 1]);
        CHAIN { choices: Some(&[Flows]), by_differences: true }
    DalembertTerms: RotationInertia "d_rot" "Drot" "Inertia matrix of the links' rotation D^rot."
        (&[Q]) Shape::MATRIX, Unit::INERTIA;
        PLAIN { scale: ErrorScale::Inertia, payload_dependence: PayloadDependence::Full }
    DalembertTerms: TranslationInertia "d_tran" "Dtran"
        "Inertia matrix of the links' translation D^tran."
        (&[Q]) Shape::MATRIX, Unit::INERTIA;
        PLAIN { scale: ErrorScale::Inertia, payload_dependence: PayloadDependence::Full }
    DalembertTerms: RotationCoriolis "h_rot" "hrot"
        "Coriolis and centripetal load of the links' rotation h^rot."
        (&[Q, V]) Shape::VECTOR, Unit::LOAD;
        PLAIN { scale: ErrorScale::Load, payload_dependence: PayloadDependence::Full }
    DalembertTerms: TranslationCoriolis "h_tran" "htran"
        "Coriolis and centripetal load of the links' translation h^tran."
        (&[Q, V]) Shape::VECTOR, Unit::LOAD;
        PLAIN { scale: ErrorScale::Load, payload_dependence: PayloadDependence::Full }
    ForwardKinematics: Pose "pose" "A" "Pose [R | p] of the last frame."
        (&[Q]) Shape(&[Fixed(3), Fixed(4)]), Unit::Pose;
        PLAIN { given: Some("pose"), depends_on_base: true, frame: FrameChoice::Frame }
    LinkPoses: LinkPoses "poses" "A" "Poses [R | p] of the links' frames."
        (&[Q]) Shape(&[Joints, Fixed(3), Fixed(4)]), Unit::Pose;
        PLAIN { symbol: "A_i", depends_on_base: true, of_links: true }
    Jacobian: Jacobian "jacobian" "J" "Jacobian J, linear over angular."
        (&[Q]) Shape(&[Fixed(6), Joints]), Powers([0; 4], &[-1, 1]);
        PLAIN { given: Some("jacobian"), depends_on_base: true, frame: FrameChoice::Rows }
    JacobianRate: JacobianRate "jacobian_rate" "a" "J̇q̇, linear over angular."
        (&[Q, V]) TWIST, Powers([0, 0, 1, -2], &[-1]);
        PLAIN { symbol: "J̇q̇", given: Some("jacobian_rate_qd"), depends_on_base: true,
                frame: FrameChoice::Rows }
    ReactionWrenches: Wrench "wrenches" "w"
        "Force over moment at every joint, about the origin of the frame whose z is its axis."
        (&Argument::STATE) Shape(&[Joints, Fixed(6)]), Powers([0, 1, 0, 0], &[0, 1]);
        PLAIN { given: Some("wrench"), depends_on_base: true, gravity: true, of_links: true,
                payload_dependence: PayloadDependence::Full }
    InverseDynamicsDerivatives: TorqueByPosition "dtau_dq" "τq"
        "∂τ/∂q: row i has the slopes of τ_i."
        (&Argument::STATE) Shape::MATRIX, Powers([0, 1, -1, 0], &[1, 1]);
        CHAIN { symbol: "∂τ/∂q", given: Some("dtau_dq"), gravity: true }
    InverseDynamicsDerivatives: TorqueByVelocity "dtau_dqd" "τv"
        "∂τ/∂q̇, damping on its diagonal."
        (&[Q, V]) Shape::MATRIX, Powers([0, 1, -1, 1], &[1, 1]);
        CHAIN { symbol: "∂τ/∂q̇", given: Some("dtau_dqd") }
    Passivity: Passivity "tau" "τ" "Torques D a + C v + c + b∘v."
        (WISHED) Shape::VECTOR, Unit::LOAD;
        CHAIN { symbol: "D a + C v + c + b∘v", scale: ErrorScale::Load,
                by_differences: true, gravity: true }
    ForwardDynamics: Acceleration "qdd" "q̈" "Accelerations q̈."
        (&[Q, V, T]) Shape::VECTOR, Unit::JointAcceleration;
        CHAIN { choices: Some(&[CompositeH, Shoulder]), given: Some("forward_dynamics"),
                inverts_inertia: true, gravity: true }
    InertiaInverse: InertiaInverse "d_inv" "D⁻¹" "Inverse D⁻¹ of the inertia matrix."
        (&[Q]) Shape::MATRIX, Powers([-1, 0, 0, 0], &[-1, -1]);
        CHAIN { given: Some("inertia_inverse"), inverts_inertia: true }
    ForwardDynamicsDerivatives: AccelerationByPosition "dqdd_dq" "q̈q"
        "∂q̈/∂q: row i has the slopes of q̈_i."
        (&[Q, V, T]) Shape::MATRIX, Powers([0, 0, 0, -2], &[-1, 1]);
        CHAIN { symbol: "∂q̈/∂q", given: Some("dqdd_dq"), inverts_inertia: true, gravity: true }
    ForwardDynamicsDerivatives: AccelerationByVelocity "dqdd_dqd" "q̈v"
        "∂q̈/∂q̇: row i has the slopes of q̈_i."
        (&[Q, V, T]) Shape::MATRIX, Powers([0, 0, 0, -1], &[-1, 1]);
        CHAIN { symbol: "∂q̈/∂q̇", given: Some("dqdd_dqd"), inverts_inertia: true }
    ForwardDynamicsDerivatives: AccelerationByTorque "dqdd_dtau" "q̈τ" "∂q̈/∂τ = D⁻¹."
        (&[Q]) Shape::MATRIX, Powers([-1, 0, 0, 0], &[-1, -1]);
        CHAIN { symbol: "∂q̈/∂τ", inverts_inertia: true }
    Regressor: BaseRegressor "y" "Y" "Regressor Y over the base parameters."
        (&Argument::STATE) Shape(&[Joints, BaseParameters]), Unit::None;
        REGRESSOR { linear: Some(("τ", "BASE_PARAMETERS")), starts_from_recursion: true }
    FullRegressor: LinkRegressor "y" "Y" "Regressor Y over all links' parameters."
        (&Argument::STATE) Shape(&[Joints, LinkParameters]), Powers([0, 0, 0, -2], &[1, 1]);
        REGRESSOR { symbol: "Y over all links' parameters", given: Some("regressor"),
                    starts_from_recursion: true }
    PassivityRegressor: PassivityRegressor "y" "Y"
        "Regressor Y of D a + C v + c + b∘v over the base parameters."
        (WISHED) Shape(&[Joints, BaseParameters]), Unit::None;
        REGRESSOR { symbol: "Y of D a + C v + c + b∘v", by_differences: true,
                    linear: Some(("D a + C v + c + b∘v", "PASSIVITY_PARAMETERS")) }
    MomentumObserver: MomentumDrift "drift" "β" "Drift β = Cᵀq̇ - c - b∘q̇ of the momentum."
        (&[Q, V]) Shape::VECTOR, Unit::LOAD;
        CHAIN { choices: Some(&[CompositeH]), given: Some("momentum_drift"), gravity: true }
    InverseDynamicsWithWrench: ContactTorque "tau" "τ" "Torques τ beside the wrench."
        (&[Q, V, A, W]) Shape::VECTOR, Unit::LOAD;
        HAND { choices: Some(&[CompositeH]), symbol: "τ(w)", scale: ErrorScale::Load,
               given: Some("tau_with_wrench"), inverts_inertia: false, gravity: true,
               frame: FrameChoice::Axes }
    ForwardDynamicsWithWrench: ContactAcceleration "qdd" "q̈" "Accelerations q̈ under the wrench."
        (&[Q, V, T, W]) Shape::VECTOR, Unit::JointAcceleration;
        HAND { choices: Some(&[CompositeH, Shoulder]), symbol: "q̈(w)",
               given: Some("qdd_with_wrench"), gravity: true, frame: FrameChoice::Axes }
    ContactWrench: ContactWrench "contact_wrench" "ŵ" "Wrench ŵ, force over moment."
        (&[Q, T, Damping]) TWIST, Unit::LOAD;
        PLAIN { given: Some("contact_wrench"), depends_on_base: true, frame: FrameChoice::Rows }
    OperationalInertiaInverse: OperationalInertiaInverse "operational_inertia_inverse" "Λ⁻¹"
        "Mobility Λ⁻¹ of the hand, linear over angular."
        (&[Q]) TWISTS, Powers([-1, 0, 0, 0], &[-1, -1]);
        HAND { given: Some("operational_inertia_inverse") }
    OperationalInertia: OperationalInertia "operational_inertia" "Λ"
        "Inertia Λ of the hand, linear over angular."
        (&[Q, Damping]) TWISTS, Unit::INERTIA;
        HAND { given: Some("operational_inertia") }
    ConsistentInverse: ConsistentInverse "consistent_inverse" "J̄"
        "Dynamically consistent inverse J̄ of the Jacobian."
        (&[Q, Damping]) Shape(&[Joints, Fixed(6)]), Powers([0; 4], &[-1, 1]);
        HAND { choices: Some(&[HandAxes, NormalEquations]), given: Some("consistent_inverse") }
    OperationalBias: OperationalBias "operational_bias" "μ"
        "Bias force μ of the hand, force over moment."
        (&[Q, V, Damping]) TWIST, Unit::LOAD;
        HAND { choices: Some(&[CompositeH, HandAxes]), given: Some("operational_bias"),
               gravity: true }
    NullSpaceProjector: NullSpace "null_space" "N" "Null-space projector N = 1 - J̄ J."
        (&[Q, Damping]) Shape::MATRIX, Powers([0; 4], &[-1, 1]);
        HAND { choices: Some(&[HandAxes, NormalEquations]), given: Some("null_space_projector") }
    InverseDynamicsSecondDerivatives: TorqueByPositions "d2tau_dq_dq" "τqq" "∂²(λᵀτ)/∂q∂q, symmetric."
        (&[Q, V, A, Multiplier]) Shape::MATRIX, Powers([0, 1, -1, 0], &[1, 1]);
        CHAIN { symbol: "∂²(λᵀτ)/∂q∂q", given: Some("d2tau_dq_dq"), gravity: true }
    InverseDynamicsSecondDerivatives: TorqueByPositionAndVelocity "d2tau_dq_dqd" "τqv"
        "∂²(λᵀτ)/∂q∂q̇: row i has the slopes by q̇ of ∂(λᵀτ)/∂q_i."
        (&[Q, V, Multiplier]) Shape::MATRIX, Powers([0, 1, -1, 1], &[1, 1]);
        CHAIN { symbol: "∂²(λᵀτ)/∂q∂q̇", given: Some("d2tau_dq_dqd") }
    InverseDynamicsSecondDerivatives: TorqueByVelocities "d2tau_dqd_dqd" "τvv"
        "∂²(λᵀτ)/∂q̇∂q̇, symmetric."
        (&[Q, V, Multiplier]) Shape::MATRIX, Unit::INERTIA;
        CHAIN { symbol: "∂²(λᵀτ)/∂q̇∂q̇", given: Some("d2tau_dqd_dqd") }
    InverseDynamicsSecondDerivatives: TorqueByAccelerationAndPosition "d2tau_dqdd_dq" "τaq"
        "∂²(λᵀτ)/∂q̈∂q = ∂(D λ)/∂q: row i has the slopes of (D λ)_i."
        (&[Q, Multiplier]) Shape::MATRIX, Unit::INERTIA;
        CHAIN { symbol: "∂²(λᵀτ)/∂q̈∂q", given: Some("d2tau_dqdd_dq") }
    ForwardDynamicsSecondDerivatives: AccelerationByPositions "d2qdd_dq_dq" "q̈qq"
        "∂²(λᵀq̈)/∂q∂q, symmetric."
        (&[Q, V, T, Multiplier]) Shape::MATRIX, Powers([0, 0, -2, -2], &[1, 1]);
        CHAIN { symbol: "∂²(λᵀq̈)/∂q∂q", given: Some("d2qdd_dq_dq"), inverts_inertia: true,
                gravity: true }
    ForwardDynamicsSecondDerivatives: AccelerationByPositionAndVelocity "d2qdd_dq_dqd" "q̈qv"
        "∂²(λᵀq̈)/∂q∂q̇: row i has the slopes by q̇ of ∂(λᵀq̈)/∂q_i."
        (&[Q, V, Multiplier]) Shape::MATRIX, Powers([0, 0, -2, -1], &[1, 1]);
        CHAIN { symbol: "∂²(λᵀq̈)/∂q∂q̇", given: Some("d2qdd_dq_dqd"), inverts_inertia: true }
    ForwardDynamicsSecondDerivatives: AccelerationByVelocities "d2qdd_dqd_dqd" "q̈vv"
        "∂²(λᵀq̈)/∂q̇∂q̇, symmetric."
        (&[Q, V, Multiplier]) Shape::MATRIX, Powers([0, 0, -2, 0], &[1, 1]);
        CHAIN { symbol: "∂²(λᵀq̈)/∂q̇∂q̇", given: Some("d2qdd_dqd_dqd"), inverts_inertia: true }
    ForwardDynamicsSecondDerivatives: AccelerationByTorqueAndPosition "d2qdd_dtau_dq" "q̈τq"
        "∂²(λᵀq̈)/∂τ∂q = ∂(D⁻¹λ)/∂q: row i has the slopes of (D⁻¹λ)_i."
        (&[Q, Multiplier]) Shape::MATRIX, Powers([-1, 0, -2, 0], &[-1, 1]);
        CHAIN { symbol: "∂²(λᵀq̈)/∂τ∂q", given: Some("d2qdd_dtau_dq"), inverts_inertia: true }
    Load: Load "load" "load" "The regrouped parameters that a payload changes."
        (&[Payload]) Shape(&[Axis::Load]), Unit::None;
        PLAIN {}
}

/// Returns h_i = Σ_k Σ_m h_ikm q̇_k q̇_m.
fn contracted(symbols: &[f64], qd: &[f64]) -> Vec<f64> {
    let n = qd.len();
    let row = |row: &[f64]| row.iter().zip(qd).map(|(h, v)| h * v).sum::<f64>();
    let load = |matrix: &[f64]| {
        let rows = matrix.chunks(n.max(1));
        rows.zip(qd).map(|(r, v)| row(r) * v).sum::<f64>()
    };
    symbols.chunks((n * n).max(1)).map(load).collect()
}
