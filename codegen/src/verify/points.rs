//! Points of the field at which proofs evaluate, drawn from the statement that is proved.
//!
//! The SHA-256 of a statement (robot, scene, programs) is the seed of its points, so that another
//! digit of the statement gives other points, and the statement gives its own on every machine.
//!
//! A proof also bounds degrees. Two values differ by a polynomial of degree k over a product of
//! divisors, which do not vanish where both have values. With each of m pairs a rational function
//! of one parameter, (2t, 1 − t²)/(1 + t²), that polynomial becomes one of degree at most
//! (2m + 1)·k in the parameters that are drawn.

use std::cell::RefCell;

use dalembert_model::equations::SinCosPair;
use dalembert_model::number::{Angle, Exact};
use dalembert_model::outputs::RuntimeParameter;
use dalembert_model::robot::write as write_robot;
use dalembert_model::scalar::Scalar;
use dalembert_model::scalar::field::ProofField;
use dalembert_model::scalar::sparse::Sparse;
use dalembert_model::scene::write as write_scene;
use hmac_sha256::Hash;

use super::exact::Disproof;
use crate::dag::{Leaves, Points};
use crate::program::Input;
use crate::scalar::degree::Degree;
use crate::setup::Setup;

pub(super) const POINTS: usize = 4;

/// A wrong program passes with a probability below 2 to the power of minus this, 1e-36.
const CERTAINTY: u32 = 120;

/// A difference of degree k vanishes at a point with a probability of at most k/2^POINT.
const POINT: u32 = 60;

/// So many points are drawn for each that has to have values, before a statement is given up.
const DRAWS: usize = 4;

/// A residue modulo 2⁶¹ − 465. The search has another prime: what it takes for equal by chance, or
/// because its prime divides a difference, is not equal here.
pub(super) type Residue = Sparse<ProofField>;

#[derive(Clone, Copy, Debug)]
pub(super) struct Point {
    points: Points,
    index: usize,
}

pub(super) fn points(statement: &[&str], count: usize) -> impl Iterator<Item = Point> {
    let mut hash = Hash::new();
    for text in statement {
        hash.update((text.len() as u64).to_le_bytes());
        hash.update(text.as_bytes());
    }
    let bytes = hash.finalize().into_iter().take(8);
    let points = Points::new(bytes.fold(0, |seed, byte| (seed << 8) | u64::from(byte)));
    (0..DRAWS * count).map(move |index| Point { points, index })
}

pub(super) fn written(setup: &Setup) -> String {
    let has = |parameters: [RuntimeParameter; 2]| parameters.map(|parameter| setup.has(parameter));
    let taken = has([RuntimeParameter::Payload, RuntimeParameter::Gravity]);
    let drives = has([RuntimeParameter::Armature, RuntimeParameter::Viscous]);
    let (robot, rows) = (write_robot(setup.robot()), setup.rows());
    let scene = setup.scene().map(write_scene).unwrap_or_default();
    let mut text = format!("{robot}\n{scene}\n{rows:?}\n{taken:?}");
    if setup.has(RuntimeParameter::Bodies) || drives.contains(&true) {
        let (links, zeros) = (setup.body_links(), setup.zeros());
        text += &format!("\n{links:?}\n{zeros:?}\n{drives:?}");
    }
    text
}

impl Leaves for Point {
    type Value = Residue;

    fn input(&self, input: Input) -> Residue {
        Sparse::Value(self.points.input_at(input, self.index))
    }

    /// Lost where 2⁶¹ − 465 divides a coefficient or a denominator.
    fn constant(&self, constant: &Exact) -> Residue {
        match self.points.constant_at(constant, self.index) {
            Some(value) if !Points::lose::<{ ProofField::P }>(constant) => {
                Sparse::constant(constant, value)
            }
            _ => Sparse::Lost,
        }
    }
}

pub(super) fn integers(values: &[Residue]) -> Option<Vec<ProofField>> {
    values.iter().map(Sparse::value).collect()
}

/// A larger degree would take more than ten points.
const MAX_DEGREE: f64 = (1u64 << 48) as f64;

#[derive(Debug, Default)]
pub(super) struct Degrees(RefCell<Vec<Angle>>);

impl Degrees {
    /// Returns the number of points that decide whether values differ: four up to a degree of 2³⁰
    /// in the drawn parameters.
    pub(super) fn points(
        &self,
        outputs: &[Sparse<Degree>],
        others: &[Sparse<Degree>],
        joints: usize,
    ) -> Result<usize, Disproof> {
        let pairs = joints + self.0.borrow().len();
        let mut largest = 1.0f64;
        for (a, b) in outputs.iter().zip(others) {
            let degree = a.add(b).value().ok_or(Disproof::Large)?;
            let degree = (2 * pairs + 1) as f64 * degree.top;
            // Infinities of both signs make no number, which is not small.
            let is_small = degree <= MAX_DEGREE;
            is_small.then_some(()).ok_or(Disproof::Large)?;
            largest = largest.max(degree);
        }
        let bits = (largest.ceil() as u64).next_power_of_two().trailing_zeros();
        Ok(POINTS.max(CERTAINTY.div_ceil(POINT - bits) as usize))
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
            let [sin, cos] = [1.0; 2].map(Degree::new);
            SinCosPair { sin, cos }
        };
        let degree = constant.map(&mut |_| Some(Degree::new(0.0)), pair);
        Sparse::constant(constant, degree.unwrap_or_default())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_high_degree_takes_more_points_until_it_is_refused() {
        let points = |exponent: i32| {
            // One joint: three times as many in the drawn parameters.
            let degree = Degree::new(2f64.powi(exponent) / 3.0);
            Degrees::default().points(&[Sparse::Value(degree)], &[Scalar::zero()], 1)
        };
        for (count, exponents) in [(4, [1, 30]), (5, [31, 36]), (6, [37, 40]), (10, [47, 48])] {
            for exponent in exponents {
                assert_eq!(points(exponent), Ok(count), "2^{exponent}");
            }
        }
        for exponent in [49, 2000] {
            assert_eq!(points(exponent), Err(Disproof::Large), "2^{exponent}");
        }
    }
}
