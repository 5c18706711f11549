//! The entropic distance of bodies and drives from those of the robot file, with the rows
//! that it adds to a step of Newton's method.

use dalembert_model::number::Rounded;

use super::Unknown;
use super::body::{Pseudo, moments, of_joint, unit};
use crate::dense::cholesky;
use crate::model::Model;

pub(super) struct Barrier {
    /// L of each link's J = L Lᵀ in the robot file, or of a body near it.
    links: Vec<(Pseudo, Pseudo)>,
    /// E_a of each of a link's ten parameters.
    units: [Pseudo; 10],
    drives: Vec<Drive>,
    count: usize,
}

enum Drive {
    /// Positive, at a place of θ, with what it is in the file.
    Positive(usize, f64),
    /// A number of either sign, with its typical size.
    Free(usize, f64),
}

impl Barrier {
    pub(super) fn new(model: &Model, unknowns: &[Unknown], noise: &[f64]) -> Barrier {
        let robot = model.robot();
        let noise = &noise[robot.base_coordinates()..];
        let drives = unknowns.iter().enumerate().filter_map(|(at, unknown)| {
            let (joint, file, per) = match *unknown {
                Unknown::Body(..) => return None,
                Unknown::Offset(joint) => return Some(Drive::Free(at, noise[joint])),
                Unknown::Coulomb(joint) => (joint, &robot.joints[joint].coulomb, 1.0),
                Unknown::Viscous(joint) => {
                    let limit = model.limits()[joint].velocity;
                    (joint, &robot.joints[joint].viscous, limit)
                }
                Unknown::Armature(joint) => {
                    let limit = model.limits()[joint].acceleration;
                    (joint, &robot.joints[joint].armature, limit)
                }
            };
            // A number that the file takes for zero may be as much as noise hides.
            let file = f64::nearest_rational(file).max(noise[joint] / per);
            Some(Drive::Positive(at, file))
        });
        Barrier {
            links: robot.bodies().map(|body| of_joint(&body)).collect(),
            units: core::array::from_fn(unit),
            drives: drives.collect(),
            count: unknowns.len(),
        }
    }

    pub(super) fn start(&self) -> Vec<f64> {
        let mut theta = vec![0.0; self.count];
        for (i, (j, _)) in self.links.iter().enumerate() {
            theta[10 * i..10 * i + 10].copy_from_slice(&moments(j));
        }
        for drive in &self.drives {
            if let Drive::Positive(at, file) = *drive {
                theta[at] = file;
            }
        }
        theta
    }

    pub(super) fn stopped(&self, theta: &[f64], part: f64) -> Vec<usize> {
        let places = self.drives.iter().filter_map(|drive| match *drive {
            Drive::Positive(at, file) => (theta[at] < part * file).then_some(at),
            Drive::Free(..) => None,
        });
        places.collect()
    }

    pub(super) fn value(&self, theta: &[f64]) -> Option<f64> {
        let mut total = 0.0;
        for (i, (_, file)) in self.links.iter().enumerate() {
            let l = cholesky(&self.pseudo(theta, i))?;
            let quotient = solve(file, &l);
            for (k, row) in quotient.iter().enumerate() {
                total -= 2.0 * libm::log(row[k]);
                total += row.iter().map(|x| x * x).sum::<f64>();
            }
        }
        for drive in &self.drives {
            total += match *drive {
                Drive::Free(at, size) => 0.5 * (theta[at] / size).powi(2),
                Drive::Positive(at, _) if theta[at].is_nan() || theta[at] <= 0.0 => return None,
                Drive::Positive(at, file) => theta[at] / file - libm::log(theta[at] / file),
            };
        }
        total.is_finite().then_some(total)
    }

    /// Computes G and, last, c of ½ ‖G d − c‖², which is the distance to second order.
    pub(super) fn rows(&self, theta: &[f64]) -> Option<Vec<Vec<f64>>> {
        let mut rows = Vec::with_capacity(self.count);
        for (i, (_, file)) in self.links.iter().enumerate() {
            let l = cholesky(&self.pseudo(theta, i))?;
            // L⁻¹ E L⁻ᵀ
            let half = self.units.map(|unit| transposed(&solve(&l, &unit)));
            let columns = half.map(|half| solve(&l, &half));
            let quotient = solve(file, &l);
            for row in 0..4 {
                for column in 0..=row {
                    // Both of two entries that are equal.
                    let twice = if row == column { 1.0 } else { libm::sqrt(2.0) };
                    let products = (0..4).map(|k| quotient[k][row] * quotient[k][column]);
                    let residual = f64::from(u8::from(row == column)) - products.sum::<f64>();
                    let mut entries = vec![0.0; self.count + 1];
                    for (k, unit) in columns.iter().enumerate() {
                        entries[10 * i + k] = twice * unit[row][column];
                    }
                    entries[self.count] = twice * residual;
                    rows.push(entries);
                }
            }
        }
        for drive in &self.drives {
            let mut entries = vec![0.0; self.count + 1];
            match *drive {
                Drive::Free(at, size) => {
                    entries[at] = 1.0 / size;
                    entries[self.count] = -theta[at] / size;
                }
                Drive::Positive(at, file) => {
                    entries[at] = 1.0 / theta[at];
                    entries[self.count] = 1.0 - theta[at] / file;
                }
            }
            rows.push(entries);
        }
        Some(rows)
    }

    fn pseudo(&self, theta: &[f64], link: usize) -> Pseudo {
        let moments = &theta[10 * link..10 * link + 10];
        let mut sum = [[0.0; 4]; 4];
        for (unit, value) in self.units.iter().zip(moments) {
            for (sum, unit) in sum.iter_mut().flatten().zip(unit.iter().flatten()) {
                *sum += value * unit;
            }
        }
        sum
    }
}

fn solve(l: &Pseudo, b: &Pseudo) -> Pseudo {
    let mut x = *b;
    for (i, row) in l.iter().enumerate() {
        let (known, rest) = x.split_at_mut(i);
        for (column, entry) in rest[0].iter_mut().enumerate() {
            let known: f64 = row.iter().zip(&*known).map(|(l, x)| l * x[column]).sum();
            *entry = (*entry - known) / row[i];
        }
    }
    x
}

fn transposed(a: &Pseudo) -> Pseudo {
    core::array::from_fn(|i| core::array::from_fn(|k| a[k][i]))
}
