//! The regressor at a state, and its derivatives.

use dalembert_model::equations::chain::Chain;
use dalembert_model::equations::chain::composite::CompositeOrder;
use dalembert_model::equations::friction::per_speed;
use dalembert_model::equations::{JointPosition, SinCosPair};
use dalembert_model::robot::JointKind;
use dalembert_model::scalar::Scalar;
use dalembert_model::scalar::dual::Dual;

use super::{Column, Model};
use crate::error::{Error, check};

impl Model {
    /// Evaluates Y, row by row, all columns, at a state of these [`lengths`](Model::lengths).
    ///
    /// # Errors
    /// [`Error::Length`] and [`Error::Value`].
    pub fn regressor(&self, q: &[f64], qd: &[f64], qdd: &[f64]) -> Result<Vec<f64>, Error> {
        let lengths = self.lengths();
        check("q", q, lengths[0])?;
        check("qd", qd, lengths[1])?;
        check("qdd", qdd, lengths[2])?;
        let (n, base) = (self.coordinates(), self.robot.base_coordinates());
        let position: Vec<_> = (self.robot.joints.iter().zip(q))
            .map(|(joint, q)| match joint.kind {
                JointKind::Revolute => JointPosition::Revolute(pair(*q)),
                JointKind::Prismatic => JointPosition::Prismatic(*q),
            })
            .collect();
        let rows = match q.get(self.joints()..) {
            Some(&[x, y, z]) => {
                let mut chain = self.chain.clone();
                chain.gravity = [x, y, z].map(|entry| entry * chain.per_unit);
                rows(&chain, &position, qd, qdd)
            }
            _ => rows(&self.chain, &position, qd, qdd),
        };
        let mut y = Vec::with_capacity(n * self.columns.len());
        for (i, row) in rows.into_iter().enumerate() {
            y.extend(row);
            let entry = |column: &Column| match *column {
                Column::Coulomb(joint) if base + joint == i => self.coulomb(joint, &qd[i]),
                Column::Offset(joint) if base + joint == i => 1.0,
                _ => 0.0,
            };
            y.extend(self.columns[self.base()..].iter().map(entry));
        }
        Ok(y)
    }

    pub(crate) fn coulomb(&self, joint: usize, qd: &f64) -> f64 {
        let width = self.widths[joint];
        qd * per_speed(qd, &(width * width), |x| libm::sqrt(*x))
    }

    pub(crate) fn width(&self, joint: usize) -> f64 {
        self.widths[joint]
    }

    /// Differentiates `weights`·Y, row by row as Y, by every q, q̇ and q̈: 3n numbers.
    pub(crate) fn gradient(&self, [q, qd, qdd]: [&[f64]; 3], weights: &[f64]) -> Vec<f64> {
        let (n, base, width) = (self.joints(), self.base(), self.columns.len());
        let chain = self.chain.map(|x| Dual::constant(*x));
        let mut gradient = Vec::with_capacity(3 * n);
        for along in 0..3 * n {
            let rate = |of: usize| f64::from(u8::from(of == along));
            let dual = |value: f64, of: usize| Dual {
                value,
                rate: rate(of),
            };
            let position: Vec<_> = (self.robot.joints.iter().zip(q).enumerate())
                .map(|(i, (joint, q))| match joint.kind {
                    JointKind::Revolute => JointPosition::Revolute(pair(*q).turning(&rate(i))),
                    JointKind::Prismatic => JointPosition::Prismatic(dual(*q, i)),
                })
                .collect();
            let moving = |values: &[f64], first: usize| -> Vec<Dual<f64>> {
                let values = values.iter().zip(first..);
                values.map(|(value, of)| dual(*value, of)).collect()
            };
            let rows = rows(&chain, &position, &moving(qd, n), &moving(qdd, 2 * n));
            let mut total = 0.0;
            for (row, weights) in rows.iter().zip(weights.chunks(width)) {
                let products = row.iter().zip(weights).map(|(y, w)| y.rate * w);
                total += products.sum::<f64>();
            }
            if (n..2 * n).contains(&along) {
                let joint = along - n;
                let friction_width = self.widths[joint];
                let r = per_speed(&qd[joint], &(friction_width * friction_width), |x| {
                    libm::sqrt(*x)
                });
                let of = |column: &Column| *column == Column::Coulomb(joint);
                if let Some(column) = self.columns[base..].iter().position(of) {
                    let weight = weights[joint * self.columns.len() + base + column];
                    total += weight * friction_width * friction_width * r * r * r;
                }
            }
            gradient.push(total);
        }
        gradient
    }
}

fn rows<S: Scalar>(
    chain: &Chain<S>,
    position: &[JointPosition<S>],
    qd: &[S],
    qdd: &[S],
) -> Vec<Vec<S>> {
    let (chain, at) = chain.posed(position);
    chain.regressor(&at, qd, qdd, CompositeOrder::Outward)
}

fn pair(angle: f64) -> SinCosPair<f64> {
    let (sin, cos) = libm::sincos(angle);
    SinCosPair { sin, cos }
}
