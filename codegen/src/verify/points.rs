//! Points of the field at which proofs evaluate, drawn from the statement that is proved.
//!
//! The SHA-256 of a statement (robot, scene, programs) is the seed of its points, so that another
//! digit of the statement gives other points, and the statement gives its own on every machine.

use dalembert_model::number::Exact;
use dalembert_model::outputs::RuntimeParameter;
use dalembert_model::robot::write as write_robot;
use dalembert_model::scalar::field::ProofField;
use dalembert_model::scalar::sparse::Sparse;
use dalembert_model::scene::write as write_scene;
use hmac_sha256::Hash;

use crate::dag::{Leaves, Points};
use crate::program::Input;
use crate::setup::Setup;

pub(super) const POINTS: usize = 4;

/// The number of points drawn before a statement is given up because values are missing.
const MAX_DRAWS: usize = 16;

/// A residue modulo 2⁶¹ − 45. The search has another prime: what it takes for equal by chance, or
/// because its prime divides a difference, is not equal here.
pub(super) type Residue = Sparse<ProofField>;

#[derive(Clone, Copy, Debug)]
pub(super) struct Point {
    points: Points,
    index: usize,
}

pub(super) fn points(statement: &[&str]) -> impl Iterator<Item = Point> {
    let mut hash = Hash::new();
    for text in statement {
        hash.update((text.len() as u64).to_le_bytes());
        hash.update(text.as_bytes());
    }
    let hash = hash.finalize();
    let bytes = hash.iter().take(8);
    let seed = bytes.fold(0, |seed, &byte| (seed << 8) | u64::from(byte));
    let points = Points::new(seed);
    (0..MAX_DRAWS).map(move |index| Point { points, index })
}

pub(super) fn written(setup: &Setup) -> String {
    format!(
        "{}\n{}\n{:?}\n{:?}",
        write_robot(setup.robot()),
        setup.scene().map(write_scene).unwrap_or_default(),
        setup.rows(),
        RuntimeParameter::ALL.map(|parameter| setup.has(parameter)),
    )
}

impl Leaves for Point {
    type Value = Residue;

    fn input(&self, input: Input) -> Residue {
        Sparse::Value(self.points.input_at(input, self.index))
    }

    /// Lost where 2⁶¹ − 45 divides a coefficient or a denominator.
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
