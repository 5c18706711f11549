//! The columns of a model, and a hash of them.

use dalembert_model::number::{Exact, Rational, Rounded};
use dalembert_model::robot::{FloatingBase, Robot};
use num_traits::{One, Zero};

use super::{Column, Model, without_rotors};
use crate::dense::norms;
use crate::random::Random;
use crate::triangle::Triangle;

impl Model {
    /// Finds the columns that are zero in a row whatever the state is, and drops offsets that
    /// depend on other columns, by random states within limits twice as wide.
    pub(super) fn drop_columns(&mut self) {
        let (n, width) = (self.coordinates(), self.columns.len());
        let mut random = Random::new(0x6669_7400);
        let mut largest = vec![0.0f64; n * width];
        let mut triangle = Triangle::new(width);
        for _ in 0..2 * width + 8 {
            let [q, qd, qdd] = self.state(2.0, &mut random);
            let Ok(y) = self.regressor(&q, &qd, &qdd) else {
                continue;
            };
            for (largest, y) in largest.iter_mut().zip(&y) {
                *largest = largest.max(y.abs());
            }
            for row in y.chunks(width) {
                triangle.push(row.iter().copied());
            }
        }
        let r = triangle.reduced();
        let norms = norms(&r, width);
        let independent = |column: usize| r[column * width + column] > 1e-9 * norms[column];
        let mut kept: Vec<usize> = (0..width).collect();
        kept.retain(|k| !matches!(self.columns[*k], Column::Offset(_)) || independent(*k));
        self.columns = kept.iter().map(|k| self.columns[*k]).collect();
        let scale = |k: usize| (0..n).fold(0.0f64, |max, i| max.max(largest[i * width + k]));
        for (i, row) in self.rows.iter_mut().enumerate() {
            // An entry that is only rounding next to the column's largest is zero.
            let columns = kept.iter().enumerate();
            let felt = columns.filter(|(_, k)| largest[i * width + **k] > 1e-12 * scale(**k));
            *row = felt.map(|(new, _)| new).collect();
        }
    }

    pub(super) fn values(&self, base: &[Exact]) -> Vec<f64> {
        let value = |column: &Column| match *column {
            Column::Base(k) => f64::nearest(&base[k]),
            Column::Coulomb(joint) => f64::nearest_rational(&self.robot.joints[joint].coulomb),
            Column::Offset(_) => 0.0,
        };
        self.columns.iter().map(value).collect()
    }

    /// Returns the hash of the robot without what is identified, with what decides the columns.
    pub(super) fn hashed(&self) -> [u8; 32] {
        let mut bare = candidates(&self.robot, self.rotors);
        let (rotors, count) = (self.rotors, self.columns.len());
        // The parameters that are identified, in the words of the bytes that there are.
        bare.name = format!(
            "Options {{ armature: {rotors}, viscous: true, coulomb: true, offset: true, \
             coulomb_width: 0.01 }} {:?} {count}",
            self.widths
        );
        for joint in &mut bare.joints {
            joint.name = None;
            joint.limits = Default::default();
            joint.mass = Rational::zero();
            joint.com = Default::default();
            joint.inertia = joint.inertia.map(|_| Rational::zero());
        }
        if let Some(base) = &mut bare.floating {
            *base = FloatingBase::default();
        }
        bare.input_hash()
    }
}

/// Coulomb friction is not a base parameter.
pub(super) fn candidates(robot: &Robot, rotors: bool) -> Robot {
    let mut robot = without_rotors(robot);
    for joint in &mut robot.joints {
        joint.coulomb = Rational::zero();
        joint.viscous = Rational::one();
        if rotors {
            joint.armature = Rational::one();
        }
    }
    robot
}
