//! D q̈ = τ − h − c in the rates u that links with parallel axes have against the base,
//! q̇ = T u. Differences of entries of D mostly are a number that these entries were the sum
//! of: merged by value, neither the sum nor the difference is left.

use alloc::vec::Vec;

use super::{Chain, Form, Posture};
use crate::equations::BASE_COORDINATES;
use crate::equations::factor::picked;
use crate::equations::forward::solved;
use crate::equations::matrix::*;
use crate::scalar::{Divide, Scalar};

/// A joint and the next one that moves about a parallel axis.
pub(super) struct Pair {
    pub(super) before: usize,
    pub(super) after: usize,
    opposite: bool,
}

impl Pair {
    /// Returns x ∓ y: what is left where the later joint takes the turn back.
    fn left<S: Scalar>(&self, x: &S, y: &S) -> S {
        match self.opposite {
            false => minus(x, y),
            true => plus(x, y),
        }
    }
}

/// Solves D q̈ = τ − bias over the joints that move; zero of the others.
pub(super) fn solved_in_pairs<S: Divide>(
    pairs: &[Pair],
    d: &[Vec<S>],
    [bias, tau]: [&[S]; 2],
    moves: &[bool],
) -> Vec<S> {
    let (mut d, mut bias, mut tau) = (d.to_vec(), bias.to_vec(), tau.to_vec());
    // From the base on, so that each takes the next as it was.
    for pair in pairs {
        let (a, b) = (pair.before, pair.after);
        let rows = d[a].iter().zip(&d[b]);
        d[a] = rows.map(|(x, y)| pair.left(x, y)).collect();
        bias[a] = pair.left(&bias[a], &bias[b]);
        tau[a] = pair.left(&tau[a], &tau[b]);
    }
    for pair in pairs {
        for row in &mut d {
            row[pair.before] = pair.left(&row[pair.before], &row[pair.after]);
        }
    }
    let rates = solved(&d, &bias, &tau, moves);
    let mut accelerations = rates.clone();
    for pair in pairs {
        accelerations[pair.after] = pair.left(&rates[pair.after], &rates[pair.before]);
    }
    accelerations
}

/// The unknowns that D q̈ = τ − h − c is solved for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unknowns {
    /// q̈, with factors of D that D⁻¹ has too.
    Joints,
    /// u̇ against the base, which is less work by itself.
    AgainstBase,
}

impl<S: Divide> Chain<S> {
    /// Returns q̈ of D q̈ = τ − bias over the joints that move, zero of the others; of a base that
    /// floats its turns are eliminated last if the form asks.
    pub fn accelerations(
        &self,
        d: &[Vec<S>],
        [bias, tau]: [&[S]; 2],
        moves: &[bool],
        (form, unknowns): (Form, Unknowns),
    ) -> Vec<S> {
        let pairs = match unknowns {
            Unknowns::Joints => Vec::new(),
            Unknowns::AgainstBase => self.pairs(moves),
        };
        if self.base.is_none() || !form.shoulder {
            return solved_in_pairs(&pairs, d, [bias, tau], moves);
        }
        let joints = BASE_COORDINATES..d.len();
        let order: Vec<usize> = [3, 4, 5, 0, 1, 2].into_iter().chain(joints).collect();
        let rows: Matrix<S> = order.iter().map(|&i| picked(&d[i], &order)).collect();
        let [bias, tau] = [bias, tau].map(|values| picked(values, &order));
        let moves: Vec<bool> = picked(moves, &order);
        let accelerations = solved_in_pairs(&pairs, &rows, [&bias, &tau], &moves);
        // Halves that change places twice are where they were.
        picked(&accelerations, &order)
    }

    /// Returns q̈ under τ, zero of joints that do not move, from the recursion that is shortened.
    pub fn forward_dynamics(
        &self,
        (at, d): (&Posture<S>, &[Vec<S>]),
        [qd, tau]: [&[S]; 2],
        moves: &[bool],
        form: Form,
        unknowns: Unknowns,
    ) -> Vec<S> {
        let [taken, reference] = self.reference_load(at, qd, moves, form);
        let rest = self.accelerations(d, [&taken, tau], moves, (form, unknowns));
        sums(&rest, &reference)
    }

