//! Sine and cosine from r and ℓ, against those of r − ℓ.
//!
//! **Rounding.** As of every other code ([`crate::interval::rounding`]), but that each
//! operation rounds by half an ulp of its result, and some not at all: products with a
//! power of two, differences of numbers within a factor of two of each other
//! (Sterbenz), and (c − t) − h where t = c − h was rounded and c is the larger one
//! (Dekker; h may be a product with a power of two, which fused sums do not round either).
//! A product that is fused is not rounded, the sum that takes it is. What the last sum rounds is
//! the true value but for all that came before.
//!
//! **Approximation.** With exact arithmetic the results are polynomials p(r, ℓ). Of
//! p(r, 0) see [`proof`](crate::sincos::proof); and by the mean value theorem p(r, ℓ) is
//! no further off sin(r − ℓ) than that and |ℓ|·|∂p/∂ℓ + cos(r − ℓ)|; of the cosine
//! accordingly.

use super::reduction::{Left, Part};
use crate::interval::Interval;
use crate::interval::rounding::{self, Forward, binade};
use crate::program::adjoint::{Leaf, backward};
use crate::program::fused::{fusion, underflows};
use crate::program::kernel::{ANGLE, Kernel, Term, Value, literal};
use crate::program::scalar_type::underflow;
use crate::program::{Literal, Operand, Operation, ScalarType, Step};
pub(super) use crate::sincos::proof::Errors;
use crate::sincos::proof::approximations;

type Own = Operand<Literal, Part>;

/// Bounds for r in a part of its range, given by its ends, and ℓ up to a magnitude.
pub(super) fn bound(left: &Left, scalar: ScalarType, ends: [f64; 2], lacks: f64) -> Option<Errors> {
    let rest = Interval::new(ends[0], ends[1])?;
    let lacks = Interval::symmetric(lacks);
    let read = |operand: &Own, values: &[Interval]| match operand {
        Operand::Input(Part::Rest) => rest,
        Operand::Input(Part::Lacks) => lacks,
        Operand::Constant(value) => Interval::point(value.0),
        Operand::Step(step) => values.get(*step).copied().unwrap_or(Interval::ALL),
    };
    let operands = |index: usize, values: &[Interval]| {
        let step = &left.steps[index];
        [&step.left, &step.right].map(|operand| read(operand, values))
    };
    let u = scalar.unit_roundoff();
    let run = |exact: &[bool]| {
        rounding::forward(&left.steps, operands, |index, value| {
            let eta = match underflows(&left.steps, index) {
                true => underflow(scalar),
                false => 0.0,
            };
            match exact.get(index) {
                Some(true) => eta,
                _ => ((u * binade(value.magnitude())).next_up() + eta).next_up(),
            }
        })
    };
    // As if all were rounded: what they can be tells which are not.
    let rough = run(&[]);
    let exact: Vec<bool> = (0..left.steps.len())
        .map(|index| is_exact(&left.steps, index, operands(index, &rough.values)))
        .collect();
    let ran = run(&exact);
    let approximation = approximations(&without(left), rest)?;
    let angle = rest - lacks;
    let one = |result: &Own, approximation: f64, wave: Interval, slope: Interval| {
        let all = |index| operands(index, &ran.values);
        let (rounding, derivative) = passed_on(left, &ran, result, all)?;
        let lacks = Interval::point(lacks.magnitude());
        let lost = lacks * Interval::point((derivative - slope).magnitude());
        let before = Interval::point(rounding) + Interval::point(approximation) + lost;
        let last = last_rounding(wave.magnitude().min(1.0), before.high(), u);
        Some((before + Interval::point(last)).high())
    };
    let (sin, cos) = (angle.sin(), angle.cos());
    Some(Errors {
        sin: one(&left.sin, approximation.sin, sin, -cos)?,
        cos: one(&left.cos, approximation.cos, cos, sin)?,
    })
}

