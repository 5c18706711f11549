//! The answer of a body to the motions of a frame.

use crate::equations::Link;
use crate::equations::matrix::{
    Vector, cross, difference, dot, identity, opposite, plus, scaled, sum, tensor_times, three,
    transposed, zero_vector,
};
use crate::equations::screws::{Twist, Wrench};
use crate::scalar::Divide;

type Block<S> = [Vector<S>; 3];

/// The articulated inertia, symmetric, in blocks: the moment is
/// `turn`·α + `mixed`·a, the force `mixed`ᵀ·α + `shift`·a.
#[derive(Clone, Debug)]
pub(super) struct Articulated<S> {
    pub(super) turn: Block<S>,
    pub(super) mixed: Block<S>,
    pub(super) shift: Block<S>,
}

impl<S: Divide> Articulated<S> {
    pub(super) fn zero() -> Self {
        let zero = || [zero_vector(), zero_vector(), zero_vector()];
        Articulated {
            turn: zero(),
            mixed: zero(),
            shift: zero(),
        }
    }

    pub(super) fn of(link: &Link<S>, velocity: &Twist<S>) -> (Self, Wrench<S>) {
        let (mass, com) = (&link.mass, &link.com);
        let first = scaled(mass, com);
        let about_centre: Block<S> = link.inertia.rows();
        // I + m (s̄·s̄ 1 − s̄ s̄ᵀ) = I − [m s̄]× [s̄]×
        let steiner = rows_crossed(&columns_crossed(&first, &identity()), com);
        let negated = steiner.map(|row| opposite(&row));
        let body = Articulated {
            turn: block_sum(&about_centre, &negated),
            mixed: columns_crossed(&first, &identity()),
            shift: identity().map(|row| scaled(mass, &row)),
        };
        let Twist { turn, shift } = velocity;
        // At the centre of mass: ω × (m v_c), and about it ω × (I ω).
        let centre = sum(shift, &cross(turn, com));
        let force = cross(turn, &scaled(mass, &centre));
        let spin = cross(turn, &tensor_times(&link.inertia, turn));
        let moment = sum(&spin, &cross(com, &force));
        (body, Wrench { force, moment })
    }

    pub(super) fn plus(&self, other: &Self) -> Self {
        Articulated {
            turn: block_sum(&self.turn, &other.turn),
            mixed: block_sum(&self.mixed, &other.mixed),
            shift: block_sum(&self.shift, &other.shift),
        }
    }

    pub(super) fn times(&self, motion: &Twist<S>) -> Wrench<S> {
        let by = |block: &Block<S>, v: &Vector<S>| block.each_ref().map(|row| dot(row, v));
        Wrench {
            force: sum(
                &by(&transposed(&self.mixed), &motion.turn),
                &by(&self.shift, &motion.shift),
            ),
            moment: sum(
                &by(&self.turn, &motion.turn),
                &by(&self.mixed, &motion.shift),
            ),
        }
    }

    /// Returns I − w wᵀ/d
    pub(super) fn without(&self, push: &Wrench<S>, inverse: &S) -> Self {
        let (force, moment) = (scaled(inverse, &push.force), scaled(inverse, &push.moment));
        let less = |block: &Block<S>, left: &Vector<S>, right: &Vector<S>| -> Block<S> {
            three(|i| difference(&block[i], &scaled(&left[i], right)))
        };
        Articulated {
            turn: less(&self.turn, &moment, &push.moment),
            mixed: less(&self.mixed, &moment, &push.force),
            shift: less(&self.shift, &force, &push.force),
        }
    }

    /// Returns it as seen from axes into which vectors turn like this, about an origin from which
    /// this one is a lever away: with p the lever B′ = B + [p]× M, A′ = A + [p]× Bᵀ − B′ [p]×.
    pub(super) fn carried(
        &self,
        turned: impl Fn(&Vector<S>) -> Vector<S>,
        lever: &Vector<S>,
    ) -> Self {
        let rows = |block: &Block<S>| block.each_ref().map(&turned);
        let both = |block: &Block<S>| transposed(&rows(&transposed(&rows(block))));
        let [turn, mixed, shift] = [&self.turn, &self.mixed, &self.shift].map(both);
        let mixed_there = block_sum(&mixed, &columns_crossed(lever, &shift));
        let first = columns_crossed(lever, &transposed(&mixed));
        let second = rows_crossed(&mixed_there, lever);
        Articulated {
            turn: three(|i| difference(&sum(&turn[i], &first[i]), &second[i])),
            mixed: mixed_there,
            shift,
        }
    }
}

pub(super) fn power<S: Divide>(wrench: &Wrench<S>, motion: &Twist<S>) -> S {
    plus(
        &dot(&wrench.moment, &motion.turn),
        &dot(&wrench.force, &motion.shift),
    )
}

fn block_sum<S: Divide>(a: &Block<S>, b: &Block<S>) -> Block<S> {
    three(|i| sum(&a[i], &b[i]))
}

fn columns_crossed<S: Divide>(p: &Vector<S>, block: &Block<S>) -> Block<S> {
    transposed(&transposed(block).map(|column| cross(p, &column)))
}

fn rows_crossed<S: Divide>(block: &Block<S>, p: &Vector<S>) -> Block<S> {
    block.each_ref().map(|row| cross(row, p))
}
