//! Squares of Fourier series, added up.

use std::collections::BTreeMap;

use rustc_hash::FxHashMap;

use super::ROUNDINGS;
use super::series::{Wave, multiples};
use crate::bound::expand::{Key, Polynomial, shift};
use crate::interval::Interval;

/// What the smallest terms may come to, against the mean.
const REST: f64 = 0.005;

/// What terms of the highest multiples may come to: points lie the further apart.
const HIGHEST: f64 = 0.02;

/// A sum of waves, by their keys.
#[derive(Debug, Default)]
pub(super) struct Spectrum {
    waves: FxHashMap<i128, [f64; 2]>,
    /// What the magnitudes of all that was added come to.
    sizes: f64,
    /// How often something was added.
    count: usize,
}

impl Spectrum {
    /// Adds a multiple of a square.
    ///
    /// Of two waves a, b of keys k < l the square has 2·a·b at k + l and 2·b·ā at l − k,
    /// and the mirror images of both; of a by itself a² at 2·k and 2·|a|² at zero.
    pub(super) fn add_square(&mut self, weight: f64, waves: &[Wave]) {
        let size: f64 = waves.iter().map(Wave::size).sum();
        self.sizes += weight * size * size;
        self.count += waves.len() * waves.len();
        let mut add = |key: i128, re: f64, im: f64| {
            let sum = self.waves.entry(key).or_default();
            *sum = [sum[0] + re, sum[1] + im];
        };
        for (index, a) in waves.iter().enumerate() {
            let [re, im] = a.value.map(|x| weight * x);
            let [x, y] = a.value;
            add(2 * a.key, re * x - im * y, re * y + im * x);
            if a.key != 0 {
                add(0, 2.0 * (re * x + im * y), 0.0);
            }
            let [re, im] = [2.0 * re, 2.0 * im];
            for b in &waves[index + 1..] {
                let [x, y] = b.value;
                add(a.key + b.key, re * x - im * y, re * y + im * x);
                if a.key != 0 {
                    add(b.key - a.key, re * x + im * y, re * y - im * x);
                }
            }
        }
    }

    /// Returns it with a constant added.
    pub(super) fn plus(mut self, constant: f64) -> Spectrum {
        self.waves.entry(0).or_default()[0] += constant;
        self.sizes += constant;
        self.count += 1;
        self
    }

    /// Returns the value at angles.
    pub(super) fn value(&self, angles: &[f64]) -> f64 {
        let waves = self.sorted();
        waves.iter().map(|wave| wave.at(angles)).sum()
    }

    /// Returns the smallest first, so that sums do not depend on how they are stored.
    fn sorted(&self) -> Vec<Wave> {
        let waves = self.waves.iter();
        let mut waves: Vec<Wave> = waves.map(|(&key, &value)| Wave { key, value }).collect();
        let order = |a: &Wave, b: &Wave| a.size().total_cmp(&b.size()).then(a.key.cmp(&b.key));
        waves.sort_unstable_by(order);
        waves
    }
}

/// Returns a weighted sum of spectra in multiples of their angles, with what is left out of it
/// added at most, so that it is nowhere less; `None` if a multiple does not fit or a sum
/// is no number.
pub(super) fn polynomial(parts: [(&Spectrum, f64); 2], joints: usize) -> Option<Polynomial> {
    let mut all = Spectrum::default();
    for (part, weight) in parts {
        all.sizes += weight * part.sizes;
        all.count += part.count;
        // Of each key there is one wave, so that their order does not matter.
        for (&key, value) in &part.waves {
            let sum = all.waves.entry(key).or_default();
            *sum = [sum[0] + weight * value[0], sum[1] + weight * value[1]];
        }
    }
    if !all.sizes.is_finite() {
        return None;
    }
    // Each of so many sums rounds by no more than a part of all.
    let mut rest = all.sizes * (all.count + 64) as f64 * f64::EPSILON;
    let mean = all.waves.get(&0).map_or(0.0, |value| value[0]);
    let waves = without_highest(all.sorted(), HIGHEST * mean, joints, &mut rest);
    let mut left = REST * mean;
    let mut terms: BTreeMap<Key, f64> = BTreeMap::new();
    let mut sizes = 0.0;
    for wave in waves {
        left -= wave.size();
        if left > 0.0 && wave.key != 0 {
            rest += wave.size();
            continue;
        }
        // 2·Re (c·Π (cos kq ± i·sin kq))
        let mut each = vec![(0 as Key, wave.value.map(|x| wave.times() * x))];
        for (joint, k) in multiples(wave.key, joints).enumerate() {
            if k == 0 {
                continue;
            }
            let (k, sign) = (k.unsigned_abs(), if k < 0 { -1.0 } else { 1.0 });
            if k > 15 {
                return None;
            }
            let both = |&(key, [re, im]): &(Key, [f64; 2])| {
                let cosine = key | k << shift(joint);
                let sine = cosine | 16 << shift(joint);
                [(cosine, [re, im]), (sine, [-sign * im, sign * re])]
            };
            each = each.iter().flat_map(both).collect();
        }
        for (key, [re, _]) in each {
            *terms.entry(key).or_default() += re;
            sizes += re.abs();
        }
    }
    rest += sizes * (terms.len() + 64) as f64 * f64::EPSILON;
    *terms.entry(0).or_default() += rest * ROUNDINGS;
    let terms = terms.into_iter().filter(|(_, x)| *x != 0.0);
    Some(terms.map(|(key, x)| (key, Interval::point(x))).collect())
}

/// Returns it without the highest multiples of each angle, as far as they come to no more than a
/// part of an allowance each.
fn without_highest(
    mut waves: Vec<Wave>,
    allowance: f64,
    joints: usize,
    rest: &mut f64,
) -> Vec<Wave> {
    for joint in 0..joints {
        let of = |wave: &Wave| multiples(wave.key, joints).nth(joint).map_or(0, i128::abs);
        let mut sizes: BTreeMap<i128, f64> = BTreeMap::new();
        for wave in &waves {
            *sizes.entry(of(wave)).or_default() += wave.size();
        }
        let mut left = allowance / joints as f64;
        let highest = sizes.iter().rev().take_while(|(multiple, size)| {
            left -= **size;
            left >= 0.0 && **multiple > 0
        });
        let (count, size) = highest.fold((0, 0.0), |(n, sum), (_, size)| (n + 1, sum + size));
        let kept = sizes.keys().nth_back(count).copied().unwrap_or(0);
        *rest += size;
        waves.retain(|wave| of(wave) <= kept);
    }
    waves
}
