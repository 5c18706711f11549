//! The largest sum of magnitudes of products over a box, all of them at the same
//! state, from one polynomial in angles alone.
//!
//! **Soundness.** Let P = Σ_ρ ρ·p_ρ over products ρ of rates, |ρ| ≤ R_ρ, with p_ρ of
//! angles alone. For any μ_ρ > 0 and M ≥ Σ μ_ρ, by Cauchy and Schwarz, whatever the
//! rates,
//!
//! P² ≤ M·Σ_ρ R_ρ²·p_ρ²/μ_ρ = M²·T, where T = Σ_ρ R_ρ²·p_ρ²/(μ_ρ·M)
//!
//! and with g = w·M_P·M_Q, for any κ > 0,
//!
//! Σ w·|P|·|Q| ≤ Σ g·√(T_P·T_Q) ≤ G = ½·(κ·Σ g·T_P + Σ g·T_Q/κ)
//!
//! With μ_ρ = R_ρ·(root mean square of p_ρ) the mean of each T is one. The squares
//! of a vector's components add up to that of its length in G, so that most of its
//! terms cancel and it is not far from its mean: few points show a bound of it
//! that each P and Q by itself would take billions for.
//!
//! - [`series`]: P as Fourier series, a p_ρ each
//! - `spectrum`: their squares, added up

mod series;
mod spectrum;

use std::collections::BTreeMap;

use super::{GridEffort, largest, peak};
use crate::bound::expand::Polynomial;
use crate::bound::input_box::InputBox;
use crate::bound::work;
use series::{MAX_JOINTS, Series};
use spectrum::Spectrum;

/// What the waves that are left out may cost, against all.
const SMALL: f64 = 0.01;

/// Products of waves in the time of a point.
const PAIRS: usize = 16;

/// For the roundings of weights and of a few sums without negative terms.
const ROUNDINGS: f64 = 1.0 + 1e-9;

/// w·|P|·|Q|; without P, w·|Q|.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::bound) struct Product {
    /// w, at least zero.
    pub weight: f64,
    /// P, by its place among the polynomials.
    pub left: Option<usize>,
    /// What may stand in |P|'s place where that gives less.
    pub cap: f64,
    /// Q.
    pub right: usize,
}

/// A bound of a sum.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::bound) struct Largest {
    /// The bound.
    pub sum: f64,
    /// Of each product, whether its cap is in its P's place.
    pub capped: Vec<bool>,
}

/// Polynomials of which sums of products are to be bounded, every angle over the
/// whole circle.
pub(in crate::bound) struct Squares {
    series: Vec<Series>,
    limits: InputBox,
    sliding: Vec<bool>,
}

impl Squares {
    /// Makes room for so many polynomials that are zero yet; `None` for too many joints.
    pub(in crate::bound) fn new(
        count: usize,
        limits: InputBox,
        sliding: &[bool],
    ) -> Option<Squares> {
        let sliding = sliding.to_vec();
        (limits.joints() <= MAX_JOINTS).then(|| Squares {
            series: vec![Series::default(); count],
            limits,
            sliding,
        })
    }

    /// Sets a polynomial in multiples of its angles.
    pub(in crate::bound) fn set(&mut self, place: usize, harmonics: &Polynomial) {
        self.series[place] = Series::of(harmonics, &self.limits);
    }

    /// Returns a bound of a sum over the box; `None` if it cannot be written out.
    pub(in crate::bound) fn sum(
        &self,
        products: &[Product],
        closeness: GridEffort,
    ) -> Option<Largest> {
        let mean = |place: usize| self.series[place].mean;
        let is_capped = |product: &Product| product.left.is_some_and(|p| product.cap <= mean(p));
        let capped: Vec<bool> = products.iter().map(is_capped).collect();
        let pairs = products.iter().zip(&capped);
        let each = pairs.map(|(&product, &is_capped)| match is_capped {
            true => Product {
                weight: product.weight * product.cap,
                left: None,
                ..product
            },
            false => product,
        });
        let products: Vec<Product> = each.collect();
        let weights = Weights::of(&products, mean);
        if !weights.are_finite() {
            return None;
        }
        let cut = self.cut(&weights, closeness.points * PAIRS);
        let (joints, sliding) = (self.limits.joints(), &self.sliding);
        let sides = Sides::of(&products, &cut)?;
        let even = sides.polynomial(1.0, joints)?;
        // Both sides about equal there: neither is larger than it must.
        let at = peak(&even, &self.limits, sliding, closeness);
        let balance = (sides.right.value(&at) / sides.left.value(&at)).sqrt();
        let balance = if balance.is_normal() { balance } else { 1.0 };
        let polynomial = sides.polynomial(balance, joints)?;
        let found = largest(&polynomial, &self.limits, sliding, closeness);
        Some(Largest {
            sum: found * ROUNDINGS,
            capped,
        })
    }

