//! Polynomials as Fourier series, one for each product of rates.

use std::collections::BTreeMap;

use super::ROUNDINGS;
use crate::bound::expand::{Key, Polynomial};
use crate::bound::grid::harmonics::{bits, multiple};
use crate::bound::grid::range;
use crate::bound::input_box::InputBox;
use crate::interval::Interval;

/// The multiple of each joint's angle, in balanced digits of so many bits: sums of keys
/// are keys of sums.
const DIGIT: usize = 6;

/// The most joints that fit such a key.
pub(super) const MAX_JOINTS: usize = 20;

/// What the waves that are dropped at once may come to, against all.
const NEGLIGIBLE: f64 = 1e-4;

/// What is left out counts at least so much, against all: far more than underflow takes.
const UNDERFLOW: f64 = 1e-20;

/// Between its inverse and itself products of three numbers neither underflow nor overflow.
const SANE: f64 = 1e90;

/// 2·Re (c·e^{i·k·q}) of multiples k, the last one that is not zero being positive;
/// of k = 0 Re c.
#[derive(Clone, Copy, Debug)]
pub(super) struct Wave {
    pub key: i128,
    /// c
    pub value: [f64; 2],
}

impl Wave {
    /// Returns how often Re c·e^{i·k·q} counts: a key above zero stands for two mirror images.
    pub(super) fn times(&self) -> f64 {
        if self.key == 0 { 1.0 } else { 2.0 }
    }

    /// Returns the largest magnitude.
    pub(super) fn size(&self) -> f64 {
        self.times() * length(self.value)
    }

    /// Returns the value at angles.
    pub(super) fn at(&self, angles: &[f64]) -> f64 {
        let each = angles.iter().zip(multiples(self.key, angles.len()));
        let (sin, cos) = libm::sincos(each.map(|(angle, k)| angle * k as f64).sum());
        self.times() * (self.value[0] * cos - self.value[1] * sin)
    }
}

/// Returns the length of a complex number or more: what is too small to be squared counts.
fn length([re, im]: [f64; 2]) -> f64 {
    (re * re + im * im).sqrt() + f64::MIN_POSITIVE.sqrt()
}

/// Returns the multiples of a key, joint by joint.
pub(super) fn multiples(mut key: i128, joints: usize) -> impl Iterator<Item = i128> {
    let half = 1 << (DIGIT - 1);
    (0..joints).map(move |_| {
        let k = ((key + half) & ((1 << DIGIT) - 1)) - half;
        key = (key - k) >> DIGIT;
        k
    })
}

/// ρ·p with |ρ| ≤ R.
#[derive(Clone, Debug)]
pub(super) struct Part {
    /// R
    pub most: f64,
    /// p, by ascending keys.
    pub waves: Vec<Wave>,
    /// μ
    pub mean: f64,
    /// How many waves are not left out.
    count: usize,
}

impl Part {
    fn new(most: f64, waves: Vec<Wave>) -> Part {
        let squares = waves.iter().map(|wave| wave.size() * length(wave.value));
        let mean = most * squares.sum::<f64>().sqrt();
        Part {
            most,
            // Any above zero will do; what is no number stays none.
            mean: if mean == 0.0 { f64::MIN_POSITIVE } else { mean },
            count: waves.len(),
            waves,
        }
    }

    /// Returns R²/(μ·M), times a weight; `None` where it, or a square of the waves, may underflow
    /// or overflow.
    pub(super) fn weighted(&self, weight: f64, mean: f64) -> Option<f64> {
        let factors = [weight, self.most / self.mean, self.most / mean];
        let sane = |x: &f64| (1.0 / SANE..SANE).contains(x);
        factors.iter().all(sane).then(|| factors.iter().product())
    }

    /// Returns how many products its square takes.
    pub(super) fn pairs(&self) -> usize {
        self.count * self.count
    }
}

/// P = Σ ρ·p
#[derive(Clone, Debug, Default)]
pub(super) struct Series {
    pub parts: Vec<Part>,
    /// M
    pub mean: f64,
    /// What the waves left out come to.
    off: f64,
}

