//! Errors at sampled positions, at the worst rates.
//!
//! An output is a polynomial of degree two in the rates, whose coefficients depend on the position.
//! At each sampled position a program is run at the few motions that give these coefficients, and
//! an error is measured as the certificate measures it: rates at their worst. So only positions are
//! sampled, which are few and smooth, and not the signs of 2n rates.
//!
//! A program that multiplies a velocity by an acceleration has further
//! monomials, which are missed here; the certificate decides.

use crate::bound::corners::Corners;
use crate::bound::input_box::InputBox;
use crate::function::Argument;
use crate::interval::Interval;
use crate::program::Program;
use crate::random::Random;
use crate::states::JointState;

#[derive(Clone)]
pub(super) struct Motions {
    velocities: Vec<(usize, f64)>,
    accelerations: Vec<(usize, f64)>,
    pairs: Vec<(usize, usize)>,
}

impl Motions {
    pub(super) fn new(program: &Program, limits: &InputBox) -> Motions {
        let of = |argument, ranges: &[Interval]| {
            let used = program.arguments.contains(&argument);
            let sizes = ranges.iter().map(|range| range.magnitude()).enumerate();
            sizes.filter(|(_, size)| used && *size > 0.0).collect()
        };
        let velocities: Vec<_> = of(Argument::Velocity, &limits.velocity);
        let v = velocities.len();
        Motions {
            pairs: (0..v)
                .flat_map(|k| (k + 1..v).map(move |l| (k, l)))
                .collect(),
            velocities,
            accelerations: of(Argument::Acceleration, &limits.acceleration),
        }
    }

    pub(super) fn len(&self) -> usize {
        1 + self.accelerations.len() + 2 * self.velocities.len() + self.pairs.len()
    }

    pub(super) fn states(&self, positions: &[Vec<f64>]) -> Vec<JointState> {
        let mut states = Vec::with_capacity(positions.len() * self.len());
        for q in positions {
            let rest = JointState::at_rest(q.clone());
            let mut push = |set: &dyn Fn(&mut JointState)| {
                let mut state = rest.clone();
                set(&mut state);
                states.push(state);
            };
            push(&|_| {});
            for &(joint, size) in &self.accelerations {
                push(&|state| state.qdd[joint] = size);
            }
            for &(joint, size) in &self.velocities {
                push(&|state| state.qd[joint] = size);
                push(&|state| state.qd[joint] = -size);
            }
            for &(k, l) in &self.pairs {
                let [(first, a), (second, b)] = [self.velocities[k], self.velocities[l]];
                push(&|state| (state.qd[first], state.qd[second]) = (a, b));
            }
        }
        states
    }

    /// Turns values at the motions of each position into what each monomial can be at most;
    /// linear. The rest, then accelerations, then pairs of a velocity's linear and square part,
    /// then products.
    pub(super) fn monomials(&self, values: &mut [f64]) {
        let (a, v) = (self.accelerations.len(), self.velocities.len());
        for block in values.chunks_exact_mut(self.len()) {
            let (single, products) = block.split_at_mut(1 + a + 2 * v);
            let rest = single[0];
            for (product, &(k, l)) in products.iter_mut().zip(&self.pairs) {
                *product += rest - single[1 + a + 2 * k] - single[1 + a + 2 * l];
            }
            for x in &mut single[1..=a] {
                *x -= rest;
            }
            for pair in single[1 + a..].chunks_exact_mut(2) {
                let (plus, minus) = (pair[0], pair[1]);
                pair[0] = 0.5 * (plus - minus);
                pair[1] = 0.5 * (plus + minus) - rest;
            }
        }
    }

    pub(super) fn largest(&self, block: &[f64]) -> f64 {
        self.beyond(block, 0.0)
    }

    pub(super) fn largest_of(&self, blocks: &[f64]) -> f64 {
        let blocks = blocks.chunks_exact(self.len());
        blocks.fold(0.0, |most, block| f64::max(most, self.beyond(block, most)))
    }

    /// As [`Motions::largest`], or any number up to `most` if the magnitude does not exceed it.
    fn beyond(&self, block: &[f64], most: f64) -> f64 {
        let (a, v) = (self.accelerations.len(), self.velocities.len());
        let (single, products) = block.split_at(1 + a + 2 * v);
        let (mut low, mut high) = (block[0], block[0]);
        for x in &single[1..=a] {
            high += x.abs();
            low -= x.abs();
        }
        let pairs = single[1 + a..].chunks_exact(2);
        for square in pairs.clone().map(|pair| pair[1]) {
            high += square.max(0.0);
            low += square.min(0.0);
        }
        let linear = pairs.clone().map(|pair| pair[0]);
        let alone: f64 = linear.chain(products.iter().copied()).map(f64::abs).sum();
        let (mut least, mut greatest) = (-alone, alone);
        if f64::max(high, -low) + alone > most
            && let Some(mut corners) = Corners::new(v)
        {
            for (k, pair) in pairs.enumerate() {
                *corners.of(0, 1 + k) = pair[0];
            }
            for (product, &(k, l)) in products.iter().zip(&self.pairs) {
                *corners.of(1 + k, 1 + l) = *product;
            }
            (least, greatest) = corners.extremes();
        }
        f64::max(high + greatest, -(low + least))
    }
}

pub(super) fn positions(limits: &InputBox, count: usize, random: &mut Random) -> Vec<Vec<f64>> {
    (0..count)
        .map(|_| crate::bound::sample::draw(limits, random).q)
        .collect()
}