    /// Returns τ(a) and a, the accelerations that shorten the recursion.
    pub fn reference_load(
        &self,
        at: &Posture<S>,
        qd: &[S],
        moves: &[bool],
        form: Form,
    ) -> [Vec<S>; 2] {
        let motion = self.reference_motion(at, qd, moves, form.spin);
        let reference = motion.accelerations;
        let drive = |i: usize| self.drive(i, qd, &reference);
        let taken = self.torques(at, &motion.motions, form.couple, &zero_vector(), drive);
        [taken, reference]
    }
}

impl<S: Scalar> Chain<S> {
    pub(super) fn pairs(&self, moves: &[bool]) -> Vec<Pair> {
        let mut pairs = Vec::new();
        let (first, moves) = (self.base_coordinates(), self.of_joints(moves));
        for group in self.parallel() {
            let moving: Vec<(usize, bool)> =
                group.into_iter().filter(|(link, _)| moves[*link]).collect();
            pairs.extend(moving.windows(2).map(|two| Pair {
                before: first + two[0].0,
                after: first + two[1].0,
                opposite: two[0].1 != two[1].1,
            }));
        }
        pairs
    }
}

#[cfg(test)]
mod tests {
    use alloc::format;

    use super::super::{Regrouping, Skeleton};
    use super::*;
    use crate::equations::Arm;
    use crate::equations::matrix::symmetric;
    use crate::number::Exact;
    use crate::read;
    use crate::scalar::field::{Field, Points};

    fn chain() -> Chain<Exact> {
        let joint =
            |alpha| format!("[[joint]]\nkind = \"revolute\"\na = 1\nalpha = {alpha}\nmass = 0\n");
        let joints = ["0", "\"pi\"", "0", "\"pi/2\"", "0"].map(joint).concat();
        let text = format!(
            "name = \"folded\"\nconvention = \"standard\"\ngravity = [0, 0, -9.81]\n{joints}"
        );
        let robot = read::parse(&text).unwrap().robot;
        let arm = Arm::from_robot(&robot, &mut Exact::clone).fold_base();
        let skeleton = Skeleton::new(&arm, &[const { None }; 5]);
        Chain::new(&skeleton, &Regrouping::base(&skeleton))
    }

    #[test]
    fn solves_the_equation_of_the_joints_that_move() {
        let chain = chain();
        let pairs = |moves: &[bool]| {
            let pairs = chain.pairs(moves).into_iter();
            let tuples = pairs.map(|pair| (pair.before, pair.after, pair.opposite));
            tuples.collect::<Vec<_>>()
        };
        let all_joints = [true; 5];
        let expected = [(0, 1, false), (1, 2, true), (2, 3, false)];
        assert_eq!(pairs(&all_joints), expected);
        let some = [true, false, true, true, true];
        assert_eq!(pairs(&some), [(0, 2, true), (2, 3, false)]);
        let mut points = Points::new(0x9a12);
        for moves in [all_joints, some, [false; 5]] {
            let entries: Vec<Field> = (0..25).map(|_| points.field()).collect();
            let d = symmetric(5, |i, k| entries[i * 5 + k]);
            let mut vector = || (0..5).map(|_| points.field()).collect::<Vec<Field>>();
            let (bias, tau) = (vector(), vector());
            let accelerations = solved_in_pairs(&chain.pairs(&moves), &d, [&bias, &tau], &moves);
            for (i, row) in d.iter().enumerate() {
                let products = row.iter().zip(&accelerations).map(|(x, y)| x.mul(y));
                let load = products.fold(bias[i], |sum, x| sum.add(&x));
                match moves[i] {
                    true => assert_eq!(load, tau[i]),
                    false => assert_eq!(accelerations[i], Field::ZERO),
                }
            }
        }
    }
}