/// Returns half an ulp of what is at most so large, up to an error: to a power of two nothing is
/// further than the error by which it is above.
fn last_rounding(size: f64, error: f64, u: f64) -> f64 {
    let below = binade(size);
    let half = if below < size { below } else { 0.5 * below };
    (u * half).max(error)
}

/// Returns what the roundings of all steps but the last come to in a result, which is a sum, and
/// what it changes by for a change of ℓ.
fn passed_on(
    left: &Left,
    ran: &Forward,
    result: &Own,
    operands: impl Fn(usize) -> [Interval; 2],
) -> Option<(f64, Interval)> {
    let Operand::Step(top) = result else {
        return None;
    };
    if !matches!(
        left.steps.get(*top)?.operation,
        Operation::Add | Operation::Sub
    ) {
        return None;
    }
    let (mut sum, mut slope) = (Interval::ZERO, Interval::ZERO);
    let visit = |index: usize, adjoint: &Interval| {
        if index != *top {
            let own = Interval::point(ran.own[index]);
            sum = sum + Interval::point(adjoint.magnitude()) * own;
        }
        true
    };
    let leaf = |leaf: Leaf<'_, Literal, Part>, part: Interval| {
        if *leaf.operand == Operand::Input(Part::Lacks) {
            slope = slope + part;
        }
    };
    backward(&left.steps, *top, operands, visit, leaf);
    Some((sum.high(), slope))
}

/// Returns whether a step does not round, from what it reads.
fn is_exact(steps: &[Step<Literal, Part>], index: usize, [x, y]: [Interval; 2]) -> bool {
    let step = &steps[index];
    let power = |operand: &Own| match operand {
        Operand::Constant(Literal(c)) => c.is_normal() && binade(c.abs()) == c.abs(),
        _ => false,
    };
    let at = |operand: &Own| match operand {
        Operand::Step(before) => steps.get(*before),
        _ => None,
    };
    let scales = |step: &Step<Literal, Part>| power(&step.left) || power(&step.right);
    match step.operation {
        Operation::Mul => scales(step),
        Operation::Fused => true,
        Operation::Sub => {
            let near = x.low() > 0.0 && y.high() <= 2.0 * x.low() && x.high() <= 2.0 * y.low();
            // A product that is no float is none of two near ones.
            let near = near && fusion(steps, index).is_none();
            // (c − t) − h with t = c − h: a fused h has a step before each.
            let is_float =
                |h: &Own| at(h).is_none_or(|h| h.operation != Operation::Fused || scales(h));
            let is_same = |a: &Own, b: &Own| {
                let both = at(a).zip(at(b));
                let fused = |(a, b): (&Step<_, _>, _)| a.operation == Operation::Fused && a == b;
                a == b || both.is_some_and(fused)
            };
            let first = at(&step.left).filter(|first| first.operation == Operation::Sub);
            let dekker = first.is_some_and(|first| {
                let t = at(&first.right).filter(|t| t.operation == Operation::Sub);
                let same =
                    t.is_some_and(|t| t.left == first.left && is_same(&t.right, &step.right));
                let larger = match first.left {
                    Operand::Constant(Literal(c)) => y.magnitude() <= c.abs(),
                    _ => false,
                };
                same && larger && is_float(&step.right)
            });
            near || dekker
        }
        _ => false,
    }
}

/// Returns the routine where ℓ is zero.
fn without(left: &Left) -> Kernel {
    let term = |operand: &Own| match operand {
        Operand::Input(Part::Rest) => ANGLE,
        Operand::Input(Part::Lacks) => literal(0.0),
        Operand::Constant(value) => Term::Constant(*value),
        Operand::Step(step) => Term::Step(*step),
    };
    let mut kernel = Kernel::default();
    for step in &left.steps {
        kernel.push(step.operation, term(&step.left), term(&step.right));
    }
    kernel.sin = Some(Value::of(term(&left.sin)));
    kernel.cos = Some(Value::of(term(&left.cos)));
    kernel
}
