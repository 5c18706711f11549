//! The largest sum of magnitudes of products over a box, all of them at the
//! same state.
//!
//! **Soundness.** Let S = Σ w·|P|·|Q| be largest, M, at x₀ and some rates, and
//! hold the rates. With the signs that the products have at x₀,
//! T = Σ ±w·P·Q is a trigonometric polynomial with |T| ≤ S everywhere and
//! T(x₀) = M = max |T|. So what Riesz and Bernstein say of T's value beside x₀
//! holds of S, which is at least |T|: the [cells](super::cells) are those of a
//! single polynomial whose degree is the products' largest. What is left to
//! the slack of P or Q is a term of its own there: (|P| + s)·(|Q| + t) is a
//! sum of four such products.
//!
//! At a point each factor has its rates at their worst. Where angles are still
//! free, a factor is at most what its groups come to, and at most what is
//! known of it over the whole box.

use std::cell::RefCell;

use super::cells::{Cells, TERMS};
use super::harmonics::multiple;
use super::layout::Layout;
use super::{GridEffort, climb, least_shown, range, tries};
use crate::bound::expand::{Key, Polynomial};
use crate::bound::input_box::InputBox;
use crate::bound::work;
use crate::interval::Interval;

/// Where a key has the place of its polynomial, above its joints.
const PLACE: usize = 112;

/// The most joints of such a key.
const MAX_JOINTS: usize = 19;

/// d·δ of the first cells is π over this: most are far below the largest sum.
const FIRST: usize = 4;

/// More terms than this take too long to be regrouped.
const MAX_TERMS: usize = 200_000;

/// What the smallest terms of a factor may come to, against the factor.
const SMALL: f64 = 0.01;

/// A grid of fewer points, all angles put in, is none.
const FEW: usize = 16;

/// Points of a climb that ranks an angle.
const QUICK_POINTS: usize = 1 << 12;

/// What products of high degrees may come to by themselves, against all.
const ASIDE: f64 = 0.04;

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
pub(in crate::bound) struct Products<'a> {
    /// In multiples of their angles.
    pub polynomials: &'a [Polynomial],
    /// What each is at most there; infinity if that is not known.
    pub most: &'a [f64],
    pub limits: &'a InputBox,
    pub sliding: &'a [bool],
}

impl Products<'_> {
    /// A bound of a sum over the box; `None` if nothing is gained.
    pub(in crate::bound) fn sum(
        &self,
        products: &[Product],
        closeness: GridEffort,
    ) -> Option<Largest> {
        if self.limits.joints() > MAX_JOINTS || closeness.points == 0 {
            return None;
        }
        let all = Sum::new(self, products)?;
        // A few points that take all there are show nothing.
        if all.terms.len() * FEW > closeness.points * TERMS {
            return None;
        }
        let sizes = all.taken(self.limits, closeness);
        // Which caps count is decided once: where the sum is about largest.
        let is_capped = |product: &Product| {
            let size = product.left.map_or(0.0, |place| sizes[place]);
            product.left.is_some() && size > product.cap
        };
        let capped: Vec<bool> = products.iter().map(is_capped).collect();
        let pairs = products.iter().zip(&capped);
        let each = pairs.map(|(&product, &capped)| match capped {
            true => Product {
                weight: product.weight * product.cap,
                left: None,
                ..product
            },
            false => product,
        });
        let products: Vec<Product> = each.collect();
        let sum = Sum::new(self, &products)?.shown(self, closeness)?;
        Some(Largest { sum, capped })
    }
}

/// All factors side by side.
struct Sum<'a> {
    terms: Vec<(Key, Interval)>,
    layout: Layout,
    /// By factor and then by product of these.
    most: Vec<f64>,
    /// Of each factor: what its terms lose in all, rounding included.
    slack: Vec<f64>,
    /// Without rounding, which is the layout's.
    off: Vec<f64>,
    /// The sum of its terms' magnitudes.
    magnitudes: Vec<f64>,
    products: &'a [Product],
    /// What is left to what each product is at most by itself.
    aside: Vec<bool>,
    rest: f64,
    /// Of each polynomial that is a factor, its place among these.
    places: Vec<usize>,
    /// Of each of the layout's joints: the degree of the products.
    degrees: Vec<u32>,
}

