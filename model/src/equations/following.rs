//! Joints that follow others along a line, by the chain rule.
//!
//! With c the positions of the joints that move by themselves, q = S c + o, q̇ = S ċ and
//! q̈ = S c̈, S constant. The work τᵀ q̇ is that of Sᵀ τ at ċ, so loads add up at the
//! leaders: τ_c = Sᵀ τ, D_c = Sᵀ D S, h_c over all three axes, J_c = J S; derivatives by
//! position or velocity follow on their second axis.
//!
//! Formulas are of all joints of the table. What they give is *gathered* at the leaders,
//! whose entries then have all; those of followers mean nothing. What divides by D gathers
//! it first, and leaves zero at followers, so that gathering changes nothing any more.

use alloc::vec::Vec;

use super::matrix::{plus, times};
use super::{Arm, DhVariables, Formulation, JointPosition};
use crate::number::Exact;
use crate::robot::Robot;
use crate::scalar::Scalar;

/// A joint that follows another.
#[derive(Clone, Debug)]
pub struct Following<S> {
    /// Its row, zero-based.
    pub row: usize,
    /// The row of its leader, which follows none.
    pub leader: usize,
    /// Its motion for a unit of the leader's.
    pub multiplier: S,
    /// The same of a joint that turns, as a whole number.
    pub turns: i32,
}

impl<S> Following<S> {
    /// Those of a robot, multipliers sent through `scalar`.
    pub fn of(robot: &Robot, scalar: &mut impl FnMut(&Exact) -> S) -> Vec<Following<S>> {
        let followers = robot.followers.iter();
        let following = followers.map(|follower| Following {
            row: follower.row,
            leader: robot.row_of(follower.leader),
            multiplier: scalar(&Exact::from(follower.multiplier.clone())),
            turns: follower.turns(),
        });
        following.collect()
    }

    /// The multiplier through `f`.
    pub fn map<T>(&self, f: impl FnOnce(&S) -> T) -> Following<T> {
        Following {
            row: self.row,
            leader: self.leader,
            multiplier: f(&self.multiplier),
            turns: self.turns,
        }
    }
}

impl<S: Scalar> Following<S> {
    /// Where the joint is, but for its offset, which is its row's.
    pub fn position(&self, leader: &JointPosition<S>) -> JointPosition<S> {
        match leader {
            JointPosition::Prismatic(q) => JointPosition::Prismatic(times(&self.multiplier, q)),
            JointPosition::Revolute(pair) => {
                let mut turned = pair.clone();
                for _ in 1..self.turns.unsigned_abs() {
                    turned = turned.compose(pair);
                }
                if self.turns < 0 {
                    turned.sin = turned.sin.neg();
                }
                JointPosition::Revolute(turned)
            }
        }
    }

    /// Its motion, from that of its leader.
    pub fn motion(&self, leader: &S) -> S {
        times(&self.multiplier, leader)
    }
}

/// Adds the loads of followers to those of their leaders, along an axis of an array whose
/// neighbours are `stride` apart, over these rows.
pub fn gather<S: Scalar>(
    following: &[Following<S>],
    rows: &[usize],
    stride: usize,
    values: &mut [S],
) {
    let place = |row: usize| rows.iter().position(|own| *own == row);
    for block in values.chunks_mut((rows.len() * stride).max(1)) {
        for own in following {
            let Some((from, to)) = place(own.row).zip(place(own.leader)) else {
                continue;
            };
            for i in 0..stride {
                let part = own.motion(&block[from * stride + i]);
                block[to * stride + i] = plus(&block[to * stride + i], &part);
            }
        }
    }
}

impl<S: Scalar> Arm<S> {
    /// Sᵀ b
    pub fn gathered(&self, mut loads: Vec<S>) -> Vec<S> {
        for own in &self.following {
            let part = own.motion(&loads[own.row]);
            loads[own.leader] = plus(&loads[own.leader], &part);
        }
        loads
    }

    /// M S
    pub fn gathered_rows(&self, rows: Vec<Vec<S>>) -> Vec<Vec<S>> {
        rows.into_iter().map(|row| self.gathered(row)).collect()
    }

    /// Sᵀ M
    pub fn gathered_columns(&self, mut rows: Vec<Vec<S>>) -> Vec<Vec<S>> {
        for own in &self.following {
            let part = rows[own.row].iter().map(|x| own.motion(x));
            let part: Vec<S> = part.collect();
            for (entry, part) in rows[own.leader].iter_mut().zip(&part) {
                *entry = plus(entry, part);
            }
        }
        rows
    }

    /// S ċ, from rates whose entries of followers mean nothing.
    pub fn spread(&self, mut rates: Vec<S>) -> Vec<S> {
        for own in &self.following {
            rates[own.row] = own.motion(&rates[own.leader]);
        }
        rates
    }
}

impl Formulation {
    /// Sᵀ D S, n×n.
    pub fn gathered_inertia<S: Scalar>(self, arm: &Arm<S>, at: &[DhVariables<S>]) -> Vec<Vec<S>> {
        arm.gathered_columns(arm.gathered_rows(self.inertia(arm, at)))
    }
}