    /// Returns the series that have a weight, without the waves that cost least for the products
    /// that they take: as many as may be, and more where more products than `most` are left.
    fn cut(&self, weights: &Weights, most: usize) -> BTreeMap<usize, Series> {
        let mut cut: BTreeMap<usize, Series> = BTreeMap::new();
        // A wave's cost, that against products, and where it is.
        let mut order: Vec<(f64, f64, [usize; 3])> = Vec::new();
        let (mut pairs, mut left) = (0, 0.0);
        for (&place, weight) in &weights.squares {
            let series = &self.series[place];
            let weight = weight.iter().sum::<f64>();
            left += SMALL * weight;
            for (index, part) in series.parts.iter().enumerate() {
                pairs += part.pairs();
                work::count(part.waves.len() / PAIRS);
                for (at, wave) in part.waves.iter().enumerate() {
                    let cost = weight * part.most * wave.size() / series.mean;
                    let each = cost / part.waves.len() as f64;
                    order.push((each, cost, [place, index, at]));
                }
            }
            cut.insert(place, series.clone());
        }
        order.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.2.cmp(&b.2)));
        for (_, cost, [place, index, at]) in order {
            left -= cost;
            if left < 0.0 && pairs <= most {
                break;
            }
            let saved = cut
                .get_mut(&place)
                .map(|series| series.leave_out(index, at));
            pairs -= saved.unwrap_or(0);
        }
        cut.values_mut().for_each(Series::close);
        cut
    }
}

/// Σ g·T_P and Σ g·T_Q.
struct Sides {
    left: Spectrum,
    right: Spectrum,
}

impl Sides {
    /// Returns `None` where numbers are too large or too small.
    fn of(products: &[Product], series: &BTreeMap<usize, Series>) -> Option<Sides> {
        let weights = Weights::of(products, |place| series[&place].mean);
        let side = |side: usize| {
            let mut sum = Spectrum::default();
            for (place, weight) in &weights.squares {
                let (Series { mean, parts, .. }, weight) = (&series[place], weight[side]);
                for part in parts.iter().filter(|_| weight > 0.0) {
                    work::count(part.pairs() / PAIRS);
                    sum.add_square(part.weighted(weight, *mean)?, &part.waves);
                }
            }
            Some(sum)
        };
        Some(Sides {
            left: side(0)?.plus(weights.constant),
            right: side(1)?,
        })
    }

    /// Returns G, or a little more than it.
    fn polynomial(&self, balance: f64, joints: usize) -> Option<Polynomial> {
        let sides = [(&self.left, 0.5 * balance), (&self.right, 0.5 / balance)];
        spectrum::polynomial(sides, joints)
    }
}

/// What the polynomials' T count with, and the sum of g where there is no P.
#[derive(Default)]
struct Weights {
    /// By place: as P and as Q.
    squares: BTreeMap<usize, [f64; 2]>,
    constant: f64,
}

impl Weights {
    fn of(products: &[Product], mean: impl Fn(usize) -> f64) -> Weights {
        let mut weights = Weights::default();
        for product in products {
            let g = product.weight * mean(product.right) * product.left.map_or(1.0, &mean);
            let mut add = |place: usize, side: usize| {
                weights.squares.entry(place).or_default()[side] += g;
            };
            add(product.right, 1);
            match product.left {
                Some(left) => add(left, 0),
                None => weights.constant += g,
            }
        }
        weights
    }

