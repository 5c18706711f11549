//! A polynomial in powers of sines and cosines, as multiples of angles.

use std::collections::HashMap;

use super::corners::{Factor, MOST_VELOCITIES};
use crate::polynomial::{MAX_LOADS, Polynomial, Powers, Variable, exponent};
use crate::ring::Ring;

/// The number of a group in the lowest bits, then for each angle its multiple and whether it is a
/// sine.
pub(super) type TermKey = u128;
const GROUP: usize = 16;
const WIDTH: usize = 5;
/// One above the highest power of a cosine.
const MOST_POWER: u32 = 16;
/// The most groups of monomials, and the most joints.
const MOST_GROUPS: usize = 1 << GROUP;
/// Terms below this share of the largest one, and of the bound that is wanted if all were so large,
/// count with their magnitudes.
const NEGLIGIBLE: f64 = 1e-8;
const NEGLIGIBLE_OF_WANTED: f64 = 1e-3;

fn shift(joint: usize) -> usize {
    GROUP + WIDTH * joint
}

/// Returns an angle's multiple, and whether it is a sine.
pub(super) fn multiple(key: TermKey, joint: usize) -> (u32, bool) {
    let bits = (key >> shift(joint)) as u32;
    (bits & 15, bits >> 4 & 1 == 1)
}

pub(super) fn bits(joint: usize) -> TermKey {
    31 << shift(joint)
}

/// Returns the key of a term without its phases: those that differ by them stand together.
pub(super) fn without_phases(key: TermKey) -> TermKey {
    let phases =
        (0..(TermKey::BITS as usize - GROUP) / WIDTH).fold(0, |mask, k| mask | 16 << shift(k));
    key & !phases
}

pub(super) fn group(key: TermKey) -> usize {
    (key & ((1 << GROUP) - 1)) as usize
}

pub(super) fn without_group(key: TermKey) -> TermKey {
    key >> GROUP << GROUP
}

#[derive(Default)]
pub(super) struct Terms {
    pub(super) terms: Vec<(TermKey, f64)>,
    /// The factor of each group of terms.
    pub(super) factors: Vec<Factor>,
    /// The velocities whose signs matter.
    pub(super) velocities: usize,
    pub(super) rest: f64,
}

/// cosᶜ·sinˢ, s at most one, as multiples of the angle: with cos for s = 0, else with sin.
fn of_power(c: u32, s: u32) -> Vec<(u32, f64)> {
    let mut parts = vec![0.0; c as usize + 2];
    let mut part = 0.5f64.powi(c as i32);
    for j in 0..=c {
        // cosᶜ is the sum of cos (c − 2j) by binomials; cos a sin b is ½ (sin(a + b) − sin(a − b)).
        let k = f64::from(c) - 2.0 * f64::from(j);
        let (up, down) = (k + 1.0, k - 1.0);
        if s == 0 {
            parts[k.abs() as usize] += part;
        } else {
            parts[up.abs() as usize] += 0.5 * part * if up < 0.0 { -1.0 } else { 1.0 };
            parts[down.abs() as usize] -= 0.5 * part * if down < 0.0 { -1.0 } else { 1.0 };
            parts[0] = 0.0;
        }
        part = part * f64::from(c - j) / f64::from(j + 1);
    }
    let parts = (0..).zip(parts);
    parts.filter(|(_, part)| *part != 0.0).collect()
}

