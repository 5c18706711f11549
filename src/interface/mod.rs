//! Robots as values: a trait a question, for code that is generic over robots.
//!
//! A module of `dynamics!` has functions, which a call names. Whoever writes one
//! controller for several arms asks for `interface: traits;`, and each module has a
//! `Robot` besides that answers the same questions by these traits. They are no
//! more than signatures: any type can have them, such as a double in a test.
//! What has several answers gives them as a struct of [`answers`]; a regressor
//! says besides how many columns it has.

pub mod answers;

macro_rules! questions {
    ($($(#[$doc:meta])* $question:ident$(<$columns:ident>)?::$ask:ident($($argument:ident),+) -> $answer:ty;)*) => {$(
        $(#[$doc])*
        pub trait $question<T, const N: usize $(, const $columns: usize)?> {
            $(#[$doc])*
            fn $ask(&self, $($argument: &[T; N]),+) -> $answer;
        }

        impl<R, T, const N: usize $(, const $columns: usize)?> $question<T, N $(, $columns)?> for &R
        where
            R: $question<T, N $(, $columns)?> + ?Sized,
        {
            #[inline]
            fn $ask(&self, $($argument: &[T; N]),+) -> $answer {
                (**self).$ask($($argument),+)
            }
        }
    )*};
}

// One for every output. What bundles of the user's return is of their module alone.
questions! {
    /// τ(q, q̇, q̈): torques and forces, viscous damping included.
    InverseDynamics::inverse_dynamics(q, qd, qdd) -> [T; N];
    /// c(q): the gravity load.
    Gravity::gravity(q) -> [T; N];
    /// D(q): the inertia matrix.
    Inertia::inertia(q) -> [[T; N]; N];
    /// h(q, q̇): the Coriolis and centripetal load.
    Coriolis::coriolis(q, qd) -> [T; N];
    /// T(q, q̇): the kinetic energy.
    KineticEnergy::kinetic_energy(q, qd) -> T;
    /// U(q): the potential energy.
    PotentialEnergy::potential_energy(q) -> T;
    /// C(q, q̇): the Coriolis matrix.
    CoriolisMatrix::coriolis_matrix(q, qd) -> [[T; N]; N];
    /// The pose [R | p] of the hand.
    ForwardKinematics::forward_kinematics(q) -> [[T; 4]; 3];
    /// The pose of every link.
    LinkPoses::link_poses(q) -> [[[T; 4]; 3]; N];
    /// J(q): the Jacobian of the hand, linear over angular velocity.
    Jacobian::jacobian(q) -> [[T; N]; 6];
    /// J̇ q̇: the acceleration of the hand that velocities alone give.
    JacobianRate::jacobian_rate(q, qd) -> [T; 6];
    /// Force and moment at every joint.
    ReactionWrenches::reaction_wrenches(q, qd, qdd) -> [[T; 6]; N];
    /// D a + C v + c + b∘v.
    Passivity::passivity(q, qd, v, a) -> [T; N];
    /// q̈(q, q̇, τ): forward dynamics.
    ForwardDynamics::forward_dynamics(q, qd, tau) -> [T; N];
    /// D⁻¹(q): the inverse of the inertia matrix.
    InertiaInverse::inertia_inverse(q) -> [[T; N]; N];
    /// D, h and c at once.
    ManipulatorEquation::manipulator_equation(q, qd) -> answers::ManipulatorEquation<T, N>;
    /// D, every h_ikm and c at once.
    DynamicCoefficients::dynamic_coefficients(q) -> answers::DynamicCoefficients<T, N>;
    /// D q̇ and Cᵀq̇.
    Momentum::momentum(q, qd) -> answers::Momentum<T, N>;
    /// Computes the contributions of rotation and translation of the links to D and h, and c.
    DalembertTerms::dalembert_terms(q, qd) -> answers::DalembertTerms<T, N>;
    /// ∂τ/∂q, ∂τ/∂q̇ and D.
    InverseDynamicsDerivatives::inverse_dynamics_derivatives(q, qd, qdd) -> answers::InverseDynamicsDerivatives<T, N>;
    /// ∂q̈/∂q, ∂q̈/∂q̇ and ∂q̈/∂τ.
    ForwardDynamicsDerivatives::forward_dynamics_derivatives(q, qd, tau) -> answers::ForwardDynamicsDerivatives<T, N>;
    /// Y in τ = Y π, over as many base parameters as the robot has.
    Regressor<K>::regressor(q, qd, qdd) -> [[T; K]; N];
    /// Y in τ = Y π, over the ten parameters of each link: K is 10 N.
    FullRegressor<K>::full_regressor(q, qd, qdd) -> [[T; K]; N];
    /// Y in D a + C v + c + b∘v = Y π, over the base parameters.
    PassivityRegressor<K>::passivity_regressor(q, qd, v, a) -> [[T; K]; N];
}
