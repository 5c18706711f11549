//! What questions with several answers are answered by: the structs that generated
//! modules have of their own, with the scalar and the number of joints as parameters,
//! so that one type fits every robot.

macro_rules! answers {
    ($($(#[$doc:meta])* $answer:ident { $($(#[$of:meta])* $field:ident: $kind:ty,)* })*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct $answer<T, const N: usize> {
            $($(#[$of])* pub $field: $kind,)*
        }
    )*};
}

answers! {
    /// D, h and c.
    ManipulatorEquation {
        /// Inertia matrix D.
        d: [[T; N]; N],
        /// Coriolis and centripetal load h.
        h: [T; N],
        /// Gravity load c.
        c: [T; N],
    }
    /// D, every h_ikm and c.
    DynamicCoefficients {
        /// Inertia matrix D.
        d: [[T; N]; N],
        /// `h[i][k][m]` = h_ikm, zero-based, symmetric in k and m.
        h: [[[T; N]; N]; N],
        /// Gravity load c.
        c: [T; N],
    }
    /// The momentum and its slope.
    Momentum {
        /// Momentum p = D q̇.
        p: [T; N],
        /// Its slope Cᵀq̇ = ∂T/∂q.
        ct_qd: [T; N],
    }
    /// The momentum and its drift.
    MomentumObserver {
        /// Momentum p = D q̇.
        p: [T; N],
        /// Its drift β = Cᵀq̇ − c − b∘q̇.
        drift: [T; N],
    }
    /// Contributions of rotation and translation of the links to D and h, and c.
    DalembertTerms {
        /// Rotational part of D.
        d_rot: [[T; N]; N],
        /// Translational part of D.
        d_tran: [[T; N]; N],
        /// Rotational part of h.
        h_rot: [T; N],
        /// Translational part of h.
        h_tran: [T; N],
        /// Gravity load c.
        c: [T; N],
    }
    /// The slopes of τ.
    InverseDynamicsDerivatives {
        /// ∂τ/∂q: row i has the slopes of τ_i.
        dtau_dq: [[T; N]; N],
        /// ∂τ/∂q̇, damping on its diagonal.
        dtau_dqd: [[T; N]; N],
        /// ∂τ/∂q̈ = D, the inertia matrix.
        d: [[T; N]; N],
    }
    /// The slopes of q̈.
    ForwardDynamicsDerivatives {
        /// ∂q̈/∂q: row i has the slopes of q̈_i.
        dqdd_dq: [[T; N]; N],
        /// ∂q̈/∂q̇: row i has the slopes of q̈_i.
        dqdd_dqd: [[T; N]; N],
        /// ∂q̈/∂τ = D⁻¹.
        dqdd_dtau: [[T; N]; N],
    }
    /// The second derivatives of λᵀτ.
    InverseDynamicsSecondDerivatives {
        /// ∂²(λᵀτ)/∂q∂q, symmetric.
        d2tau_dq_dq: [[T; N]; N],
        /// ∂²(λᵀτ)/∂q∂q̇: row i has the slopes by q̇ of ∂(λᵀτ)/∂q_i.
        d2tau_dq_dqd: [[T; N]; N],
        /// ∂²(λᵀτ)/∂q̇∂q̇, symmetric.
        d2tau_dqd_dqd: [[T; N]; N],
        /// ∂²(λᵀτ)/∂q̈∂q = ∂(D λ)/∂q: row i has the slopes of (D λ)_i.
        d2tau_dqdd_dq: [[T; N]; N],
    }
    /// The second derivatives of λᵀq̈.
    ForwardDynamicsSecondDerivatives {
        /// ∂²(λᵀq̈)/∂q∂q, symmetric.
        d2qdd_dq_dq: [[T; N]; N],
        /// ∂²(λᵀq̈)/∂q∂q̇: row i has the slopes by q̇ of ∂(λᵀq̈)/∂q_i.
        d2qdd_dq_dqd: [[T; N]; N],
        /// ∂²(λᵀq̈)/∂q̇∂q̇, symmetric.
        d2qdd_dqd_dqd: [[T; N]; N],
        /// ∂²(λᵀq̈)/∂τ∂q = ∂(D⁻¹λ)/∂q: row i has the slopes of (D⁻¹λ)_i.
        d2qdd_dtau_dq: [[T; N]; N],
    }
}