impl Terms {
    pub(super) fn new(polynomial: &Polynomial, ring: &Ring, wanted: f64) -> Terms {
        let both = |c: u32| [0, 1].map(|s| of_power(c, s));
        let powers: Vec<[Vec<(u32, f64)>; 2]> = (0..MOST_POWER).map(both).collect();
        let mut known: HashMap<Powers, (f64, f64)> = HashMap::new();
        let mut summands: Vec<((Powers, TermKey), f64)> = Vec::new();
        let [mut parts, mut next] = [Vec::new(), Vec::new()];
        let mut mass = 0.0;
        for &(key, value) in &polynomial.terms {
            parts.clear();
            parts.push((0, value));
            for joint in 0..ring.angles.len() {
                let [s, c] = [Variable::Sin, Variable::Cos].map(|kind| exponent(key, kind, joint));
                if s + c > 0 {
                    next.clear();
                    for &(key, value) in &parts {
                        let multiples = powers[c as usize][s as usize].iter();
                        next.extend(multiples.map(|&(k, part)| {
                            let bits = TermKey::from(k | s << 4);
                            (key | bits << shift(joint), value * part)
                        }));
                    }
                    std::mem::swap(&mut parts, &mut next);
                }
            }
            let group = key.without_angles();
            let factor = known.entry(group).or_insert_with(|| ring.factor(group));
            let (middle, radius) = *factor;
            for &(key, value) in &parts {
                mass += value.abs() * (middle.abs() + radius);
                if middle != 0.0 {
                    summands.push(((Powers::default(), key), value * middle));
                }
                if radius != 0.0 {
                    summands.push(((group.marked(), key), value * radius));
                }
            }
        }
        // Stable: sums are taken in the order of the terms on every machine.
        summands.sort_by_key(|summand| summand.0);
        let runs = summands.chunk_by(|a, b| a.0 == b.0);
        let sums: Vec<((Powers, TermKey), f64)> = runs
            .map(|run| (run[0].0, run.iter().map(|summand| summand.1).sum::<f64>()))
            .collect();
        let mut groups: Vec<Powers> = sums.iter().map(|sum| sum.0.0).collect();
        groups.dedup();
        // Beyond, the terms of all others count with their magnitudes.
        groups.truncate(MOST_GROUPS);
        let sizes = sums.iter().map(|sum| sum.1.abs());
        let largest = sizes.fold(0.0, f64::max);
        let of_wanted = NEGLIGIBLE_OF_WANTED * wanted.max(0.0) / sums.len() as f64;
        let least = (NEGLIGIBLE * largest).min(of_wanted);
        // Powers of doubles, products and sums of these were rounded.
        let mut rest = polynomial.rest + mass * 64.0 * f64::EPSILON;
        let mut terms = Vec::new();
        for ((group, key), value) in sums {
            match groups.binary_search(&group) {
                Ok(id) if value.abs() > least => terms.push((key | id as TermKey, value)),
                _ => rest += value.abs(),
            }
        }
        let (factors, velocities) = factors(&groups, ring);
        Terms {
            terms,
            factors,
            velocities,
            rest: rest * (1.0 + 1e-9),
        }
    }

    /// Returns Σ √(Σ c²), over the phases of each multiple of each group.
    pub(super) fn length(&self) -> f64 {
        let mut terms = self.terms.clone();
        terms.sort_unstable_by_key(|term| without_phases(term.0));
        let same =
            |a: &(TermKey, f64), b: &(TermKey, f64)| without_phases(a.0) == without_phases(b.0);
        let runs = terms.chunk_by(same);
        let lengths = runs.map(|run| run.iter().map(|term| term.1 * term.1).sum::<f64>().sqrt());
        (lengths.sum::<f64>() + self.rest) * (1.0 + 1e-9)
    }
}

/// Returns the factor of each group, and the number of velocities whose signs matter.
fn factors(groups: &[Powers], ring: &Ring) -> (Vec<Factor>, usize) {
    use Variable::{Acceleration, EvenError, OddError};
    let joints = ring.width();
    // One or two velocities, with nothing else, that are as large backwards as forwards.
    let product = |group: &Powers| -> Option<Vec<usize>> {
        let powers = group.unmarked();
        let power = |joint: usize| exponent(powers, Variable::Velocity, joint);
        let others = [Acceleration, EvenError, OddError];
        let is_bare = |joint: usize| others.map(|kind| exponent(powers, kind, joint)) == [0; 3];
        let is_product = powers != Powers::default()
            && (0..joints).all(|joint| power(joint) <= 1 && is_bare(joint))
            && (0..MAX_LOADS).all(|entry| exponent(powers, Variable::Load, entry) == 0)
            && ring.factor(powers).0 == 0.0;
        let list: Vec<usize> = (0..joints).filter(|joint| power(*joint) == 1).collect();
        (is_product && (1..=2).contains(&list.len())).then_some(list)
    };
    let products: Vec<Option<Vec<usize>>> = groups.iter().map(product).collect();
    let mut moving: Vec<usize> = products.iter().flatten().flatten().copied().collect();
    moving.sort_unstable();
    moving.dedup();
    let is_linear = products.iter().flatten().any(|product| product.len() == 1);
    // If nothing is linear, the last velocity may be one: all signs at once change nothing.
    let free = moving.len() - usize::from(!is_linear && !moving.is_empty());
    let bit = |joint: &usize| match moving.binary_search(joint) {
        Ok(place) if place < free => 1u32 << place,
        _ => 0,
    };
    let factor = |(group, product): (&Powers, &Option<Vec<usize>>)| match product {
        _ if *group == Powers::default() => Factor::One,
        Some(list) if free <= MOST_VELOCITIES => {
            Factor::Place(list.iter().fold(0, |set, joint| set ^ bit(joint)))
        }
        _ => Factor::Other,
    };
    let factors = groups.iter().zip(&products).map(factor).collect();
    let velocities = if free <= MOST_VELOCITIES { free } else { 0 };
    (factors, velocities)
}
