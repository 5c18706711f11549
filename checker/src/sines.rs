//! What rounding costs, and how far a block of arithmetic is from the sine or the cosine
//! of its angle.

use crate::interval::{Interval, SINE_ERROR, UNIT, sin_cos};
use crate::polynomial::SLACK;
use crate::program::Node;

/// Half an ulp of f32, relative.
const SINGLE_UNIT: f64 = 5.960_464_477_539_063e-8;
/// Into how many cells the range of an angle is cut.
const CELLS: usize = 1 << 14;

/// The scalar that a text computes in.
#[derive(Clone, Copy, Debug)]
pub struct Scalar {
    /// What rounding to nearest costs, relative.
    pub unit: f64,
    /// What it costs more where results underflow.
    pub least: f64,
    /// Where results overflow.
    pub most: f64,
}

impl Scalar {
    /// Returns f32 or f64.
    pub fn of(name: &str) -> Scalar {
        let (unit, least, most) = match name {
            "f32" => (SINGLE_UNIT, 1e-45, f64::from(f32::MAX)),
            _ => (UNIT, f64::from_bits(1), f64::MAX),
        };
        Scalar { unit, least, most }
    }

    /// Returns how far the result of an operation is off: its operands' share, and rounding.
    pub fn rounded(self, size: f64, inherited: f64) -> f64 {
        let error = inherited + self.unit * (size + inherited) + self.least;
        match (size + error) * SLACK < self.most {
            true => error * SLACK,
            false => f64::INFINITY,
        }
    }
}

/// Returns the largest difference of what a block computes in floating point, at the angles of a
/// range, from the sine (or cosine); infinite if nothing can be said.
///
/// Of f, the block in real numbers less the sine, the value at the middle of each cell
/// and the slope over the cell are enclosed: |f| ≤ |f(m)| + max|f′|·w. What rounding
/// costs on the way is added.
pub fn error(block: &[Node], result: usize, is_sine: bool, range: Interval, scalar: Scalar) -> f64 {
    if !(range.magnitude() < 1000.0) {
        return f64::INFINITY;
    }
    let width = (range.high - range.low) / CELLS as f64;
    let half = (0.5 * width).next_up() + 1e-12;
    let mut worst = 0.0f64;
    for cell in 0..CELLS {
        let middle = range.low + width * (cell as f64 + 0.5);
        let over = Interval::around(middle, half);
        let (sin, cos) = sin_cos(middle);
        let (value, slope) = match is_sine {
            true => (sin, Interval::around(cos, half + SINE_ERROR)),
            false => (cos, Interval::around(-sin, half + SINE_ERROR)),
        };
        let at = last(&evaluate(block, Interval::point(middle), scalar), result);
        let around = last(&evaluate(block, over, scalar), result);
        let off = (at.value + -Interval::around(value, SINE_ERROR)).magnitude();
        let off = off + (around.slope + -slope).magnitude() * half + around.error;
        // So that a result that is no number counts as the worst.
        if !(off <= worst) {
            worst = off;
        }
        if !worst.is_finite() {
            return f64::INFINITY;
        }
    }
    worst * (1.0 + 1e-12)
}

/// A value of a block over a range of angles: enclosures of it and of its derivative, and
/// what rounding costs up to it.
#[derive(Clone, Copy)]
struct Enclosed {
    value: Interval,
    slope: Interval,
    error: f64,
}

impl Enclosed {
    fn new(value: Interval, slope: Interval, error: f64) -> Enclosed {
        Enclosed {
            value,
            slope,
            error,
        }
    }
}

fn last(values: &[Enclosed], result: usize) -> Enclosed {
    let unknown = Interval::new(f64::NAN, f64::NAN);
    let nothing = Enclosed::new(unknown, unknown, f64::INFINITY);
    values.get(result).copied().unwrap_or(nothing)
}

fn evaluate(block: &[Node], angle: Interval, scalar: Scalar) -> Vec<Enclosed> {
    let mut values = vec![Enclosed::new(angle, Interval::point(1.0), 0.0)];
    for &node in block.iter().skip(1) {
        let get = |node: usize| last(&values, node);
        // What is neither a literal nor an opposite is rounded.
        let rounded = |value: Interval, slope, inherited| {
            Enclosed::new(value, slope, scalar.rounded(value.magnitude(), inherited))
        };
        let value = match node {
            Node::Constant(value) => {
                Enclosed::new(Interval::point(value), Interval::point(0.0), 0.0)
            }
            Node::Neg(a) => Enclosed::new(-get(a).value, -get(a).slope, get(a).error),
            Node::Add(a, b) | Node::Sub(a, b) => {
                let (a, b, sum) = (get(a), get(b), matches!(node, Node::Add(..)));
                let signed = |x: Interval| if sum { x } else { -x };
                let (value, slope) = (a.value + signed(b.value), a.slope + signed(b.slope));
                rounded(value, slope, a.error + b.error)
            }
            Node::Mul(a, b) => {
                let (a, b) = (get(a), get(b));
                let slope = a.slope * b.value + a.value * b.slope;
                let own = a.error * (b.value.magnitude() + b.error);
                let inherited = own + b.error * a.value.magnitude();
                rounded(a.value * b.value, slope, inherited)
            }
            Node::Input(..) | Node::Sine(..) | Node::Fused(..) | Node::Div(..) => last(&[], 0),
        };
        values.push(value);
    }
    values
}
