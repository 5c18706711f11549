//! F of `maximum` as lists of coefficients, one a level: behind each, one angle more is
//! put in.

use std::collections::BTreeMap;

use crate::interval::sin_cos;
use crate::polynomial::{ANGLES, Key, MAX_JOINTS, Polynomial, Variable, exponent, key};
use crate::ring::Ring;

/// One angle's turn: what its powers are multiplied with, and where that is added to.
pub(crate) struct Level {
    pub(crate) degree: f64,
    pub(crate) range: Option<[f64; 2]>,
    powers: Vec<[u32; 2]>,
    /// The power of each coefficient, and its place among those of the next level.
    moves: Vec<(u32, u32)>,
}

fn distinct<T: Clone + Ord>(each: Vec<T>) -> (Vec<T>, Vec<u32>) {
    let mut all = each.clone();
    all.sort_unstable();
    all.dedup();
    let place = |own: &T| all.binary_search(own).unwrap_or_default() as u32;
    let places = each.iter().map(place).collect();
    (all, places)
}

/// F, and the coefficients that are left at each level.
pub(crate) struct Search {
    pub(crate) levels: Vec<Level>,
    pub(crate) values: Vec<Vec<f64>>,
    /// The factors of each value behind the last level that is a product of velocities which are
    /// as large backwards as forwards: joint k's is factor k + 1, and factor 0 is 1.
    factors: Vec<Option<[usize; 2]>>,
    /// The sum of the magnitudes of all terms, before they were added up.
    pub(crate) mass: f64,
    pub(crate) steps: u64,
}

impl Search {
    pub(crate) fn new(polynomial: &Polynomial, ring: &Ring, steps: u64) -> Search {
        // Groups by rates and errors; the first one is the sum of all at the middle.
        let mut groups: BTreeMap<(Key, Key), f64> = BTreeMap::new();
        let mut mass = 0.0;
        for &(key, coefficient) in &polynomial.terms {
            let (angles, others) = (key & ANGLES, key & !ANGLES);
            let (middle, radius) = ring.factor(others);
            mass += (middle.abs() + radius) * coefficient.abs();
            if middle != 0.0 {
                *groups.entry((0, angles)).or_default() += middle * coefficient;
            }
            if radius > 0.0 {
                // No key has this bit.
                *groups.entry((others | 1 << 127, angles)).or_default() += radius * coefficient;
            }
        }
        let mut keys: Vec<(Key, Key)> = groups.keys().copied().collect();
        let mut search = Search {
            levels: Vec::new(),
            values: vec![groups.into_values().collect()],
            factors: Vec::new(),
            mass,
            steps,
        };
        let both = [Variable::Sin, Variable::Cos];
        let power = |key: Key, joint: usize| both.map(|own| exponent(key, own, joint));
        let degree = |joint: usize, keys: &[(Key, Key)]| {
            let powers = keys.iter().map(|key| power(key.1, joint));
            powers.map(|[sin, cos]| sin + cos).max().unwrap_or(0)
        };
        let mut left: Vec<usize> = (0..ring.angles.len()).collect();
        left.retain(|&joint| degree(joint, &keys) > 0);
        // The last one is the first to be put in: of short ranges, so that the others are
        // not bounded over whole turns of it, then of the highest powers.
        let length = |joint: usize| ring.angles[joint].map_or(f64::MAX, |[low, high]| high - low);
        left.sort_by(|&a, &b| {
            let powers = || degree(a, &keys).cmp(&degree(b, &keys));
            length(b).total_cmp(&length(a)).then_with(powers)
        });
        while let Some(joint) = left.pop() {
            let without = |&(group, angles): &(Key, Key)| {
                let [sin, cos] = power(angles, joint).map(Key::from);
                let taken = key(Variable::Sin, joint) * sin + key(Variable::Cos, joint) * cos;
                (group, angles - taken)
            };
            let (next, targets) = distinct(keys.iter().map(without).collect());
            let (powers, each) = distinct(keys.iter().map(|key| power(key.1, joint)).collect());
            search.levels.push(Level {
                degree: f64::from(degree(joint, &keys)),
                range: ring.angles[joint],
                moves: each.into_iter().zip(targets).collect(),
                powers,
            });
            search.values.push(vec![0.0; next.len()]);
            keys = next;
        }
        let power = |k: usize| k.checked_sub(1).map_or(0, |k| key(Variable::Velocity, k));
        let factors = |&(group, _): &(Key, Key)| {
            let others = group & !(1 << 127);
            let second = (0..=MAX_JOINTS).rfind(|&k| others >= power(k))?;
            let first = (0..second.max(1)).find(|&k| others == power(k) + power(second))?;
            (group == 0 || ring.factor(others).0 == 0.0).then_some([first, second])
        };
        search.factors = keys.iter().map(factors).collect();
        search
    }

    pub(crate) fn fix(&mut self, level: usize, angle: f64) {
        let (sin, cos) = sin_cos(angle);
        let Level { powers, moves, .. } = &self.levels[level];
        let power = |&[s, c]: &[u32; 2]| sin.powi(s as i32) * cos.powi(c as i32);
        let table: Vec<f64> = powers.iter().map(power).collect();
        let (before, behind) = self.values.split_at_mut(level + 1);
        let (from, to) = (&before[level], &mut behind[0]);
        to.fill(0.0);
        for (value, &(power, target)) in from.iter().zip(moves) {
            to[target as usize] += value * table[power as usize];
        }
        self.steps = self.steps.saturating_sub(from.len() as u64 + 20);
    }

    /// Returns a bound of F without looking at the angles from a level on; behind the last, F.
    pub(crate) fn norm(&self, level: usize) -> f64 {
        let values = &self.values[level];
        if level < self.levels.len() {
            return values.iter().map(|value| value.abs()).sum();
        }
        let (mut products, mut radius) = ([[0.0; MAX_JOINTS + 1]; MAX_JOINTS + 1], 0.0);
        for (value, factors) in values.iter().zip(&self.factors) {
            match *factors {
                Some([first, second]) => products[first][second] = *value,
                None => radius += value.abs(),
            }
        }
        let [low, high] = corners(&products, 1, products[0][0], products[0]);
        radius + high.max(-low)
    }

    /// Returns a bound of the second derivative of F by a level's angle, which is not put in.
    pub(crate) fn bend(&self, level: usize) -> f64 {
        let Level { powers, moves, .. } = &self.levels[level];
        let each = self.values[level].iter().zip(moves);
        let sizes = each.map(|(value, &(power, _))| {
            let factors: u32 = powers[power as usize].iter().sum();
            f64::from(factors) * value.abs()
        });
        sizes.sum::<f64>() * (1.0 + 1e-9)
    }
}

/// The sum is linear in each factor, so that its ends are where all are −1 or 1; factor 0 is 1.
/// Those from `next` on are multiplied with `linear`, the others are in `sum`.
fn corners<const N: usize>(
    products: &[[f64; N]; N],
    next: usize,
    sum: f64,
    linear: [f64; N],
) -> [f64; 2] {
    let Some(row) = products.get(next) else {
        return [sum; 2];
    };
    let of = |sign: f64| {
        let linear = std::array::from_fn(|k| linear[k] + sign * row[k]);
        corners(products, next + 1, sum + sign * linear[next], linear)
    };
    if linear[next] == 0.0 && *row == [0.0; N] {
        return of(0.0);
    }
    let (plus, minus) = (of(1.0), of(-1.0));
    [plus[0].min(minus[0]), plus[1].max(minus[1])]
}