impl<'a> Sum<'a> {
    /// `None` if there are too many factors.
    fn new(of: &Products<'_>, products: &'a [Product]) -> Option<Sum<'a>> {
        let mut is_factor = vec![false; of.polynomials.len()];
        for product in products {
            is_factor[product.right] = true;
            if let Some(left) = product.left {
                is_factor[left] = true;
            }
        }
        let mut places = vec![usize::MAX; of.polynomials.len()];
        let (mut most, mut offs, mut magnitudes) = (Vec::new(), Vec::new(), Vec::new());
        let mut terms: Vec<(Key, Interval)> = Vec::new();
        let range = |key: Key| range(key, of.limits);
        for (index, polynomial) in of.polynomials.iter().enumerate() {
            if !is_factor[index] {
                continue;
            }
            let place = offs.len();
            places[index] = place;
            let size = |(key, x): (Key, Interval)| x.magnitude() * range(key).magnitude();
            let mut by_size: Vec<(f64, Key, Interval)> = (polynomial.iter())
                .map(|&(key, x)| (size((key, x)).next_up(), key, x))
                .collect();
            by_size.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            // The smallest are not looked at.
            let largest = by_size.last().map_or(0.0, |last| last.0);
            let (mut off, mut small) = (0.0, SMALL * of.most[index].min(largest));
            let mut magnitude = 0.0;
            for (size, key, x) in by_size {
                if size <= small {
                    (off, small) = (off + size, small - size);
                    continue;
                }
                small = 0.0;
                let rates = range(key).magnitude();
                let tiny = f64::MIN_POSITIVE.sqrt() * rates;
                off += (x.radius() * rates + tiny) * (1.0 + 1e-9);
                magnitude += size;
                terms.push((key | (place as Key) << PLACE, x));
            }
            let off = off * (1.0 + 1e-9);
            // The terms looked at are as much off the polynomial as it is known.
            most.push(of.most[index] + 2.0 * off);
            offs.push(off);
            magnitudes.push(magnitude * (1.0 + 1e-9));
        }
        if most.len() >= 1 << (128 - PLACE) || terms.len() > MAX_TERMS {
            return None;
        }
        let layout = Layout::new(&terms, of.limits, of.sliding, &range, -1.0);
        let mut sum = Sum {
            terms,
            layout,
            most,
            slack: Vec::new(),
            off: offs,
            magnitudes,
            aside: vec![false; products.len()],
            rest: 0.0,
            products,
            places,
            degrees: Vec::new(),
        };
        sum.slack = sum.slack();
        let crude = sum.sizes_of_groups(0, &sum.layout.coefficients);
        for (most, crude) in sum.most.iter_mut().zip(crude) {
            *most = most.min(crude);
        }
        sum.degrees = sum.degrees();
        Some(sum)
    }

    /// By joint of the layout.
    fn degrees(&self) -> Vec<u32> {
        let each = self.layout.joints.iter();
        each.map(|&joint| {
            self.of_products(joint)
                .into_iter()
                .max()
                .unwrap_or(0)
                .max(1)
        })
        .collect()
    }

    /// The degree of each product in a joint's angle; zero for those aside.
    fn of_products(&self, joint: usize) -> Vec<u32> {
        let mut each = vec![0; self.most.len()];
        for &(key, _) in &self.terms {
            let degree = &mut each[(key >> PLACE) as usize];
            *degree = multiple(key, joint).0.max(*degree);
        }
        let of = |place: usize| each[self.places[place]];
        let pairs = self.products.iter().zip(&self.aside);
        pairs
            .map(|(product, aside)| match aside {
                true => 0,
                false => product.left.map_or(0, of) + of(product.right),
            })
            .collect()
    }

    /// Puts products of the highest degrees aside, as far as they come to no
    /// more than an allowance: the others' points lie further apart.
    fn put_aside(&mut self, allowance: f64) {
        let joints = self.layout.joints.clone();
        for &joint in &joints {
            let mut left = allowance / joints.len() as f64;
            let degrees = self.of_products(joint);
            for degree in (1..=degrees.iter().copied().max().unwrap_or(0)).rev() {
                let of = (0..degrees.len()).filter(|&index| degrees[index] == degree);
                let of: Vec<usize> = of.collect();
                let size: f64 = of.iter().map(|&index| self.separate(index)).sum();
                if size > left {
                    break;
                }
                left -= size;
                self.rest += size;
                of.into_iter().for_each(|index| self.aside[index] = true);
            }
        }
        self.rest *= 1.0 + 1e-9;
        self.degrees = self.degrees();
    }

    /// What a product is at most by itself.
    fn separate(&self, index: usize) -> f64 {
        let product = &self.products[index];
        let most = |place: usize| self.most[self.places[place]];
        product.weight * product.left.map_or(1.0, most) * most(product.right)
    }

    /// The least bound that was shown, if it is less than without angles: of one
    /// angle, then of one more as long as that may help.
    fn shown(mut self, of: &Products<'_>, closeness: GridEffort) -> Option<f64> {
        let crude = self.crude(0, &self.layout.coefficients);
        self.put_aside(ASIDE * crude);
        let (mut first, mut best) = (Vec::new(), None::<f64>);
        let joints = self.layout.joints.clone();
        while first.len() < joints.len() {
            // The angle that tells most.
            let mut next: Option<(f64, usize)> = None;
            for &joint in joints.iter().filter(|joint| !first.contains(*joint)) {
                let mut order = first.clone();
                order.push(joint);
                self.order(of, &order);
                let taken = self.climbed(of.limits, order.len(), QUICK_POINTS, 2);
                if next.is_none_or(|(least, _)| taken < least) {
                    next = Some((taken, joint));
                }
            }
            let Some((taken, joint)) = next else { break };
            first.push(joint);
            let so_far = best.unwrap_or(crude);
            if taken * (1.0 + closeness.close) >= so_far {
                continue;
            }
            self.order(of, &first);
            let found = self.at_depth(of, first.len(), so_far, closeness);
            match found {
                Some(found) => best = Some(found),
                None if best.is_some() => break,
                None => {}
            }
        }
        best
    }

    /// The least bound below one that is known, of so many angles.
    fn at_depth(
        &self,
        of: &Products<'_>,
        depth: usize,
        known: f64,
        closeness: GridEffort,
    ) -> Option<f64> {
        let least = self.climbed(of.limits, depth, closeness.points, closeness.starts);
        let tries = tries(least, 0.0, known, closeness.close);
        let accept = |values: &[f64], bound: f64| self.crude(depth, values) <= bound;
        let without = |level: usize, values: &[f64]| self.crude(level, values);
        let mut cells = self.cells(of.limits, depth, &accept);
        cells.crude = Some(&without);
        let mut shown = |bound: f64| {
            cells.points = closeness.points;
            cells.below(0, bound)
        };
        match tries.first() {
            Some(&first) if shown(first) => Some(first),
            _ => least_shown(&tries, 0, &mut shown),
        }
    }

    fn order(&mut self, of: &Products<'_>, first: &[usize]) {
        let range = |key: Key| range(key, of.limits);
        work::count(self.terms.len());
        self.layout = Layout::ordered(&self.terms, of.limits, of.sliding, &range, -1.0, first);
        self.degrees = self.degrees();
        self.slack = self.slack();
    }

    /// What each factor's terms lose, by this layout's rounding.
    fn slack(&self) -> Vec<f64> {
        let pairs = self.off.iter().zip(&self.magnitudes);
        let lost = pairs.map(|(off, magnitude)| off + self.layout.rounding * magnitude);
        lost.map(|lost| lost * (1.0 + 1e-9)).collect()
    }

    fn cells<'s>(
        &'s self,
        limits: &InputBox,
        depth: usize,
        accept: &'s dyn Fn(&[f64], f64) -> bool,
    ) -> Cells<'s> {
        let mut cells = Cells::new(&self.layout, limits, None, accept);
        cells.degrees.clone_from(&self.degrees);
        cells.depth = depth;
        cells.first = FIRST;
        cells
    }

    /// About the largest sum, so many angles looked at.
    fn climbed(&self, limits: &InputBox, depth: usize, points: usize, starts: usize) -> f64 {
        let mut cells = self.cells(limits, depth, &|_, _| false);
        cells.points = points;
        climb(&mut cells, starts, &|values| self.crude(depth, values))
    }

    /// How large each polynomial is where the sum is about largest.
    fn taken(&self, limits: &InputBox, closeness: GridEffort) -> Vec<f64> {
        let depth = self.layout.joints.len();
        let mut cells = self.cells(limits, depth, &|_, _| false);
        cells.points = closeness.points;
        let best = RefCell::new((0.0, vec![0.0; self.places.len()]));
        climb(&mut cells, closeness.starts, &|values| {
            let sizes = self.sizes(values);
            let sum = self.sum(&sizes);
            let mut best = best.borrow_mut();
            if sum > best.0 {
                let of = |&place: &usize| sizes.get(place).copied().unwrap_or(0.0);
                *best = (sum, self.places.iter().map(of).collect());
            }
            sum
        });
        best.into_inner().1
    }

    /// The sum at the angles put in, whatever the others are.
    fn crude(&self, level: usize, values: &[f64]) -> f64 {
        match level == self.layout.joints.len() {
            true => self.sum(&self.sizes(values)),
            false => self.sum(&self.sizes_of_groups(level, values)),
        }
    }

    /// The factors where angles are free.
    fn sizes_of_groups(&self, level: usize, values: &[f64]) -> Vec<f64> {
        let mut sizes = self.slack.clone();
        let mut from = 0;
        for group in self.layout.groups.get(level).into_iter().flatten() {
            let end = group.end as usize;
            let squares: f64 = values[from..end].iter().map(|x| x * x).sum();
            sizes[(group.key >> PLACE) as usize] += squares.sqrt() * group.size * (1.0 + 1e-9);
            from = end;
        }
        sizes
    }

    /// The factors at a point, the rates of each at their worst.
    fn sizes(&self, values: &[f64]) -> Vec<f64> {
        let mut ends = vec![(0.0, 0.0); self.most.len()];
        let pairs = values.iter().zip(&self.layout.output);
        for ((x, &(least, greatest)), key) in pairs.zip(&self.layout.rest) {
            let (a, b) = (x * least, x * greatest);
            let (low, high) = &mut ends[(key >> PLACE) as usize];
            *low += a.min(b);
            *high += a.max(b);
        }
        let sizes = ends.iter().zip(&self.slack);
        sizes
            .map(|((low, high), slack)| f64::max(*high, -low) + slack)
            .collect()
    }

    fn sum(&self, sizes: &[f64]) -> f64 {
        let size = |place: usize| {
            let place = self.places[place];
            sizes[place].min(self.most[place])
        };
        let each = self.products.iter().zip(&self.aside);
        let each = each.filter(|(_, aside)| !**aside);
        let each = each.map(|(p, _)| p.weight * p.left.map_or(1.0, size) * size(p.right));
        each.sum::<f64>() * (1.0 + 1e-9) + self.rest
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bound::expand::shift;
    use crate::random::Random;

    const PI: f64 = std::f64::consts::PI;

    /// A polynomial in multiples of two angles and a rate.
    fn polynomial(random: &mut Random) -> Polynomial {
        let mut terms: Polynomial = Vec::new();
        for _ in 0..6 {
            let mut key: Key = random.below(2) as Key;
            for joint in 0..2 {
                let multiple = random.below(3) as Key;
                let sine = if multiple > 0 {
                    16 * random.below(2) as Key
                } else {
                    0
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
                let angle = f64::from(k) * angles[joint];
                if sine {
                    libm::sin(angle)
                } else {
                    libm::cos(angle)
                }
            };
            let rate = if key & 1 == 1 { rate } else { 1.0 };
            x.mid() * factor(0) * factor(1) * rate
        };
        polynomial.iter().map(term).sum()
    }

    /// Above every value of a dense grid, and not far.
    #[test]
    fn the_largest_sum_is_bounded_closely() {
        let limits = InputBox {
            position: vec![Interval::symmetric(4.0); 2],
            velocity: vec![Interval::symmetric(2.0), Interval::ZERO],
            acceleration: vec![Interval::ZERO; 2],
        };
        let mut random = Random::new(41);
        let mut separate = 0;
        for _ in 0..12 {
            let polynomials: Vec<Polynomial> = (0..5).map(|_| polynomial(&mut random)).collect();
            let products: Vec<Product> = (0..4)
                .map(|k| Product {
                    weight: 0.5 + random.unit(),
                    left: (k > 0).then_some(k),
                    cap: [f64::INFINITY, 0.8][k % 2],
                    right: (k + 1) % 5,
                })
                .collect();
            let sum = Products {
                polynomials: &polynomials,
                most: &[f64::INFINITY; 5],
                limits: &limits,
                sliding: &[false; 2],
            };
            let closeness = GridEffort {
                points: 1 << 18,
                close: 0.02,
                starts: 4,
            };
            let Some(found) = sum.sum(&products, closeness) else {
                separate += 1;
                continue;
            };
            let mut most = 0.0;
            for i in 0..120 {
                for j in 0..120 {
                    let angles = [i, j].map(|k| 2.0 * PI * f64::from(k) / 120.0);
                    // The rates of each at their worst.
                    let size = |place: usize| {
                        let ends =
                            [-2.0, 2.0].map(|rate| value(&polynomials[place], angles, rate).abs());
                        ends[0].max(ends[1])
                    };
                    let each = products.iter().zip(&found.capped).map(|(p, capped)| {
                        let left = if *capped {
                            p.cap
                        } else {
                            p.left.map_or(1.0, size)
                        };
                        p.weight * left * size(p.right)
                    });
                    most = f64::max(most, each.sum());
                }
            }
            assert!(found.sum >= most, "{} {most}", found.sum);
            assert!(found.sum <= 1.2 * most, "{} {most}", found.sum);
        }
        assert!(separate < 6, "{separate}");
    }
}
