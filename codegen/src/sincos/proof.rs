//! Bounds the distance of a kernel from sine and cosine, from its operations alone.
//!
//! **Approximation.** With exact arithmetic a kernel is a polynomial whose coefficients are
//! integers over powers of two. Its difference from Taylor's polynomial is written in Chebyshev
//! polynomials on pieces of the range, in integers: the sum of the coefficients' magnitudes bounds
//! it, and what Taylor leaves out is added.
//!
//! **Rounding.** Over sub-ranges: every operation gives (x ∘ y)(1 + δ) + η. Each interval is widened by
//! that, so it holds what is computed *and* what is exact. The error of a result is exactly Σ own
//! error of a node · adjoint of the node, with adjoints that mix computed and exact operands; both
//! are in the intervals, so the sum bounds the whole error, not only its first order.
//!
//! **Reduction.** Where whole turns are taken off first, both hold for what
//! is left of the angle, and a sine moves no more than its angle.

use num_bigint::BigInt;
use num_traits::One;

use super::interval::Interval;
use super::poly::Poly;
use super::reduction;
use super::series::{FARTHEST, Taylor, Wave};
use crate::dag::{Edge, Node};
use crate::program::kernel::{Kernel, SinCosUse};
use crate::program::scalar_type::underflow;
use crate::program::{Operation, ScalarType};

/// Proved bounds of |computed − true|; zero for what is not computed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Errors {
    pub sin: f64,
    pub cos: f64,
}

impl Errors {
    pub fn worst(self) -> f64 {
        self.sin.max(self.cos)
    }

    fn and(self, other: Errors, need: SinCosUse) -> Errors {
        let sum = |is_wanted: bool, error: f64, other: f64| match is_wanted {
            true => (error + other).next_up(),
            false => 0.0,
        };
        Errors {
            sin: sum(need.sin, self.sin, other.sin),
            cos: sum(need.cos, self.cos, other.cos),
        }
    }
}

const MAX_OPERATIONS: usize = 128;
const MAX_DEGREE: usize = 160;
const MAX_BITS: u64 = 1 << 18;
const PIECE: f64 = 0.5;
const CELLS: usize = 48;

/// Returns none also where rounding alone costs `most` or more: a small part of the proof shows it.
pub(crate) fn prove(
    kernel: &Kernel,
    scalar: ScalarType,
    range: Interval,
    most: f64,
) -> Option<Errors> {
    if kernel.operations() > MAX_OPERATIONS {
        return None;
    }
    if let Some((constants, left)) = reduction::split(kernel, scalar) {
        let rest = reduction::rest(constants, scalar, range)?;
        let errors = polynomial(&left, scalar, rest.range, most)?;
        let (sin, cos) = (rest.error, rest.error);
        return Some(errors.and(Errors { sin, cos }, left.need));
    }
    polynomial(kernel, scalar, range, most)
}

fn polynomial(kernel: &Kernel, scalar: ScalarType, range: Interval, most: f64) -> Option<Errors> {
    let rounding = rounding(kernel, scalar, range);
    if rounding.worst() >= most {
        return None;
    }
    let errors = approximations(kernel, range)?.and(rounding, kernel.need);
    errors.worst().is_finite().then_some(errors)
}

fn approximations(kernel: &Kernel, range: Interval) -> Option<Errors> {
    if range.magnitude().is_nan() || range.magnitude() > FARTHEST {
        return None;
    }
    let values = expand(kernel)?;
    let one = |edge: Option<Edge>, wave| match edge {
        None => Some(0.0),
        Some(edge) => {
            let poly = &values[edge.index()];
            let sign = BigInt::from(if edge.negative { -1 } else { 1 });
            approximation(&poly.scaled(&sign), wave, range)
        }
    };
    let [sin, cos] = kernel.results();
    Some(Errors {
        sin: one(sin, Wave::Sin)?,
        cos: one(cos, Wave::Cos)?,
    })
}

fn expand(kernel: &Kernel) -> Option<Vec<Poly>> {
    let mut values: Vec<Poly> = Vec::with_capacity(kernel.dag.nodes.len());
    for node in &kernel.dag.nodes {
        values.push(match node {
            Node::Input(_) => Poly::variable(),
            Node::Constant(value) => Poly::constant(value.0)?,
            Node::Apply(operation, operands) => {
                let [left, right] = operands.map(|id| &values[id as usize]);
                let is_large = left.degree() + right.degree() > MAX_DEGREE;
                if is_large || left.bits() + right.bits() > MAX_BITS {
                    return None;
                }
                match operation {
                    Operation::Add => left.add(right),
                    Operation::Sub => left.sub(right),
                    Operation::Mul | Operation::Fused => left.mul(right),
                    Operation::Div => return None,
                }
            }
        });
    }
    Some(values)
}

