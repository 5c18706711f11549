//! Terms regrouped so that points are evaluated joint after joint.

use std::f64::consts::PI;

use super::harmonics::{bits, multiple, phases};
use crate::bound::corners::Corners;
use crate::bound::expand::{Key, rates};
use crate::bound::input_box::InputBox;
use crate::interval::Interval;

pub(super) const LANES: usize = 8;

/// Multiples of an angle up to the 15th: their cosines and sines, and 1.
const BASES: usize = 32;

/// Values that differ by sine and cosine alone.
pub(super) struct Group {
    pub end: u32,
    pub size: f64,
    pub square: f64,
}

#[derive(Clone, Copy, Debug)]
pub(super) struct Crude {
    pub most: f64,
    /// At least the magnitude of its second derivative by the next angle.
    pub bend: f64,
}

pub(super) struct Layout {
    pub joints: Vec<usize>,
    pub degrees: Vec<u32>,
    /// What rounding costs, against the sum of all terms' magnitudes.
    pub rounding: f64,
    /// For each joint, the multiples that occur, `true` for the sine.
    bases: Vec<Vec<(u32, bool)>>,
    pub coefficients: Vec<f64>,
    /// For each joint: pairs (base, to) of the values that go in, and how many come out.
    folds: Vec<(Vec<[u32; 2]>, usize)>,
    /// For each joint, the values that go in and differ by sine and cosine alone, side by side.
    pub groups: Vec<Vec<Group>>,
    pub output: Vec<(f64, f64)>,
    /// For each value that comes out, the factors that are at their worst together with others.
    factors: Vec<Option<(usize, usize)>>,
    corners: Option<Corners>,
    pub rest: Vec<Key>,
    pub slack: f64,
    /// True for a joint with less than the whole circle.
    pub part: Vec<bool>,
}

