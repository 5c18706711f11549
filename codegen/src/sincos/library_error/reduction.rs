//! What is left of an angle: x = k·π/2 + r − ℓ + ε.
//!
//! With π/2 ≈ P₁ + P₂ + P₃, k an integer next to x·2/π and all operations rounded:
//!
//! - k·P₁ and k·P₂ are exact: their bits fit.
//! - x − k·P₁ is exact: if k is not zero, |x| ≥ 1/2, so x is a multiple of u; so is
//!   k·P₁, and multiples of u up to one are floats.
//! - r = (x − k·P₁) − k·P₂ is rounded, and e, what it is more than the floats' difference
//!   with the other sign, is computed exactly. If the first is the larger one, that is
//!   Dekker's sum; if not, both are so small that all differences are multiples of the
//!   last bit of P₂ that floats hold.
//! - ℓ = k·P₃ − e is rounded twice, and k·(π/2 − P₁ − P₂ − P₃) is missing: ε.
//!
//! Where products are fused with their sums, what is exact above is the same number, and what is
//! rounded is rounded once less: the bounds hold of both.

use dalembert_model::number::{Angle, Rational};

use crate::interval::Interval;
use crate::interval::rounding::binade;
use crate::program::kernel::{ANGLE, Kernel, KernelStep, Term, literal};
use crate::program::scalar_type::underflow;
use crate::program::{Literal, Operand, Operation, ScalarType, Step};
use crate::sincos::reduction::{digits, is_exact, last_bit, magic};

/// What the rest of the routine reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Part {
    /// r
    Rest,
    /// ℓ
    Lacks,
}

/// The rest of the routine.
#[derive(Clone, Debug)]
pub(super) struct Left {
    pub steps: Vec<Step<Literal, Part>>,
    pub sin: Operand<Literal, Part>,
    pub cos: Operand<Literal, Part>,
}

/// The literals of the reduction: 2/π, and π/2 in three parts.
#[derive(Clone, Copy, Debug)]
pub(super) struct Parts {
    inverse: f64,
    quarter: [f64; 3],
}

/// Bounds of what is left.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reduced {
    /// |r|
    pub rest: f64,
    /// |ℓ|
    pub lacks: f64,
    /// |ε|
    pub error: f64,
}

/// Returns the reduction that the routine begins with, and what follows; `None` if it is another.
pub(super) fn split(kernel: &Kernel, scalar: ScalarType) -> Option<(Parts, Left)> {
    use Operand::Step as At;
    use Operation::{Add, Fused, Mul, Sub};
    let is_fused = kernel.steps.first()?.operation == Fused;
    let known = |at: usize| match kernel.steps.get(at)?.right {
        Operand::Constant(Literal(value)) => Some(value),
        _ => None,
    };
    let third = if is_fused { 10 } else { 7 };
    let (inverse, shift) = (known(0)?, literal(magic(scalar)));
    let quarter = [known(3)?, known(5)?, known(third)?];
    let [much, little, least] = quarter.map(literal);
    let product = if is_fused { Fused } else { Mul };
    let mut expected = vec![
        (product, ANGLE, literal(inverse)),
        (Add, At(0), shift),
        (Sub, At(1), shift),
        (product, At(2), much),
        (Sub, ANGLE, At(3)),
        (product, At(2), little),
        (Sub, At(4), At(5)),
    ];
    // Which is r; the last is ℓ. A product that two sums take stands before each.
    let rest_at = expected.len() - 1;
    expected.extend(match is_fused {
        false => vec![
            (Mul, At(2), least),
            (Sub, At(4), At(rest_at)),
            (Sub, At(8), At(5)),
            (Sub, At(7), At(9)),
        ],
        true => vec![
            (Sub, At(4), At(rest_at)),
            (Fused, At(2), little),
            (Sub, At(7), At(8)),
            (Fused, At(2), least),
            (Sub, At(10), At(9)),
        ],
    });
    let (first, rest) = kernel.steps.split_at_checked(expected.len())?;
    let count = first.len();
    let is = |(step, expected): (&KernelStep, (Operation, Term, Term))| {
        (step.operation, step.left, step.right) == expected
    };
    if !first.iter().zip(expected).all(is) {
        return None;
    }
    let moved = |term: Term| match term {
        Operand::Constant(value) => Some(Operand::Constant(value)),
        At(step) if step == rest_at => Some(Operand::Input(Part::Rest)),
        At(step) if step == count - 1 => Some(Operand::Input(Part::Lacks)),
        At(step) => step.checked_sub(count).map(At),
        Operand::Input(_) => None,
    };
    let steps = rest.iter().map(|step| {
        Some(Step {
            operation: step.operation,
            left: moved(step.left)?,
            right: moved(step.right)?,
        })
    });
    let left = Left {
        steps: steps.collect::<Option<_>>()?,
        sin: moved(kernel.sin?.value)?,
        cos: moved(kernel.cos?.value)?,
    };
    Some((Parts { inverse, quarter }, left))
}

/// Bounds it of angles up to a magnitude; `None` if some of the above does not hold.
pub(super) fn bound(parts: &Parts, scalar: ScalarType, largest: f64) -> Option<Reduced> {
    let point = Interval::point;
    let (u, eta) = (point(scalar.unit_roundoff()), point(underflow(scalar)));
    let [much, little, least] = parts.quarter;
    let quarter = Angle::right_angles(1).radians();
    let exact = |x: f64| Rational::from_float(x);
    let off = |x: &Rational| point(Interval::rational(x).magnitude());
    let reach = point(largest);
    // x·2/π as it is computed against what it is; next to the shift it is rounded to
    // the nearest integer.
    let wrong = off(&(exact(parts.inverse)? - quarter.recip()));
    let scaled = reach * point(parts.inverse.abs());
    let counted = reach * wrong + u * scaled + eta;
    if scaled.high() + 1.0 > libm::exp2(f64::from(digits(scalar) - 2)) {
        return None;
    }
    let half = point(0.5) + counted;
    let left = Interval::rational(&quarter) * half;
    let most = reach * Interval::rational(&quarter.recip()) + half;
    let turns = libm::floor(most.high());
    if !is_exact(much, turns, scalar) || !is_exact(little, turns, scalar) {
        return None;
    }
    let turns = point(turns);
    // x − k·P₁: multiples of u, below one; x is one if k is not zero.
    let nearest = Interval::rational(&quarter) * (point(0.5) - counted);
    let first = left + turns * off(&(&quarter - exact(much)?));
    let one = scalar.unit_roundoff();
    if nearest.low() < 0.5 || first.high() > 1.0 || last_bit(much) < one {
        return None;
    }
    // (x − k·P₁) − k·P₂, as floats of multiples of the last bit of either.
    let second = turns * point(little.abs()) * (point(1.0) + u + u);
    let bit = last_bit(little).min(one);
    if second.high() / bit > libm::exp2(f64::from(digits(scalar))) {
        return None;
    }
    let both = &quarter - exact(much)? - exact(little)?;
    let difference = left + turns * off(&both);
    let rounded = u * point(binade(difference.high()));
    let third = turns * point(least.abs());
    let product = u * third + eta;
    let before = third + product + rounded;
    let last = u * before;
    let missing = turns * off(&(both - exact(least)?));
    let (rest, lacks) = (difference + rounded, before + last);
    Some(Reduced {
        rest: rest.high(),
        lacks: lacks.high(),
        error: (product + last + missing).high(),
    })
}