/// |p − wave| over a range, from above: over the whole, or the worst of pieces, whichever is less.
fn approximation(poly: &Poly, wave: Wave, range: Interval) -> Option<f64> {
    let reach = range.magnitude() + 1.0;
    let taylor = Taylor::up_to(reach)?;
    let difference = taylor.waves[wave as usize].sub(&poly.scaled(&taylor.factorial));
    let (difference, cut) = difference.divided(&taylor.factorial, reach);
    let over = |pieces: usize| {
        let width = range.width() / pieces as f64;
        // Centre and radius have few bits; the radius has room for rounding
        // both, so the pieces cover the range, and reach less than 1 beyond.
        let bits = libm::ceil(-libm::log2(width.max(1e-9))).clamp(-2.0, 30.0) as i32 + 10;
        let grid = libm::exp2(f64::from(bits));
        let radius = libm::ceil(0.5 * width * grid) as i64 + 1;
        let most = (0..pieces).map(|piece| {
            let middle = range.low() + (piece as f64 + 0.5) * width;
            let centre = libm::round(middle * grid) as i64;
            let (form, cut) = difference.on(centre, radius, bits.unsigned_abs().into());
            form.chebyshev().sum_from(0, &BigInt::one()) + cut
        });
        most.fold(0.0, f64::max)
    };
    let pieces = libm::ceil(range.width() / PIECE).max(1.0) as usize;
    let most = over(1).min(over(pieces));
    Some(((most + taylor.remainder).next_up() + cut).next_up())
}

fn rounding(kernel: &Kernel, scalar: ScalarType, range: Interval) -> Errors {
    let mut worst = Errors::default();
    let width = range.width() / CELLS as f64;
    for cell in 0..CELLS {
        let end = |k: usize| match k {
            CELLS => range.high(),
            _ => (range.low() + k as f64 * width).min(range.high()),
        };
        let cell = Interval::new(end(cell), end(cell + 1)).unwrap_or(range);
        let (values, roundings) = ranges(kernel, scalar, cell);
        let roundoff = |edge: Option<Edge>| match edge {
            Some(edge) => error(kernel, &values, &roundings, edge),
            None => 0.0,
        };
        let [sin, cos] = kernel.results().map(roundoff);
        worst.sin = worst.sin.max(sin);
        worst.cos = worst.cos.max(cos);
    }
    worst
}

/// Returns intervals that hold what is exact and what is computed, and each node's own rounding.
fn ranges(kernel: &Kernel, scalar: ScalarType, angle: Interval) -> (Vec<Interval>, Vec<f64>) {
    let u = scalar.unit_roundoff();
    let (mut values, mut roundings): (Vec<Interval>, Vec<f64>) = (Vec::new(), Vec::new());
    for node in &kernel.dag.nodes {
        let (value, rounding) = match node {
            Node::Constant(value) => (Interval::point(value.0), 0.0),
            Node::Input(_) => (angle, 0.0),
            Node::Apply(operation, operands) => {
                let [x, y] = operands.map(|id| values[id as usize]);
                let (exact, eta) = match operation {
                    Operation::Add | Operation::Sub => (operation.apply(&x, &y), 0.0),
                    Operation::Mul | Operation::Fused if operands[0] == operands[1] => {
                        (x.square(), underflow(scalar))
                    }
                    _ => (operation.apply(&x, &y), underflow(scalar)),
                };
                let rounding = ((u * exact.magnitude()).next_up() + eta).next_up();
                (exact.widened(rounding), rounding)
            }
        };
        values.push(value);
        roundings.push(rounding);
    }
    (values, roundings)
}

/// Returns Σ |adjoint|·rounding for one result.
fn error(kernel: &Kernel, values: &[Interval], roundings: &[f64], result: Edge) -> f64 {
    let mut adjoints = Vec::new();
    kernel.dag.adjoints(result.node, values, &mut adjoints);
    let mut sum = Interval::ZERO;
    for (adjoint, rounding) in adjoints.iter().zip(roundings).rev() {
        // Products of zero are rounded outward, too.
        if *adjoint != Interval::ZERO && *rounding != 0.0 {
            sum = sum + Interval::point(adjoint.magnitude()) * Interval::point(*rounding);
        }
    }
    sum.high()
}
