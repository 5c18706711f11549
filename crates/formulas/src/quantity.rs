//! The quantities that have formulas.

use dalembert_codegen::words;

use crate::symbol::Symbol;

words! {
    /// A quantity whose entries are written.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
    pub enum Quantity: "quantity that has formulas" {
        /// D_ik (eq. 2.6).
        Inertia = "D",
        /// h_ikm (eq. 2.7).
        Christoffel = "h",
        /// c_i (eq. 2.8).
        Gravity = "c",
        /// τ_i by D, h and c (eq. 2.3).
        Torque = "tau",
        /// D^rot_ik of generalized D'Alembert (eq. 4.2): the part of the links' moments of inertia.
        InertiaRotation = "D_rot",
        /// D^tran_ik: the part of the links' masses.
        InertiaTranslation = "D_tran",
        /// h^rot_ikm (eq. 4.4).
        ChristoffelRotation = "h_rot",
        /// h^tran_ikm (eq. 4.3).
        ChristoffelTranslation = "h_tran",
        /// T = ½ q̇ᵀ D q̇.
        KineticEnergy = "T",
        /// U = −Σ m_j g·r_j.
        PotentialEnergy = "U",
        /// The hand's rotation R and position p in base axes.
        Pose = "pose",
        /// The hand's Jacobian, linear velocity first, in base axes.
        Jacobian = "jacobian",
    }
}

impl Quantity {
    /// The heading of its formulas.
    pub(crate) fn title(self) -> &'static str {
        match self {
            Quantity::Inertia => "Inertia: D_ik, i ≤ k",
            Quantity::Christoffel => "Coriolis and centrifugal: h_ikm, k ≤ m",
            Quantity::Gravity => "Gravity: c_i",
            Quantity::Torque => "Torques: τ_i",
            Quantity::InertiaRotation => "Inertia of rotation: D^rot_ik, i ≤ k",
            Quantity::InertiaTranslation => "Inertia of translation: D^tran_ik, i ≤ k",
            Quantity::ChristoffelRotation => {
                "Coriolis and centrifugal, of rotation: h^rot_ikm, k ≤ m"
            }
            Quantity::ChristoffelTranslation => {
                "Coriolis and centrifugal, of translation: h^tran_ikm, k ≤ m"
            }
            Quantity::KineticEnergy => "Kinetic energy: T",
            Quantity::PotentialEnergy => "Potential energy: U",
            Quantity::Pose => "Pose of the hand: rotation R and position p, in base axes",
            Quantity::Jacobian => {
                "Jacobian of the hand: linear velocity, then angular, in base axes"
            }
        }
    }

    /// The letter and the mark of its entries.
    pub(crate) fn letters(self) -> [&'static str; 2] {
        let name = self.name();
        match self {
            Quantity::Torque => ["τ", ""],
            Quantity::Pose => ["R", ""],
            Quantity::Jacobian => ["J", ""],
            _ => name.split_once('_').unwrap_or((name, "")).into(),
        }
    }

    pub(crate) fn entry(self, indices: &[usize]) -> Symbol {
        let [letters, mark] = self.letters();
        Symbol::entry(letters, mark, indices)
    }
}
