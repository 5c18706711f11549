//! The quantities that have formulas.

use dalembert_codegen::workspace::Word;

use crate::symbol::Symbol;

/// A quantity whose entries are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Quantity {
    /// D_ik (eq. 2.6).
    Inertia,
    /// h_ikm (eq. 2.7).
    Christoffel,
    /// c_i (eq. 2.8).
    Gravity,
    /// τ_i by D, h and c (eq. 2.3).
    Torque,
    /// D^rot_ik of generalized D'Alembert (eq. 4.2): the part of the links' moments of inertia.
    InertiaRotation,
    /// D^tran_ik: the part of the links' masses.
    InertiaTranslation,
    /// h^rot_ikm (eq. 4.4).
    ChristoffelRotation,
    /// h^tran_ikm (eq. 4.3).
    ChristoffelTranslation,
    /// T = ½ q̇ᵀ D q̇.
    KineticEnergy,
    /// U = −Σ m_j g·r_j.
    PotentialEnergy,
    /// The hand's rotation R and position p in base axes.
    Pose,
    /// The hand's Jacobian, linear velocity first, in base axes.
    Jacobian,
}

impl Word for Quantity {
    const WHAT: &'static str = "quantity that has formulas";

    fn all() -> Vec<(&'static str, Quantity)> {
        vec![
            ("D", Quantity::Inertia),
            ("h", Quantity::Christoffel),
            ("c", Quantity::Gravity),
            ("tau", Quantity::Torque),
            ("D_rot", Quantity::InertiaRotation),
            ("D_tran", Quantity::InertiaTranslation),
            ("h_rot", Quantity::ChristoffelRotation),
            ("h_tran", Quantity::ChristoffelTranslation),
            ("T", Quantity::KineticEnergy),
            ("U", Quantity::PotentialEnergy),
            ("pose", Quantity::Pose),
            ("jacobian", Quantity::Jacobian),
        ]
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
        match self {
            Quantity::Inertia => ["D", ""],
            Quantity::Christoffel => ["h", ""],
            Quantity::Gravity => ["c", ""],
            Quantity::Torque => ["τ", ""],
            Quantity::InertiaRotation => ["D", "rot"],
            Quantity::InertiaTranslation => ["D", "tran"],
            Quantity::ChristoffelRotation => ["h", "rot"],
            Quantity::ChristoffelTranslation => ["h", "tran"],
            Quantity::KineticEnergy => ["T", ""],
            Quantity::PotentialEnergy => ["U", ""],
            Quantity::Pose => ["R", ""],
            Quantity::Jacobian => ["J", ""],
        }
    }

    pub(crate) fn entry(self, indices: &[usize]) -> Symbol {
        let [letters, mark] = self.letters();
        Symbol::entry(letters, mark, indices)
    }
}
