//! Terms regrouped so that points are evaluated joint after joint.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use super::SLACK;
use super::harmonics::{bits, multiple, unphased};
use crate::certify::expand::Key;
use crate::certify::input_box::InputBox;
use crate::certify::interval::Interval;

/// Trigonometric polynomials in multiples of their angles, angle after angle.
pub(super) struct Layout {
    pub joints: Vec<usize>,
    pub degrees: Vec<u32>,
    /// Of each joint: the multiples that occur, and whether of the sine.
    bases: Vec<Vec<(u32, bool)>>,
    pub coefficients: Vec<f64>,
    /// Of each joint: (from, base, to), and how many values come out.
    folds: Vec<(Vec<[u32; 3]>, usize)>,
    /// Of each joint: values that go in and differ by sine and cosine alone,
    /// one after the other: where they end, and how large their rates are.
    groups: Vec<Vec<(u32, f64)>>,
    /// The range of the rates of each value that comes out.
    output: Vec<(f64, f64)>,
    /// What is left of the key of each value that comes out.
    pub rest: Vec<Key>,
    pub slack: f64,
    /// Whether a joint has less than the whole circle.
    pub part: Vec<bool>,
}

impl Layout {
    /// Of a polynomial in multiples; `range` of what is not an angle in a key.
    /// Terms of at most `least` are left to the slack.
    pub(super) fn new(
        polynomial: &[(Key, Interval)],
        limits: &InputBox,
        sliding: &[bool],
        range: &dyn Fn(Key) -> Interval,
        least: f64,
    ) -> Layout {
        let n = limits.joints();
        let mut slack = 0.0;
        let mut terms: Vec<(Key, f64)> = Vec::new();
        for &(key, coefficient) in polynomial {
            let most = range(key).magnitude();
            let size = (coefficient.magnitude() * most).next_up();
            if size <= least {
                slack += size;
                continue;
            }
            // Lengths of groups lose what is too small to be squared.
            let tiny = f64::MIN_POSITIVE.sqrt() * most;
            slack += (coefficient.radius() * most + SLACK * size + tiny) * (1.0 + 1e-9);
            terms.push((key, coefficient.mid()));
        }
        let degree = |joint: usize| {
            let multiples = terms.iter().map(|&(key, _)| multiple(key, joint).0);
            multiples.max().unwrap_or(0)
        };
        let mut joints: Vec<usize> = (0..n).filter(|&j| degree(j) > 0).collect();
        // The joint of the highest degree last: its sums are the shortest.
        joints.sort_by_key(|&joint| degree(joint));
        let degrees: Vec<u32> = joints.iter().map(|&j| degree(j)).collect();
        let part = joints
            .iter()
            .map(|&j| !sliding[j] && limits.position[j].width() < 2.0 * PI * (1.0 - 1e-12))
            .collect();
        terms.sort_by_key(|&(key, _)| (unphased(key, n), key));
        let coefficients = terms.iter().map(|&(_, x)| x).collect();
        let mut terms: Vec<Key> = terms.into_iter().map(|(key, _)| key).collect();
        let mut bases: Vec<Vec<(u32, bool)>> = vec![Vec::new(); joints.len()];
        let mut groups = Vec::new();
        let mut folds = Vec::new();
        for (k, &joint) in joints.iter().enumerate() {
            let together = terms.chunk_by(|&a, &b| unphased(a, n) == unphased(b, n));
            let mut end = 0;
            groups.push(
                together
                    .map(|group| {
                        end += group.len() as u32;
                        (end, range(group[0]).magnitude())
                    })
                    .collect(),
            );
            let rest = |key: Key| key & !bits(joint);
            let mut after: Vec<Key> = terms.iter().map(|&key| rest(key)).collect();
            after.sort_by_key(|&key| (unphased(key, n), key));
            after.dedup();
            let places: BTreeMap<Key, u32> = after.iter().copied().zip(0..).collect();
            let mut fold = Vec::new();
            for (from, &key) in terms.iter().enumerate() {
                let of = multiple(key, joint);
                let base = bases[k].iter().position(|&b| b == of);
                let base = base.unwrap_or_else(|| {
                    bases[k].push(of);
                    bases[k].len() - 1
                });
                fold.push([from as u32, base as u32, places[&rest(key)]]);
            }
            terms = after;
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
            groups,
            slack: slack * (1.0 + 1e-9),
            part,
        }
    }

    /// How many values go into a joint.
    pub(super) fn terms(&self, level: usize) -> usize {
        self.folds[level].0.len()
    }

    /// Room for the values before and after each joint.
    pub(super) fn buffers(&self) -> Vec<Vec<f64>> {
        let mut buffers: Vec<Vec<f64>> = vec![self.coefficients.clone()];
        buffers.extend(self.folds.iter().map(|(_, len)| vec![0.0; *len]));
        buffers
    }

    /// A bound without looking at angles: each group's is the length of its
    /// coefficients.
    pub(super) fn crude(&self, level: usize, values: &[f64]) -> f64 {
        // After the last angle only rates are left.
        let Some(groups) = self.groups.get(level) else {
            return self.value(values) * (1.0 + 1e-9);
        };
        let (mut sum, mut from) = (self.slack, 0);
        for &(end, size) in groups {
            let end = end as usize;
            let squares: f64 = values[from..end].iter().map(|x| x * x).sum();
            sum += squares.sqrt() * size;
            from = end;
        }
        sum * (1.0 + 1e-9)
    }

    /// Puts an angle into the values before a joint.
    pub(super) fn fold(&self, level: usize, angle: f64, buffers: &mut [Vec<f64>]) {
        let (sin, cos) = libm::sincos(angle);
        let mut multiples = [(0.0, 1.0); 16];
        for k in 1..=(self.degrees[level] as usize).min(15) {
            let (s, c) = multiples[k - 1];
            multiples[k] = (s * cos + c * sin, c * cos - s * sin);
        }
        let mut row = [0.0; 32];
        for (value, &(k, sine)) in row.iter_mut().zip(&self.bases[level]) {
            let (s, c) = multiples[k as usize];
            *value = if sine { s } else { c };
        }
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
