//! Decides exactly if a body can have an inertia tensor.
//!
//! For a body of density ρ, ½ tr(I)·1 − I = ∫ρ x xᵀ, which is positive semidefinite, and every such
//! matrix is that of some body. In principal axes this is the moments' triangle inequality.

use num_traits::{Signed, Zero};

use super::Inertia;
use crate::number::Rational;

/// The reason why no body can have a tensor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Defect {
    /// A principal moment is negative.
    NegativeMoment,
    /// One principal moment exceeds the sum of the other two.
    Triangle,
    /// The mass is zero, the tensor is not.
    Massless,
}

impl Defect {
    /// Returns the reason in words.
    pub fn message(self) -> &'static str {
        match self {
            Defect::NegativeMoment => "no body has this inertia: a principal moment is negative",
            Defect::Triangle => {
                "no body has this inertia: one principal moment exceeds the sum of the other two"
            }
            Defect::Massless => "no body has this inertia: the mass is zero",
        }
    }
}

impl Inertia<Rational> {
    /// Returns the reason why no body of this mass can have this tensor, if there is one.
    pub fn defect(&self, mass: &Rational) -> Option<Defect> {
        let tensor = self.rows();
        if !is_semidefinite(&tensor) {
            return Some(Defect::NegativeMoment);
        }
        let half = (&self.xx + &self.yy + &self.zz) / Rational::from_integer(2.into());
        let second = Inertia::symmetric(|i, k| match i == k {
            true => &half - &tensor[i][k],
            false => -&tensor[i][k],
        });
        if !is_semidefinite(&second.rows()) {
            return Some(Defect::Triangle);
        }
        (mass.is_zero() && !half.is_zero()).then_some(Defect::Massless)
    }
}

/// No principal minor, not only of the leading ones, is negative.
fn is_semidefinite(m: &[[Rational; 3]; 3]) -> bool {
    let minor = |i: usize, k: usize| &m[i][i] * &m[k][k] - &m[i][k] * &m[k][i];
    let det = &m[0][0] * minor(1, 2) - &m[0][1] * (&m[1][0] * &m[2][2] - &m[1][2] * &m[2][0])
        + &m[0][2] * (&m[1][0] * &m[2][1] - &m[1][1] * &m[2][0]);
    let diagonal = (0..3).map(|i| m[i][i].clone());
    let minors = [minor(0, 1), minor(0, 2), minor(1, 2), det];
    diagonal.chain(minors).all(|minor| !minor.is_negative())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn defect(entries: [i64; 6], mass: i64) -> Option<Defect> {
        let tensor = Inertia::of(entries.map(|e| Rational::from_integer(e.into())));
        tensor.defect(&Rational::from_integer(mass.into()))
    }

    #[test]
    fn bodies() {
        for good in [
            [0; 6],
            [0, 1, 1, 0, 0, 0],
            [1, 1, 2, 0, 0, 0],
            // A thin rod along (1, 1, 0): the border off the axes.
            [1, 1, 2, -1, 0, 0],
        ] {
            assert_eq!(defect(good, 1), None, "{good:?}");
        }
    }

    #[test]
    fn no_bodies() {
        let cases = [
            ([-1, 1, 1, 0, 0, 0], 1, Defect::NegativeMoment),
            // Positive leading minors 1, 0, 0 but a moment of −1.
            ([0, 1, 1, 1, 0, 0], 1, Defect::NegativeMoment),
            ([1, 1, 3, 0, 0, 0], 1, Defect::Triangle),
            // Moments 1 ± 1/2·…: the diagonal alone would pass.
            ([10, 10, 10, 6, 0, 0], 1, Defect::Triangle),
            ([1, 1, 1, 0, 0, 0], 0, Defect::Massless),
        ];
        for (entries, mass, expected) in cases {
            assert_eq!(defect(entries, mass), Some(expected), "{entries:?}");
        }
    }
}
