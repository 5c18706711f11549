//! The largest magnitude of a trigonometric polynomial over a box, from its
//! values at a grid.
//!
//! **Soundness.** Fix the rates and all angles but one where |T| is largest,
//! M; T is a trigonometric polynomial of some degree d in that angle.
//!
//! - *Whole circle.* M. Riesz: |T(x)| ≥ M·cos(d·(x − x₀)) for d·|x − x₀| ≤ π/2.
//!   Of N equally spaced points one is within π/N of x₀, so M is at most the
//!   grid's largest value over cos(d·π/N).
//! - *Part of it.* The grid holds both ends. If x₀ is an end, nothing is
//!   lost; if not, T'(x₀) = 0, |T''| ≤ d²·F with F the largest value over the
//!   whole circle (Bernstein), and of points 2δ apart one has
//!   |T| ≥ M − ½(d·δ)²·F.
//!
//! Angle after angle, this bounds M by the values at the product grid. For
//! each point the rates are at their worst, monomial by monomial.
//!
//! What the arithmetic costs: coefficients are intervals, of which the grid
//! takes the middle; their radii are added at the end, and so is
//! [`SLACK`] times the sum of all |coefficient · monomial|, which covers the
//! few dozen roundings between a coefficient and a value, since every sine and
//! cosine is at most 1.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use super::expand::{Key, Polynomial, powers, rates};
use super::input_box::InputBox;
use super::interval::Interval;

/// More than a hundred roundings of double precision, relative.
const SLACK: f64 = 1e-13;

/// Largest magnitudes of polynomials over a box; `None` if even a coarse grid
/// has more points than allowed.
pub(super) fn magnitudes(
    polynomials: &[Polynomial],
    limits: &InputBox,
    sliding: &[bool],
    points: usize,
) -> Option<Vec<f64>> {
    let layout = Layout::new(polynomials, limits);
    let part: Vec<bool> = layout
        .joints
        .iter()
        .map(|&j| !sliding[j] && limits.position[j].width() < 2.0 * PI * (1.0 - 1e-12))
        .collect();
    let fineness = [32usize, 24, 16, 12, 8, 6, 5, 4].into_iter().find(|&k| {
        let counts = layout.degrees.iter().map(|&d| (k * d as usize) as f64);
        counts.product::<f64>() <= points as f64
    })?;
    let circle: Vec<Vec<f64>> = layout
        .degrees
        .iter()
        .map(|&d| {
            let count = fineness * d as usize;
            (0..count)
                .map(|p| 2.0 * PI * p as f64 / count as f64)
                .collect()
        })
        .collect();
    // Degree d and N = fineness·d points: the cosine is the same for all.
    let nearest = (libm::cos(PI / fineness as f64) - 1e-15).next_down();
    let mut whole = layout.largest(&circle);
    for value in &mut whole {
        for _ in &layout.joints {
            *value = (*value / nearest).next_up();
        }
    }
    if part.contains(&true) {
        let mut lost = 0.0;
        let mut grid = circle;
        for (k, &joint) in layout.joints.iter().enumerate() {
            if part[k] {
                let range = limits.position[joint];
                let step = 2.0 * PI / grid[k].len() as f64;
                let count = libm::ceil(range.width() / step).max(1.0);
                let angle = |p: usize| {
                    (range.low() + range.width() * p as f64 / count)
                        .clamp(range.low(), range.high())
                };
                grid[k] = (0..=count as usize).map(angle).collect();
                // d·δ for δ half the distance of two points.
                let reach = f64::from(layout.degrees[k]) * range.width() / count / 2.0;
                lost += 0.5 * reach * reach * (1.0 + 1e-12);
            }
        }
        let inside = layout.largest(&grid);
        for (value, inside) in whole.iter_mut().zip(inside) {
            let mut bound = inside + lost * *value;
            for _ in part.iter().filter(|&&part| !part) {
                bound = (bound / nearest).next_up();
            }
            *value = value.min(bound);
        }
    }
    for (value, slack) in whole.iter_mut().zip(&layout.slack) {
        *value = (*value + slack).next_up();
    }
    Some(whole)
}

/// Terms regrouped so that a grid is evaluated joint after joint.
struct Layout {
    joints: Vec<usize>,
    degrees: Vec<u32>,
    /// Of each joint: the powers (cosine, sine) that occur.
    bases: Vec<Vec<(u32, u32)>>,
    coefficients: Vec<f64>,
    /// Of each joint: (from, base, to), and how many values come out.
    folds: Vec<(Vec<[u32; 3]>, usize)>,
    /// Of each output: its values after the last joint, and the range of
    /// their rates.
    outputs: Vec<Vec<(usize, f64, f64)>>,
    slack: Vec<f64>,
}