impl Series {
    /// Makes the series of a polynomial in multiples of its angles.
    pub(super) fn of(harmonics: &Polynomial, limits: &InputBox) -> Series {
        let all = (0..limits.joints()).fold(0, |all: Key, joint| all | bits(joint));
        // By what is no angle: the middle of its range is a part of p for ρ = 1.
        let mut parts: BTreeMap<Key, (f64, BTreeMap<Key, Interval>)> = BTreeMap::new();
        for &(key, x) in harmonics {
            let (others, angles) = (key & !all, key & all);
            let rates = range(others, limits);
            if rates.mid() != 0.0 {
                let (_, own) = parts.entry(0).or_insert((1.0, BTreeMap::new()));
                let sum = own.entry(angles).or_insert(Interval::ZERO);
                *sum = *sum + x * Interval::point(rates.mid());
            }
            if rates.radius() > 0.0 {
                let part = (rates.radius(), BTreeMap::new());
                // Of no rates the range is a point.
                let (_, own) = parts.entry(others).or_insert(part);
                own.insert(angles, x);
            }
        }
        let mut series = Series::default();
        for (most, terms) in parts.into_values() {
            let sizes: f64 = terms.values().map(|x| x.magnitude()).sum();
            let radii: f64 = terms.values().map(|x| x.radius()).sum();
            // A wave is a sum of fewer terms.
            let rounded = (terms.len() + 8) as f64 * f64::EPSILON * sizes;
            series.off += most * (radii + rounded);
            series
                .parts
                .push(Part::new(most, waves(&terms, limits.joints())));
        }
        let sum: f64 = series.parts.iter().map(|part| part.mean).sum();
        let count: usize = series.parts.iter().map(|part| part.waves.len()).sum();
        let least = NEGLIGIBLE * sum / count as f64;
        for index in 0..series.parts.len() {
            for at in 0..series.parts[index].waves.len() {
                let Part { most, waves, .. } = &series.parts[index];
                if most * waves[at].size() < least {
                    series.leave_out(index, at);
                }
            }
        }
        series.close();
        series
    }

    /// Leaves a wave out, once; returns how many products that saves.
    pub(super) fn leave_out(&mut self, index: usize, at: usize) -> usize {
        let part = &mut self.parts[index];
        let before = part.pairs();
        self.off += part.most * part.waves[at].size();
        part.waves[at].value = [0.0; 2];
        part.count -= 1;
        before - part.pairs()
    }

    /// Makes what was left out a part of its own.
    pub(super) fn close(&mut self) {
        let mut parts = Vec::with_capacity(self.parts.len() + 1);
        for mut part in self.parts.drain(..) {
            part.waves.retain(|wave| wave.value != [0.0; 2]);
            if !part.waves.is_empty() {
                parts.push(Part::new(part.most, part.waves));
            }
        }
        let sum = |parts: &[Part]| parts.iter().map(|part| part.mean).sum::<f64>();
        // What is no number stays none, so that M is none.
        let least = UNDERFLOW * sum(&parts);
        let off = if self.off < least { least } else { self.off };
        if off != 0.0 {
            let one = Wave {
                key: 0,
                value: [1.0, 0.0],
            };
            parts.push(Part::new(off * ROUNDINGS, vec![one]));
        }
        self.off = 0.0;
        self.mean = sum(&parts) * ROUNDINGS;
        self.parts = parts;
    }
}

/// Terms of cosines and sines as waves.
fn waves(terms: &BTreeMap<Key, Interval>, joints: usize) -> Vec<Wave> {
    let mut waves: BTreeMap<i128, [f64; 2]> = BTreeMap::new();
    for (&key, x) in terms {
        let mut each = vec![(0i128, [x.mid(), 0.0])];
        for joint in 0..joints {
            let (k, is_sine) = multiple(key, joint);
            if k == 0 {
                continue;
            }
            let digit = i128::from(k) << (DIGIT * joint);
            let both = |&(key, [re, im]): &(i128, [f64; 2])| {
                let [re, im] = [0.5 * re, 0.5 * im];
                // cos x = ½·(e^{ix} + e^{−ix}), sin x = ½·(−i·e^{ix} + i·e^{−ix})
                match is_sine {
                    false => [(key + digit, [re, im]), (key - digit, [re, im])],
                    true => [(key + digit, [im, -re]), (key - digit, [-im, re])],
                }
            };
            each = each.iter().flat_map(both).collect();
        }
        for (key, [re, im]) in each.into_iter().filter(|(key, _)| *key >= 0) {
            let sum = waves.entry(key).or_default();
            *sum = [sum[0] + re, sum[1] + im];
        }
    }
    let waves = waves.into_iter();
    waves.map(|(key, value)| Wave { key, value }).collect()
}