impl Layout {
    /// Terms of at most `least` are left to the slack. The joint of the highest degree is the last
    /// one: its sums are the shortest.
    pub(super) fn new(
        polynomial: &[(Key, Interval)],
        limits: &InputBox,
        sliding: &[bool],
        range: &dyn Fn(Key) -> Interval,
        least: f64,
    ) -> Layout {
        let n = limits.joints();
        let phases = phases(n);
        // Values that differ by sine and cosine alone stand together.
        let place = |key: Key| (key & !phases, key);
        let (mut slack, mut sizes) = (0.0, 0.0);
        let mut terms: Vec<(Key, f64)> = Vec::new();
        for &(key, coefficient) in polynomial {
            let most = range(key).magnitude();
            if most == 0.0 || coefficient.magnitude() == 0.0 {
                continue;
            }
            let size = (coefficient.magnitude() * most).next_up();
            if size <= least || coefficient.mid() == 0.0 {
                slack += size;
                continue;
            }
            // Lengths of groups lose what is too small to be squared.
            let tiny = f64::MIN_POSITIVE.sqrt() * most;
            slack += (coefficient.radius() * most + tiny) * (1.0 + 1e-9);
            sizes += size;
            terms.push((key, coefficient.mid()));
        }
        let mut degree = vec![0; n];
        for &(key, _) in &terms {
            for (joint, degree) in degree.iter_mut().enumerate() {
                *degree = multiple(key, joint).0.max(*degree);
            }
        }
        let mut joints: Vec<usize> = (0..n).filter(|&j| degree[j] > 0).collect();
        joints.sort_by_key(|&joint| degree[joint]);
        let degrees: Vec<u32> = joints.iter().map(|&j| degree[j]).collect();
        let part = joints
            .iter()
            .map(|&j| !sliding[j] && limits.position[j].width() < 2.0 * PI * (1.0 - 1e-12))
            .collect();
        terms.sort_by_key(|&(key, _)| place(key));
        let coefficients = terms.iter().map(|&(_, x)| x).collect();
        let mut terms: Vec<Key> = terms.into_iter().map(|(key, _)| key).collect();
        let mut bases: Vec<Vec<(u32, bool)>> = vec![Vec::new(); joints.len()];
        let mut groups = Vec::new();
        let mut folds = Vec::new();
        for (k, &joint) in joints.iter().enumerate() {
            let together = terms.chunk_by(|&a, &b| a & !phases == b & !phases);
            let mut end = 0;
            groups.push(
                together
                    .map(|group| {
                        end += group.len() as u32;
                        Group {
                            end,
                            size: range(group[0]).magnitude(),
                            square: f64::from(multiple(group[0], joint).0.pow(2)),
                        }
                    })
                    .collect(),
            );
            let rest = |key: Key| key & !bits(joint);
            let mut moved: Vec<((Key, Key), usize)> = (terms.iter().enumerate())
                .map(|(from, &key)| (place(rest(key)), from))
                .collect();
            moved.sort_unstable();
            let mut after: Vec<Key> = Vec::new();
            let mut to = vec![0; terms.len()];
            for ((_, key), from) in moved {
                if after.last() != Some(&key) {
                    after.push(key);
                }
                to[from] = after.len() as u32 - 1;
            }
            let mut fold = Vec::new();
            for (&key, to) in terms.iter().zip(to) {
                let of = multiple(key, joint);
                let base = bases[k].iter().position(|&b| b == of);
                let base = base.unwrap_or_else(|| {
                    bases[k].push(of);
                    bases[k].len() - 1
                });
                fold.push([base as u32, to]);
            }
            terms = after;
            folds.push((fold, terms.len()));
        }
        let rounding = roundings(&degrees, &folds, terms.len());
        slack += sizes * rounding;
        let output = terms.iter().map(|&key| {
            let range = range(key);
            (range.low(), range.high())
        });
        let output: Vec<(f64, f64)> = output.collect();
        let (factors, corners) = factors(&terms, &output, n);
        Layout {
            output,
            factors,
            corners,
            rounding,
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

    pub(super) fn len(&self, level: usize) -> usize {
        match level.checked_sub(1) {
            None => self.coefficients.len(),
            Some(before) => self.folds[before].1,
        }
    }

    /// Each group counts with the length of its coefficients.
    pub(super) fn crude(&self, level: usize, values: &[f64]) -> Crude {
        let Some(groups) = self.groups.get(level) else {
            return Crude {
                most: self.each_at_worst(values) * (1.0 + 1e-9),
                bend: 0.0,
            };
        };
        let degree = f64::from(self.degrees[level]);
        let (mut most, mut bend, mut from) = (self.slack, degree * degree * self.slack, 0);
        for group in groups {
            let end = group.end as usize;
            let squares: f64 = values[from..end].iter().map(|x| x * x).sum();
            let length = squares.sqrt() * group.size;
            most += length;
            bend += length * group.square;
            from = end;
        }
        Crude {
            most: most * (1.0 + 1e-9),
            bend: bend * (1.0 + 1e-9),
        }
    }

    pub(super) fn fold(&self, level: usize, angles: &[f64], before: &[f64], after: &mut Vec<f64>) {
        for angles in angles.chunks(LANES) {
            match angles.len() {
                1 => self.columns::<1>(level, angles, before, after),
                2..=4 => self.columns::<4>(level, angles, before, after),
                _ => self.columns::<LANES>(level, angles, before, after),
            }
        }
    }

    /// Each sum is the one that an angle by itself would have.
    fn columns<const W: usize>(
        &self,
        level: usize,
        angles: &[f64],
        before: &[f64],
        after: &mut Vec<f64>,
    ) {
        let mut rows = [[0.0; W]; BASES];
        for (lane, &angle) in angles.iter().enumerate() {
            let (sin, cos) = libm::sincos(angle);
            let mut multiples = [(0.0, 1.0); 16];
            for k in 1..=(self.degrees[level] as usize).min(15) {
                let (s, c) = multiples[k - 1];
                multiples[k] = (s * cos + c * sin, c * cos - s * sin);
            }
            for (row, &(k, sine)) in rows.iter_mut().zip(&self.bases[level]) {
                let (s, c) = multiples[k as usize];
                row[lane] = if sine { s } else { c };
            }
        }
        let (fold, len) = &self.folds[level];
        let mut sums = vec![[0.0; W]; *len];
        for (&x, &[base, to]) in before.iter().zip(fold) {
            let (row, sum) = (&rows[base as usize % BASES], &mut sums[to as usize]);
            // Counted: a pair of iterators takes as long to make as this takes.
            let mut lane = 0;
            while lane < W {
                sum[lane] += x * row[lane];
                lane += 1;
            }
        }
        for lane in 0..angles.len() {
            after.extend(sums.iter().map(|sums| sums[lane]));
        }
    }

    pub(super) fn is_below(&self, values: &[f64], bound: f64) -> bool {
        self.each_at_worst(values) <= bound || self.value(values) <= bound
    }

    fn each_at_worst(&self, values: &[f64]) -> f64 {
        let (mut low, mut high) = (0.0, 0.0);
        for (x, &(least, greatest)) in values.iter().zip(&self.output) {
            let (a, b) = (x * least, x * greatest);
            low += a.min(b);
            high += a.max(b);
        }
        f64::max(high, -low) + self.slack
    }

    pub(super) fn value(&self, values: &[f64]) -> f64 {
        let Some(mut corners) = self.corners.clone() else {
            return self.each_at_worst(values);
        };
        let (mut low, mut high) = (0.0, 0.0);
        for ((x, &(least, greatest)), factors) in values.iter().zip(&self.output).zip(&self.factors)
        {
            if let Some((first, second)) = *factors {
                *corners.of(first, second) = x * greatest;
                continue;
            }
            let (a, b) = (x * least, x * greatest);
            low += a.min(b);
            high += a.max(b);
        }
        let (least, most) = corners.extremes();
        f64::max(high + most, -(low + least)) + self.slack
    }
}

/// Returns which values are products of two velocities, or a velocity alone, that are as
/// large backwards as forwards: by their factors, of which 0 is the constant.
fn factors(
    terms: &[Key],
    output: &[(f64, f64)],
    joints: usize,
) -> (Vec<Option<(usize, usize)>>, Option<Corners>) {
    let velocities = |(&key, &(low, high)): (&Key, &(f64, f64))| {
        let [a, b] = rates(key).map(usize::from);
        let (first, second) = (a.min(b), a.max(b));
        let is_alone = key >> 16 == 0;
        (is_alone && low == -high && first < second && second <= joints).then_some((first, second))
    };
    let mut found: Vec<_> = terms.iter().zip(output).map(velocities).collect();
    let mut moving: Vec<usize> = found.iter().flatten().flat_map(|&(a, b)| [a, b]).collect();
    moving.retain(|factor| *factor > 0);
    moving.sort_unstable();
    moving.dedup();
    let place = |factor: usize| moving.binary_search(&factor).map_or(0, |place| 1 + place);
    for pair in found.iter_mut().flatten() {
        *pair = (place(pair.0), place(pair.1));
    }
    // One of them by itself is at its worst anyway.
    let is_some = found.iter().flatten().nth(1).is_some();
    let corners = Corners::new(moving.len()).filter(|_| is_some);
    (found, corners)
}

/// Returns what rounding costs a value at a point, against the sum of the magnitudes
/// of all its terms.
///
/// For each angle a term is multiplied by a sine or cosine of a multiple and added to others:
///
/// - libm's pair errs by less than 2·√2·u; each addition theorem adds to the
///   last multiple's error (as a vector) the first's and its own roundings,
///   2·√2·u at most: together less than 6·u for each unit of the degree;
/// - the product takes one rounding;
/// - the sum takes as many as it has terms.
///
/// Then rates: one product, and one addition for each value that is left. The
/// little on top is for products of these errors, which are below 1e-9.
fn roundings(degrees: &[u32], folds: &[(Vec<[u32; 2]>, usize)], left: usize) -> f64 {
    let mut count = 1 + left;
    for (&degree, (fold, len)) in degrees.iter().zip(folds) {
        let mut terms = vec![0; *len];
        for &[_, to] in fold {
            terms[to as usize] += 1;
        }
        let longest = terms.into_iter().max().unwrap_or(0);
        count += 6 * degree as usize + 1 + longest;
    }
    count as f64 * (f64::EPSILON / 2.0) * (1.0 + 1e-6)
}
