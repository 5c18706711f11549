//! Joints that follow others along a line, by the chain rule.
//!
//! With c the positions of the joints that move by themselves, q = S c + o, q̇ = S ċ and
//! q̈ = S c̈, S constant. The work τᵀ q̇ is that of Sᵀ τ at ċ, so loads add up at the
//! leaders: τ_c = Sᵀ τ, D_c = Sᵀ D S, h_c over all three axes, J_c = J S; derivatives by
//! position or velocity follow on their second axis.
//!
//! Formulas are of all joints of the table. Their results are *gathered* at the leaders,
//! whose entries then have all; those of followers mean nothing. A formula that divides by D gathers
//! it first, and leaves zero at followers, so that gathering changes nothing any more.

use alloc::vec::Vec;

use super::matrix::{Matrix, plus, sums, times};
use crate::number::Exact;
use crate::robot::Robot;
use crate::scalar::Scalar;

/// A joint that follows another.
#[derive(Clone, Debug)]
pub struct FollowerLine<S> {
    /// Its row, zero-based.
    pub row: usize,
    /// The row of its leader, which follows none.
    pub leader: usize,
    /// Its motion for a unit of the leader's.
    pub multiplier: S,
    /// The multiple of a joint that turns, as a whole number.
    pub turns: i32,
}

impl<S> FollowerLine<S> {
    /// Returns those of a robot, as rows of its [`Arm`](super::Arm), multipliers sent through `scalar`.
    pub fn of(robot: &Robot, scalar: &mut dyn FnMut(&Exact) -> S) -> Vec<FollowerLine<S>> {
        let followers = robot.followers.iter();
        let following = followers.map(|follower| FollowerLine {
            row: robot.base_coordinates() + follower.row,
            leader: robot.base_coordinates() + robot.row_of(follower.leader),
            multiplier: scalar(&Exact::from(follower.multiplier.clone())),
            turns: follower.turns(),
        });
        following.collect()
    }

    /// Returns the multiplier through `f`.
    pub fn map<T>(&self, f: impl FnOnce(&S) -> T) -> FollowerLine<T> {
        FollowerLine {
            row: self.row,
            leader: self.leader,
            multiplier: f(&self.multiplier),
            turns: self.turns,
        }
    }
}

impl<S: Clone> FollowerLine<S> {
    /// Returns the follower among these rows alone, by their places there; none if it is not one.
    pub fn among(&self, rows: &[usize]) -> Option<FollowerLine<S>> {
        let place = |row: usize| rows.iter().position(|candidate| *candidate == row);
        Some(FollowerLine {
            row: place(self.row)?,
            leader: place(self.leader)?,
            ..self.clone()
        })
    }
}

impl<S: Scalar> FollowerLine<S> {
    /// Returns its motion, from that of its leader.
    pub fn motion(&self, leader: &S) -> S {
        times(&self.multiplier, leader)
    }
}

/// Adds loads of followers to their leaders', along an axis over these rows, of this stride.
pub fn gather<S: Scalar>(
    following: &[FollowerLine<S>],
    rows: &[usize],
    stride: usize,
    values: &mut [S],
) {
    let lines = following.iter().filter_map(|line| line.among(rows));
    let among_rows: Vec<FollowerLine<S>> = lines.collect();
    for block in values.chunks_mut((rows.len() * stride).max(1)) {
        for line in &among_rows {
            for i in 0..stride {
                let part = line.motion(&block[line.row * stride + i]);
                let sum = &mut block[line.leader * stride + i];
                *sum = plus(sum, &part);
            }
        }
    }
}

/// Returns Sᵀ b
pub fn gathered<S: Scalar>(following: &[FollowerLine<S>], mut loads: Vec<S>) -> Vec<S> {
    for line in following {
        let part = line.motion(&loads[line.row]);
        loads[line.leader] = plus(&loads[line.leader], &part);
    }
    loads
}

/// Returns M S
pub fn gathered_rows<S: Scalar>(following: &[FollowerLine<S>], rows: Matrix<S>) -> Matrix<S> {
    let rows = rows.into_iter();
    rows.map(|row| gathered(following, row)).collect()
}

/// Returns Sᵀ M
pub fn gathered_columns<S: Scalar>(following: &[FollowerLine<S>], mut m: Matrix<S>) -> Matrix<S> {
    for line in following {
        let part: Vec<S> = m[line.row].iter().map(|x| line.motion(x)).collect();
        m[line.leader] = sums(&m[line.leader], &part);
    }
    m
}

/// Returns Sᵀ D S, symmetric.
pub fn gathered_square<S: Scalar>(following: &[FollowerLine<S>], d: Matrix<S>) -> Matrix<S> {
    gathered_columns(following, gathered_rows(following, d))
}

/// Returns S ċ, from rates whose entries of followers mean nothing.
pub fn spread<S: Scalar>(following: &[FollowerLine<S>], mut rates: Vec<S>) -> Vec<S> {
    for line in following {
        rates[line.row] = line.motion(&rates[line.leader]);
    }
    rates
}