    fn are_finite(&self) -> bool {
        let squares = self.squares.values().flatten();
        self.constant.is_finite() && squares.copied().all(f64::is_finite)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bound::expand::{Key, shift};
    use crate::bound::grid::harmonics::multiple;
    use crate::interval::Interval;
    use crate::random::Random;

    const PI: f64 = std::f64::consts::PI;

    /// Returns a polynomial in multiples of two angles and a rate.
    fn polynomial(random: &mut Random) -> Polynomial {
        let mut terms: Polynomial = Vec::new();
        for _ in 0..6 {
            let mut key: Key = random.below(2) as Key;
            for joint in 0..2 {
                let multiple = random.below(3) as Key;
                let sine = match multiple {
                    0 => 0,
                    _ => 16 * random.below(2) as Key,
                };
                key |= (multiple | sine) << shift(joint);
            }
            if terms.iter().all(|(known, _)| *known != key) {
                terms.push((key, Interval::point(random.unit() - 0.5)));
            }
        }
        terms.sort_by_key(|term| term.0);
        terms
    }

    fn value(polynomial: &Polynomial, angles: [f64; 2], rate: f64) -> f64 {
        let term = |&(key, x): &(Key, Interval)| {
            let factor = |joint: usize| {
                let (k, sine) = multiple(key, joint);
                let (sin, cos) = libm::sincos(f64::from(k) * angles[joint]);
                if sine { sin } else { cos }
            };
            let rate = if key & 1 == 1 { rate } else { 1.0 };
            x.mid() * factor(0) * factor(1) * rate
        };
        polynomial.iter().map(term).sum()
    }

    fn limits() -> InputBox {
        InputBox {
            position: vec![Interval::symmetric(4.0); 2],
            velocity: vec![Interval::new(-1.0, 2.0).unwrap(), Interval::ZERO],
            acceleration: vec![Interval::ZERO; 2],
        }
    }

    /// Above every value of a dense grid, and not far.
    #[test]
    fn the_largest_sum_is_bounded_closely() {
        let mut random = Random::new(41);
        let mut ratios: Vec<f64> = Vec::new();
        for _ in 0..12 {
            let polynomials: Vec<Polynomial> = (0..5).map(|_| polynomial(&mut random)).collect();
            let mut squares = Squares::new(5, limits(), &[false; 2]).unwrap();
            for (place, polynomial) in polynomials.iter().enumerate() {
                squares.set(place, polynomial);
            }
            let product = |k: usize, random: &mut Random| Product {
                weight: 0.5 + random.unit(),
                left: (k > 0).then_some(k),
                cap: [f64::INFINITY, 0.8][k % 2],
                right: (k + 1) % 5,
            };
            let products: Vec<Product> = (0..4).map(|k| product(k, &mut random)).collect();
            let closeness = GridEffort {
                points: 1 << 18,
                close: 0.02,
                starts: 4,
            };
            let found = squares.sum(&products, closeness).unwrap();
            let mut most: f64 = 0.0;
            for place in 0..120 * 120 {
                let angles = [place % 120, place / 120].map(|k| 2.0 * PI * f64::from(k) / 120.0);
                for rate in [-1.0, 0.5, 2.0] {
                    let size = |place: usize| value(&polynomials[place], angles, rate).abs();
                    let each = products.iter().zip(&found.capped).map(|(p, capped)| {
                        let left = if *capped {
                            p.cap
                        } else {
                            p.left.map_or(1.0, size)
                        };
                        p.weight * left * size(p.right)
                    });
                    most = most.max(each.sum());
                }
            }
            assert!(found.sum >= most, "{} {most}", found.sum);
            ratios.push(found.sum / most);
        }
        ratios.sort_by(f64::total_cmp);
        assert!(ratios[5] < 1.6 && ratios[11] < 2.2, "{ratios:?}");
    }

    /// A vector that two angles turn has the length that it had: 1, whatever they are.
    #[test]
    fn the_components_of_a_vector_add_up_to_its_length() {
        let point = Interval::point;
        let (cos, sin) = (
            |joint: usize| 1 << shift(joint),
            |joint: usize| 17 << shift(joint),
        );
        // (cos a · cos b, sin a · cos b, sin b)
        let vector: [Polynomial; 3] = [
            vec![(cos(0) | cos(1), point(1.0))],
            vec![(sin(0) | cos(1), point(1.0))],
            vec![(sin(1), point(1.0))],
        ];
        let mut squares = Squares::new(3, limits(), &[false; 2]).unwrap();
        for (place, component) in vector.iter().enumerate() {
            squares.set(place, component);
        }
        let products: Vec<Product> = (0..3)
            .map(|place| Product {
                weight: 1.0,
                left: Some(place),
                cap: f64::INFINITY,
                right: place,
            })
            .collect();
        let found = squares.sum(&products, GridEffort::fine(64)).unwrap();
        assert!((1.0..1.05).contains(&found.sum), "{}", found.sum);
    }

    /// What numbers cannot hold does no harm.
    #[test]
    fn extremes_have_no_bound_rather_than_a_wrong_one() {
        let mut squares = Squares::new(2, limits(), &[false; 2]).unwrap();
        let product = Product {
            weight: 1.0,
            left: Some(0),
            cap: f64::INFINITY,
            right: 1,
        };
        let few = GridEffort::fine(1 << 8);
        assert_eq!(squares.sum(&[product], few).unwrap().sum, 0.0);
        squares.set(1, &vec![(0, Interval::point(1e-300))]);
        assert_eq!(squares.sum(&[product], few).unwrap().sum, 0.0);
        // Too small to be squared, too large, and no number: nothing is said of these.
        for x in [1e-200, 1e-120, 1e120]
            .map(Interval::point)
            .into_iter()
            .chain([Interval::ALL])
        {
            squares.set(0, &vec![(1, x)]);
            squares.set(1, &vec![(0, Interval::point(1e-100))]);
            assert_eq!(squares.sum(&[product], few), None, "{x:?}");
        }
    }
}
