//! Combinations of parameters that data do not tell, and a motion that would.

use std::fmt;

use crate::dense::{apply, dot};
use crate::error::Error;
use crate::model::{Model, sum};
use crate::random::Random;
use crate::reference::Reference;

/// A motion gives at least so much of the reference motion's torque to tell a combination.
const ENOUGH: f64 = 0.3;
/// Less than so much is rounding.
const NOTHING: f64 = 1e-6;

/// A combination of parameters that the data do not excite.
#[derive(Clone, Debug, PartialEq)]
pub struct UnexcitedDirection {
    /// Columns of the model with their factors, from the largest contribution down to a hundredth.
    pub combination: Vec<(usize, f64)>,
    /// The parameter in words.
    pub name: String,
    /// Torque in the data per torque in the reference motion.
    pub excitation: f64,
    /// A motion that would excite it.
    pub motion: Motion,
}

/// A simple motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Motion {
    /// Standing in different poses.
    Poses,
    /// Accelerating a joint from rest, in different poses.
    Accelerate(usize),
    /// Turning or sliding a joint at different velocities, in different poses.
    Move(usize),
    /// Moving two joints at once.
    Together(usize, usize),
    /// Moving and turning a base that floats, in different poses.
    Base,
    /// All joints moving and accelerating.
    All,
    /// No motion within the limits.
    None,
}

impl fmt::Display for Motion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Motion::Poses => f.write_str("hold the arm still in many different poses"),
            Motion::Accelerate(joint) => {
                let joint = joint + 1;
                write!(f, "accelerate joint {joint} from rest, in different poses")
            }
            Motion::Move(joint) => {
                let joint = joint + 1;
                let how = "at different velocities, in different poses";
                write!(f, "move joint {joint} {how}")
            }
            Motion::Together(one, other) => {
                let (one, other) = (one + 1, other + 1);
                write!(f, "move joints {one} and {other} at the same time, fast")
            }
            Motion::Base => f.write_str("move and turn the base, in different poses"),
            Motion::All => f.write_str("move all joints at the same time, fast"),
            Motion::None => f.write_str("no motion within the joints' limits identifies it"),
        }
    }
}

impl fmt::Display for UnexcitedDirection {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{}: {:.1e} of the torque that it gives in random motion; {}",
            self.name, self.excitation, self.motion
        )
    }
}

/// Brings directions into echelon form: each has a parameter that no other has, so that as few
/// as possible stand in each. Sizes are compared after multiplication by `norms`.
pub(crate) fn separated(mut directions: Vec<Vec<f64>>, norms: &[f64]) -> Vec<Vec<f64>> {
    for done in 0..directions.len() {
        let mut pivot = (done, 0, 0.0);
        for (i, direction) in directions.iter().enumerate().skip(done) {
            for (k, x) in direction.iter().enumerate() {
                let size = (x * norms[k]).abs();
                if size > pivot.2 {
                    pivot = (i, k, size);
                }
            }
        }
        let (row, column, _) = pivot;
        directions.swap(done, row);
        let pivot_row = directions[done].clone();
        for (i, direction) in directions.iter_mut().enumerate() {
            if i != done && pivot_row[column] != 0.0 {
                let factor = direction[column] / pivot_row[column];
                for (x, entry) in direction.iter_mut().zip(&pivot_row) {
                    *x -= factor * entry;
                }
                direction[column] = 0.0;
            }
        }
    }
    directions
}

pub(crate) struct Weights<'a> {
    pub(crate) model: &'a Model,
    pub(crate) noise: &'a [f64],
    pub(crate) reference: &'a Reference,
}

