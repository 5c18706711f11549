//! Errors at sampled positions, at the worst rates.
//!
//! An output is a polynomial of degree two in the rates, whose coefficients
//! depend on the position. At each sampled position a program is run at the
//! few motions that give these coefficients, and an error is measured as the
//! certificate measures it: every monomial at its worst. So only positions
//! are sampled, which are few and smooth, and not the signs of 2n rates.
//!
//! A program that multiplies a velocity by an acceleration has further
//! monomials, which are missed here; the certificate decides.

use crate::bound::input_box::InputBox;
use crate::function::Argument;
use crate::interval::Interval;
use crate::program::Program;
use crate::random::Random;
use crate::states::JointState;

/// Sampled positions and the motions at each.
#[derive(Clone)]
pub(super) struct Motions {
    /// Joints that may have a velocity, and its largest magnitude.
    velocities: Vec<(usize, f64)>,
    accelerations: Vec<(usize, f64)>,
    joints: usize,
}

impl Motions {
    pub(super) fn new(program: &Program, limits: &InputBox) -> Motions {
        let of = |argument, ranges: &[Interval]| {
            let used = program.arguments.contains(&argument);
            let sizes = ranges.iter().map(|range| range.magnitude()).enumerate();
            sizes.filter(|(_, size)| used && *size > 0.0).collect()
        };
        Motions {
            velocities: of(Argument::Velocity, &limits.velocity),
            accelerations: of(Argument::Acceleration, &limits.acceleration),
            joints: limits.joints(),
        }
    }

    /// Returns how many motions there are at a position.
    pub(super) fn len(&self) -> usize {
        let v = self.velocities.len();
        1 + self.accelerations.len() + 2 * v + v * v.saturating_sub(1) / 2
    }

    /// The motions at each position.
    pub(super) fn states(&self, positions: &[Vec<f64>]) -> Vec<JointState> {
        let mut states = Vec::with_capacity(positions.len() * self.len());
        for q in positions {
            let rest = JointState {
                q: q.clone(),
                qd: vec![0.0; self.joints],
                qdd: vec![0.0; self.joints],
                ..JointState::default()
            };
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
            for (k, &(first, a)) in self.velocities.iter().enumerate() {
                for &(second, b) in &self.velocities[k + 1..] {
                    push(&|state| (state.qd[first], state.qd[second]) = (a, b));
                }
            }
        }
        states
    }

    /// From values at the motions of each position to what each monomial can
    /// be at most; linear. The rest, then accelerations, then pairs of a
    /// velocity's linear and square part, then products.
    pub(super) fn monomials(&self, values: &mut [f64]) {
        let (a, v) = (self.accelerations.len(), self.velocities.len());
        for block in values.chunks_exact_mut(self.len()) {
            let (single, products) = block.split_at_mut(1 + a + 2 * v);
            let rest = single[0];
            let mut next = products.iter_mut();
            for k in 0..v {
                for l in k + 1..v {
                    if let Some(product) = next.next() {
                        *product += rest - single[1 + a + 2 * k] - single[1 + a + 2 * l];
                    }
                }
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

    /// The largest magnitude at one position, from its monomials.
    pub(super) fn largest(&self, block: &[f64]) -> f64 {
        let (a, v) = (self.accelerations.len(), self.velocities.len());
        let (mut high, mut low) = (block[0], block[0]);
        for x in &block[1..=a] {
            high += x.abs();
            low -= x.abs();
        }
        for pair in block[1 + a..1 + a + 2 * v].chunks_exact(2) {
            high += pair[0].abs() + pair[1].max(0.0);
            low += pair[1].min(0.0) - pair[0].abs();
        }
        for x in &block[1 + a + 2 * v..] {
            high += x.abs();
            low -= x.abs();
        }
        high.max(-low)
    }
}

/// Positions of the box: anywhere, now and then at a quarter turn or an end.
pub(super) fn positions(limits: &InputBox, count: usize, random: &mut Random) -> Vec<Vec<f64>> {
    (0..count)
        .map(|_| crate::bound::sample::draw(limits, random).q)
        .collect()
}
