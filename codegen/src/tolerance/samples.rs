//! Sampled positions, each with the motions that tell all coefficients of a result there.
//!
//! A result is a polynomial of degree two in the rates, whose coefficients depend on the position. At
//! each position a program runs at the few motions that give these coefficients, and an error counts
//! as a bound counts it: with all rates at their worst. So only positions are sampled, which are few
//! and smooth, and not the signs of 2n rates.

use dalembert_checker::domain::corners;

use super::input_box::InputBox;
use super::sample::draw;
use crate::function::Argument;
use crate::program::{Input, Program};
use crate::random::Random;
use crate::sincos::interval::Interval;

/// The most velocities whose corners are tried together.
const CORNERS: usize = 10;

#[derive(Clone)]
pub(super) struct Samples {
    /// The joints that have a velocity, and those that have an acceleration, with the largest.
    rates: [Vec<(usize, f64)>; 2],
    /// The places of each two velocities.
    pairs: Vec<(usize, usize)>,
    /// Behind the joints' positions gravity in the axes of a base that floats, then the load.
    pub(super) positions: Vec<Vec<f64>>,
    joints: usize,
    loads: Vec<Interval>,
    random: Random,
}

impl Samples {
    pub(super) fn new(program: &Program, limits: &InputBox, count: usize, seed: u64) -> Samples {
        let of = |argument, ranges: &[Interval]| {
            let used = program.arguments.contains(&argument);
            let sizes = ranges.iter().map(|range| range.magnitude()).enumerate();
            sizes.filter(|(_, size)| used && *size > 0.0).collect()
        };
        let mut random = Random::new(seed);
        let velocities: Vec<(usize, f64)> = of(Argument::Velocity, &limits.velocity);
        let v = velocities.len();
        let pairs = (0..v).flat_map(|k| (k + 1..v).map(move |l| (k, l)));
        let mut samples = Samples {
            pairs: pairs.collect(),
            rates: [velocities, of(Argument::Acceleration, &limits.acceleration)],
            positions: Vec::new(),
            joints: limits.joints(),
            loads: limits.load.clone(),
            random: random.clone(),
        };
        let drawn = (0..count).map(|_| draw(limits, &mut random));
        samples.add(drawn.map(|state| [state.q, state.g].concat()));
        samples
    }

    /// Adds positions; each gets a load, of which every number is at one end of its range.
    pub(super) fn add(&mut self, positions: impl IntoIterator<Item = Vec<f64>>) {
        for mut position in positions {
            let random = &mut self.random;
            let end = |range: &Interval| [range.low(), range.high()][random.below(2)];
            position.extend(self.loads.iter().map(end));
            self.positions.push(position);
        }
    }

    /// Returns the number of motions at a position.
    pub(super) fn block(&self) -> usize {
        let [v, a] = self.rates.each_ref().map(Vec::len);
        1 + a + 2 * v + self.pairs.len()
    }

    pub(super) fn len(&self) -> usize {
        self.positions.len() * self.block()
    }

    /// Returns an input at every sample: at rest, with each acceleration, with each velocity forward
    /// and backward, with each two velocities.
    pub(super) fn column(&self, input: Input) -> Vec<f64> {
        let mut values = vec![0.0; self.len()];
        let blocks = values.chunks_exact_mut(self.block());
        for (q, block) in self.positions.iter().zip(blocks) {
            let first_load = q.len() - self.loads.len();
            match input {
                Input::Sin(joint) => block.fill(libm::sin(q[joint])),
                Input::Cos(joint) => block.fill(libm::cos(q[joint])),
                Input::Entry(Argument::Position, joint) => block.fill(q[joint]),
                Input::Entry(Argument::Load, index) => block.fill(q[first_load + index]),
                Input::Entry(Argument::Gravity, index) => block.fill(q[self.joints + index]),
                Input::Entry(argument, joint) => self.rate(argument, joint, block),
                // A function that reads it has no bounds, and is refused before any search.
                Input::PerSpeed(_) => block.fill(f64::NAN),
            }
        }
        values
    }

    fn rate(&self, argument: Argument, joint: usize, block: &mut [f64]) {
        let [v, a] = self.rates.each_ref().map(Vec::len);
        let is_velocity = argument == Argument::Velocity;
        let rates = &self.rates[usize::from(!is_velocity)];
        let Some(place) = rates.iter().position(|rate| rate.0 == joint) else {
            return;
        };
        let size = rates[place].1;
        if !is_velocity {
            block[1 + place] = size;
            return;
        }
        let (single, pairs) = block.split_at_mut(1 + a + 2 * v);
        (single[1 + a + 2 * place], single[2 + a + 2 * place]) = (size, -size);
        for (entry, (k, l)) in pairs.iter_mut().zip(&self.pairs) {
            if *k == place || *l == place {
                *entry = size;
            }
        }
    }

    /// Turns values at the motions of each position into the coefficients at the largest rates;
    /// linear. The rest, then accelerations, then pairs of a velocity's linear and square part, then
    /// products.
    pub(super) fn coefficients(&self, values: &mut [f64]) {
        let [v, a] = self.rates.each_ref().map(Vec::len);
        for block in values.chunks_exact_mut(self.block()) {
            let (single, products) = block.split_at_mut(1 + a + 2 * v);
            let rest = single[0];
            let forward = &single[1 + a..];
            for (product, (k, l)) in products.iter_mut().zip(&self.pairs) {
                *product += rest - forward[2 * k] - forward[2 * l];
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

    /// Returns the largest magnitude at a position, from its coefficients; or any number up to `most`,
    /// if it is not above that.
    pub(super) fn largest(&self, block: &[f64], most: f64) -> f64 {
        let [v, a] = self.rates.each_ref().map(Vec::len);
        let (single, products) = block.split_at(1 + a + 2 * v);
        let (mut low, mut high) = (single[0], single[0]);
        for x in &single[1..=a] {
            (low, high) = (low - x.abs(), high + x.abs());
        }
        let pairs = || single[1 + a..].chunks_exact(2);
        for pair in pairs() {
            (low, high) = (low + pair[1].min(0.0), high + pair[1].max(0.0));
        }
        let linear = pairs().map(|pair| pair[0].abs());
        let alone: f64 = linear.chain(products.iter().map(|x| x.abs())).sum();
        let crude = high.max(-low) + alone;
        if crude <= most || v == 0 || v > CORNERS {
            return crude;
        }
        let mut sums = [0.0; 1 << CORNERS];
        let sums = &mut sums[..1 << v];
        for (k, pair) in pairs().enumerate() {
            sums[1 << k] = pair[0];
        }
        for ((k, l), x) in self.pairs.iter().zip(products) {
            sums[1 << k | 1 << l] = *x;
        }
        let [least, greatest] = corners(sums);
        (high + greatest).max(-(low + least))
    }

    pub(super) fn blocks(&self, rows: &[f64]) -> Vec<f64> {
        let blocks = rows.chunks_exact(self.block());
        blocks.map(|block| self.largest(block, 0.0)).collect()
    }
}