impl Weights<'_> {
    pub(crate) fn describe(
        &self,
        directions: &[Vec<f64>],
        r: &[f64],
        root: f64,
    ) -> Result<Vec<UnexcitedDirection>, Error> {
        let norm = |r: &[f64], direction: &[f64]| -> f64 {
            let image = apply(r, direction);
            libm::sqrt(dot(&image, &image))
        };
        let unit = |direction: &Vec<f64>| norm(&self.reference.r, direction);
        let units: Vec<f64> = directions.iter().map(unit).collect();
        let motions = self.motions(directions, &units)?;
        let parts = directions.iter().zip(units).zip(motions);
        let descriptions = parts.map(|((direction, unit), motion)| {
            let combination = self.leading(direction);
            UnexcitedDirection {
                name: named(self.model, &combination),
                motion,
                combination,
                excitation: norm(r, direction) / (root * unit),
            }
        });
        Ok(descriptions.collect())
    }

    fn leading(&self, direction: &[f64]) -> Vec<(usize, f64)> {
        let size = |column: usize| (direction[column] * self.reference.norms[column]).abs();
        let mut columns: Vec<usize> = (0..direction.len()).collect();
        columns.sort_by(|a, b| size(*b).total_cmp(&size(*a)).then(a.cmp(b)));
        let largest = columns.first().map_or(0.0, |k| size(*k));
        columns.retain(|k| size(*k) >= 0.01 * largest);
        let unit = columns.first().map_or(1.0, |k| direction[*k]);
        columns.iter().map(|k| (*k, direction[*k] / unit)).collect()
    }

    /// Simple motions come first; where all give too little torque, the one with most is taken.
    fn motions(&self, directions: &[Vec<f64>], units: &[f64]) -> Result<Vec<Motion>, Error> {
        let n = self.model.joints();
        let mut motions = vec![Motion::Poses];
        let floats = self.model.robot().floating.is_some();
        motions.extend(floats.then_some(Motion::Base));
        motions.extend((0..n).map(Motion::Move));
        motions.extend((0..n).map(Motion::Accelerate));
        for other in 1..n {
            motions.extend((0..other).map(|one| Motion::Together(one, other)));
        }
        motions.push(Motion::All);
        let mut best = vec![(Motion::None, NOTHING); directions.len()];
        for motion in motions {
            if best.iter().all(|(_, torque)| *torque >= ENOUGH) {
                break;
            }
            let torques = self.torques(directions, motion)?;
            for ((best, torque), unit) in best.iter_mut().zip(torques).zip(units) {
                if best.1 < ENOUGH && torque / unit > best.1 {
                    *best = (motion, torque / unit);
                }
            }
        }
        Ok(best.into_iter().map(|(motion, _)| motion).collect())
    }

    fn torques(&self, directions: &[Vec<f64>], motion: Motion) -> Result<Vec<f64>, Error> {
        const STATES: usize = 24;
        let mut random = Random::new(0x6d6f_7600);
        let width = self.model.columns().len();
        let mut totals = vec![0.0; directions.len()];
        for _ in 0..STATES {
            let [q, mut qd, mut qdd] = self.model.state(1.0, &mut random);
            let base = self.model.robot().base_coordinates();
            for (i, (qd, qdd)) in qd.iter_mut().zip(&mut qdd).enumerate() {
                let is = |joint: usize| i == base + joint;
                let [moves, accelerates] = match motion {
                    Motion::Poses | Motion::None => [false, false],
                    Motion::Base => [i < base; 2],
                    Motion::Accelerate(joint) => [false, is(joint)],
                    Motion::Move(joint) => [is(joint), false],
                    Motion::Together(one, other) => [is(one) || is(other), false],
                    Motion::All => [true, true],
                };
                *qd *= f64::from(u8::from(moves));
                *qdd *= f64::from(u8::from(accelerates));
            }
            let y = self.model.regressor(&q, &qd, &qdd)?;
            for (total, direction) in totals.iter_mut().zip(directions) {
                let torques = y.chunks(width).map(|row| dot(row, direction));
                let parts = torques.zip(self.noise).map(|(x, noise)| x / noise);
                *total += parts.map(|part| part.powi(2)).sum::<f64>();
            }
        }
        let root = |total: f64| libm::sqrt(total / STATES as f64);
        Ok(totals.into_iter().map(root).collect())
    }
}

fn named(model: &Model, combination: &[(usize, f64)]) -> String {
    let term = |(column, factor): &(usize, f64)| {
        let mut name = model.name(*column);
        if name.contains(' ') {
            name = format!("({name})");
        }
        (name, *factor)
    };
    let terms: Vec<(String, f64)> = combination.iter().map(term).collect();
    sum(&terms, |x| format!("{x:.3}"))
}
