//! Terms regrouped so that points are evaluated joint after joint.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use super::SLACK;
use crate::certify::expand::{Key, powers};
use crate::certify::input_box::InputBox;
use crate::certify::interval::Interval;

/// Trigonometric polynomials, angle after angle.
pub(super) struct Layout {
    pub joints: Vec<usize>,
    pub degrees: Vec<u32>,
    /// Of each joint: the powers (cosine, sine) that occur.
    bases: Vec<Vec<(u32, u32)>>,
    pub coefficients: Vec<f64>,
    /// Of each joint: (from, base, to), and how many values come out.
    folds: Vec<(Vec<[u32; 3]>, usize)>,
    /// Of each joint: the largest magnitude of the rates of each value that
    /// goes in.
    sizes: Vec<Vec<f64>>,
    /// The range of the rates of each value that comes out.
    output: Vec<(f64, f64)>,
    /// What is left of the key of each value that comes out.
    pub rest: Vec<Key>,
    pub slack: f64,
    /// Whether a joint has less than the whole circle.
    pub part: Vec<bool>,
}

impl Layout {
    /// `range` of what is not an angle in a key.
    pub(super) fn new(
        polynomial: &[(Key, Interval)],
        limits: &InputBox,
        sliding: &[bool],
        range: &dyn Fn(Key) -> Interval,
    ) -> Layout {
        let degree = |joint: usize| {
            let keys = polynomial
                .iter()
                .filter(|&&(key, x)| negligible(x, range(key)).is_none())
                .map(|&(key, _)| powers(key, joint));
            keys.map(|(c, s)| c + s).max().unwrap_or(0)
        };
        let mut joints: Vec<usize> = (0..limits.joints()).filter(|&j| degree(j) > 0).collect();
        // The joint of the highest degree last: its sums are the shortest.
        joints.sort_by_key(|&joint| degree(joint));
        let degrees: Vec<u32> = joints.iter().map(|&j| degree(j)).collect();
        let part = joints
            .iter()
            .map(|&j| !sliding[j] && limits.position[j].width() < 2.0 * PI * (1.0 - 1e-12))
            .collect();
        let mut bases: Vec<Vec<(u32, u32)>> = vec![Vec::new(); joints.len()];
        let mut terms: Vec<Key> = Vec::new();
        let mut coefficients = Vec::new();
        let mut slack = 0.0;
        for &(key, coefficient) in polynomial {
            if let Some(lost) = negligible(coefficient, range(key)) {
                slack += lost;
                continue;
            }
            let most = range(key).magnitude();
            let size = coefficient.magnitude() * most;
            slack += (coefficient.radius() * most + SLACK * size) * (1.0 + 1e-9);
            terms.push(key);
            coefficients.push(coefficient.mid());
        }
        let mut sizes = Vec::new();
        let mut folds = Vec::new();
        for (k, &joint) in joints.iter().enumerate() {
            sizes.push(terms.iter().map(|&key| range(key).magnitude()).collect());
            let mut places: BTreeMap<Key, u32> = BTreeMap::new();
            let mut fold = Vec::new();
            for (from, &key) in terms.iter().enumerate() {
                let power = powers(key, joint);
                let base = bases[k]
                    .iter()
                    .position(|&b| b == power)
                    .unwrap_or_else(|| {
                        bases[k].push(power);
                        bases[k].len() - 1
                    });
                let rest = key & !(31u128 << (16 + 5 * joint));
                let next = places.len() as u32;
                let to = *places.entry(rest).or_insert(next);
                fold.push([from as u32, base as u32, to]);
            }
            terms = vec![0; places.len()];
            for (term, place) in places {
                terms[place as usize] = term;
            }
            folds.push((fold, terms.len()));
        }
        let output = terms.iter().map(|&key| {
            let range = range(key);
            (range.low(), range.high())
        });
        Layout {
            output: output.collect(),
            rest: terms.clone(),
            joints,
            degrees,
            bases,
            coefficients,
            folds,
            sizes,
            slack,
            part,
        }
    }

    /// Room for the values before and after each joint.
    pub(super) fn buffers(&self) -> Vec<Vec<f64>> {
        let mut buffers: Vec<Vec<f64>> = vec![self.coefficients.clone()];
        buffers.extend(self.folds.iter().map(|(_, len)| vec![0.0; *len]));
        buffers
    }

    /// No sine is larger than one.
    pub(super) fn crude(&self, level: usize, values: &[f64]) -> f64 {
        // After the last angle only rates are left.
        let Some(sizes) = self.sizes.get(level) else {
            return self.value(values) * (1.0 + 1e-9);
        };
        let terms = values.iter().zip(sizes);
        terms.fold(self.slack, |sum, (x, size)| sum + x.abs() * size) * (1.0 + 1e-9)
    }

    /// Puts an angle into the values before a joint.
    pub(super) fn fold(&self, level: usize, angle: f64, buffers: &mut [Vec<f64>]) {
        let (sin, cos) = libm::sincos(angle);
        let power = |&(c, s): &(u32, u32)| {
            (0..c).fold(1.0, |x, _| x * cos) * (0..s).fold(1.0, |x, _| x * sin)
        };
        let row: Vec<f64> = self.bases[level].iter().map(power).collect();
        let (from, rest) = buffers.split_at_mut(level + 1);
        rest[0].fill(0.0);
        for &[x, base, to] in &self.folds[level].0 {
            rest[0][to as usize] += from[level][x as usize] * row[base as usize];
        }
    }

    /// The value at a point, rates at their worst.
    pub(super) fn value(&self, values: &[f64]) -> f64 {
        let (mut low, mut high) = (0.0, 0.0);
        for (x, &(least, greatest)) in values.iter().zip(&self.output) {
            let (a, b) = (x * least, x * greatest);
            low += a.min(b);
            high += a.max(b);
        }
        f64::max(high, -low) + self.slack
    }
}

/// What a term can be at most, if it is but the rounding of a sum that
/// cancels: zero is inside, and it is far below what counts.
fn negligible(coefficient: Interval, range: Interval) -> Option<f64> {
    let most = (coefficient.magnitude() * range.magnitude()).next_up();
    (coefficient.contains(0.0) && most < 1e-13).then_some(most)
}
