//! Bounds of one rounding, and of how far polynomials of an angle are from its sine and its cosine.

use crate::interval::{FARTHEST, Interval, SINE_ERROR, UNIT, sin_cos};
use crate::polynomial::SLACK;
use crate::program::{Operand, Program};

const CELLS: usize = 1 << 14;

#[derive(Clone, Copy, Debug)]
pub struct Scalar {
    /// The relative cost of rounding to nearest.
    pub unit: f64,
    /// The cost beside that where results underflow.
    pub least: f64,
    /// Where results are too near to overflow: states a little outside of the box would.
    pub most: f64,
}

impl Scalar {
    pub fn new(is_single: bool) -> Scalar {
        let (unit, least, most) = match is_single {
            true => (f64::from(f32::EPSILON) / 2.0, 1e-45, 1e30),
            false => (UNIT, f64::from_bits(1), 1e280),
        };
        Scalar { unit, least, most }
    }

    /// Bounds one rounding of a number of at most this size.
    pub fn rounding(self, size: f64) -> f64 {
        (self.unit * size + self.least) * SLACK
    }

    /// Adds what was inherited to one rounding; infinite where the number may overflow.
    pub fn sum(self, size: f64, inherited: f64, rounding: f64) -> f64 {
        let error = inherited + rounding;
        match (size + error) * SLACK < self.most {
            true => error * SLACK,
            false => f64::INFINITY,
        }
    }

    /// Bounds the error of a number that is rounded once more.
    pub fn rounded(self, size: f64, inherited: f64) -> f64 {
        self.sum(size, inherited, self.rounding(size + inherited))
    }
}

/// About how many nanoseconds the bound for a sine or a cosine takes.
pub fn work(polynomials: &Program<f64>) -> u64 {
    40 * CELLS as u64 * (1 + polynomials.steps.len() as u64)
}

/// Bounds f, the polynomials of an angle in real numbers less its sine or cosine: the value at the
/// middle of each cell and the slope over the cell are enclosed, |f| ≤ |f(m)| + max|f′|·w. The
/// rounding on the way is added; infinite if nothing can be said.
pub fn error(
    polynomials: &Program<f64>,
    result: usize,
    is_sine: bool,
    range: Interval,
    scalar: Scalar,
) -> f64 {
    if !(range.magnitude() < FARTHEST) {
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
        let ([at, _], _) = evaluate(polynomials, result, Interval::point(middle), scalar);
        let ([_, around], rounding) = evaluate(polynomials, result, over, scalar);
        let off = (at + -Interval::around(value, SINE_ERROR)).magnitude();
        let off = off + (around + -slope).magnitude() * half + rounding;
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

/// The value and the derivative over a range of angles, and the rounding error up to it.
type Enclosed = ([Interval; 2], f64);

fn evaluate(own: &Program<f64>, result: usize, angle: Interval, scalar: Scalar) -> Enclosed {
    let leaf = |own: &Operand<f64>| match own {
        Operand::Constant(literal) => Some(([*literal, 0.0].map(Interval::point), 0.0)),
        Operand::Entry(..) => Some(([angle, Interval::point(1.0)], 0.0)),
        _ => None,
    };
    let apply = |operation: char, (a, a_error): Enclosed, (b, b_error): Enclosed| {
        let (both, inherited) = match operation {
            '+' => ([a[0] + b[0], a[1] + b[1]], a_error + b_error),
            '-' => ([a[0] + -b[0], a[1] + -b[1]], a_error + b_error),
            '*' | '×' => {
                let own = a_error * (b[0].magnitude() + b_error);
                let inherited = own + b_error * a[0].magnitude();
                ([a[0] * b[0], a[1] * b[0] + a[0] * b[1]], inherited)
            }
            _ => ([Interval::NOTHING_KNOWN; 2], 0.0),
        };
        let error = match operation {
            '×' => inherited,
            _ => scalar.rounded(both[0].magnitude(), inherited),
        };
        (both, error)
    };
    let opposite = |(both, error): Enclosed| (both.map(|own| -own), error);
    let results = own.run(leaf, apply, opposite).unwrap_or_default();
    let nothing = ([Interval::NOTHING_KNOWN; 2], f64::INFINITY);
    results.get(result).copied().unwrap_or(nothing)
}