impl Layout {
    fn new(polynomials: &[Polynomial], limits: &InputBox) -> Layout {
        let degree = |joint: usize| {
            let terms = polynomials.iter().flatten();
            let keys = terms
                .filter(|&&(key, x)| negligible(x, key, limits).is_none())
                .map(|&(key, _)| powers(key, joint));
            keys.map(|(c, s)| c + s).max().unwrap_or(0)
        };
        let mut joints: Vec<usize> = (0..limits.joints()).filter(|&j| degree(j) > 0).collect();
        // The joint of the highest degree last: its sums are the shortest.
        joints.sort_by_key(|&joint| degree(joint));
        let degrees: Vec<u32> = joints.iter().map(|&j| degree(j)).collect();
        let mut bases: Vec<Vec<(u32, u32)>> = vec![Vec::new(); joints.len()];
        let mut terms: Vec<(usize, Key)> = Vec::new();
        let mut coefficients = Vec::new();
        let mut slack = vec![0.0; polynomials.len()];
        for (output, polynomial) in polynomials.iter().enumerate() {
            for &(key, coefficient) in polynomial {
                if let Some(lost) = negligible(coefficient, key, limits) {
                    slack[output] += lost;
                    continue;
                }
                let most = range(key, limits).magnitude();
                let size = coefficient.magnitude() * most;
                slack[output] += (coefficient.radius() * most + SLACK * size) * (1.0 + 1e-9);
                terms.push((output, key));
                coefficients.push(coefficient.mid());
            }
        }
        let mut folds = Vec::new();
        for (k, &joint) in joints.iter().enumerate() {
            let mut places: BTreeMap<(usize, Key), u32> = BTreeMap::new();
            let mut fold = Vec::new();
            for (from, &(output, key)) in terms.iter().enumerate() {
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
                let to = *places.entry((output, rest)).or_insert(next);
                fold.push([from as u32, base as u32, to]);
            }
            terms = vec![(0, 0); places.len()];
            for (term, place) in places {
                terms[place as usize] = term;
            }
            folds.push((fold, terms.len()));
        }
        let mut outputs = vec![Vec::new(); polynomials.len()];
        for (place, &(output, key)) in terms.iter().enumerate() {
            let range = range(key, limits);
            outputs[output].push((place, range.low(), range.high()));
        }
        Layout {
            joints,
            degrees,
            bases,
            coefficients,
            folds,
            outputs,
            slack,
        }
    }

    /// The largest magnitude of each output over a product grid.
    fn largest(&self, grid: &[Vec<f64>]) -> Vec<f64> {
        let tables: Vec<Vec<Vec<f64>>> = grid
            .iter()
            .zip(&self.bases)
            .map(|(angles, bases)| {
                let row = |angle: &f64| {
                    let (sin, cos) = libm::sincos(*angle);
                    let value = |&(c, s): &(u32, u32)| {
                        (0..c).fold(1.0, |x, _| x * cos) * (0..s).fold(1.0, |x, _| x * sin)
                    };
                    bases.iter().map(value).collect()
                };
                angles.iter().map(row).collect()
            })
            .collect();
        let mut buffers: Vec<Vec<f64>> = vec![self.coefficients.clone()];
        buffers.extend(self.folds.iter().map(|(_, len)| vec![0.0; *len]));
        let mut most = vec![0.0; self.outputs.len()];
        self.descend(0, &tables, &mut buffers, &mut most);
        most
    }

    fn descend(
        &self,
        level: usize,
        tables: &[Vec<Vec<f64>>],
        buffers: &mut [Vec<f64>],
        most: &mut [f64],
    ) {
        let Some((fold, _)) = self.folds.get(level) else {
            for (output, most) in self.outputs.iter().zip(most) {
                let (mut low, mut high) = (0.0, 0.0);
                for &(place, least, greatest) in output {
                    let (a, b) = (buffers[0][place] * least, buffers[0][place] * greatest);
                    low += a.min(b);
                    high += a.max(b);
                }
                *most = f64::max(*most, f64::max(high, -low));
            }
            return;
        };
        for row in &tables[level] {
            let (from, rest) = buffers.split_at_mut(1);
            rest[0].fill(0.0);
            for &[x, base, to] in fold {
                rest[0][to as usize] += from[0][x as usize] * row[base as usize];
            }
            self.descend(level + 1, tables, rest, most);
        }
    }
}

/// What a term can be at most, if it is but the rounding of a sum that
/// cancels: zero is inside, and it is far below what counts.
fn negligible(coefficient: Interval, key: Key, limits: &InputBox) -> Option<f64> {
    let most = (coefficient.magnitude() * range(key, limits).magnitude()).next_up();
    (coefficient.contains(0.0) && most < 1e-13).then_some(most)
}

/// The range of a key's rates.
fn range(key: Key, limits: &InputBox) -> Interval {
    let n = limits.joints();
    let variable = |rate: u8| match usize::from(rate) {
        0 => Interval::ONE,
        k if k <= n => limits.velocity[k - 1],
        k => limits.acceleration[k - 1 - n],
    };
    match rates(key) {
        [a, b] if a == b && a != 0 => variable(a).square(),
        [0, 0] => Interval::ONE,
        [0, b] => variable(b),
        [a, b] => variable(a) * variable(b),
    }
}
