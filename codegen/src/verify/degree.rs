//! Bounds the degree of the difference of two formulas.
//!
//! Two values differ by a polynomial of degree k over a product of divisors, which do not vanish
//! where both have values. With each of m pairs a rational function of one parameter,
//! (2t, 1 − t²)/(1 + t²), that polynomial becomes one of degree at most (2m + 1)·k in the parameters
//! that are drawn.

use std::cell::RefCell;

use dalembert_model::equations::SinCosPair;
use dalembert_model::number::{Angle, Exact};
use dalembert_model::scalar::Scalar;
use dalembert_model::scalar::sparse::Sparse;

use super::exact::Disproof;
use crate::dag::Leaves;
use crate::program::Input;
use crate::scalar::degree::Degree;

/// The largest degree for which a miss is as unlikely as is said.
const MAX_DEGREE: f64 = (1u64 << 30) as f64;

#[derive(Debug, Default)]
pub(super) struct Degrees(RefCell<Vec<Angle>>);

impl Degrees {
    /// A large degree of a difference in the drawn parameters makes a miss too likely.
    pub(super) fn bound(
        &self,
        own: &[Sparse<Degree>],
        others: &[Sparse<Degree>],
        joints: usize,
    ) -> Result<(), Disproof> {
        let pairs = joints + self.0.borrow().len();
        // Infinities of both signs make no number, which is not small.
        let is_small = |degree: Degree| (2 * pairs + 1) as f64 * degree.top <= MAX_DEGREE;
        let mut differences = own.iter().zip(others).map(|(a, b)| a.add(b).value());
        match differences.all(|degree| degree.is_some_and(is_small)) {
            true => Ok(()),
            false => Err(Disproof::Large),
        }
    }
}

impl Leaves for Degrees {
    type Value = Sparse<Degree>;

    fn input(&self, _: Input) -> Sparse<Degree> {
        Sparse::Value(Degree::new(1.0))
    }

    fn constant(&self, constant: &Exact) -> Sparse<Degree> {
        let pair = &mut |angle: &Angle| {
            let mut known = self.0.borrow_mut();
            if !known.contains(angle) {
                known.push(angle.clone());
            }
            SinCosPair {
                sin: Degree::new(1.0),
                cos: Degree::new(1.0),
            }
        };
        let degree = constant.map(&mut |_| Some(Degree::new(0.0)), pair);
        Sparse::constant(constant, degree.unwrap_or_default())
    }
}
