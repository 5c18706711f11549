//! Bounds of one rounding, and of how far polynomials of an angle are from its sine and its cosine.

use std::f64::consts::{PI, TAU};

use crate::interval::{FARTHEST, Interval, SINE_ERROR, UNIT, sin_cos};
use crate::polynomial::SLACK;
use crate::program::{Operand, Program, Step};

const CELLS: usize = 1 << 14;

#[derive(Clone, Copy, Debug)]
pub struct Scalar {
    /// The relative cost of rounding to nearest.
    pub unit: f64,
    /// The cost beside that where results underflow.
    pub least: f64,
    /// The size beyond which results are too near to overflow: states a little outside would.
    pub most: f64,
    /// The largest angle of which whole turns are taken off, rad.
    pub far: f64,
}

impl Scalar {
    pub fn new(is_single: bool) -> Scalar {
        let (unit, least, most, far) = match is_single {
            true => (f64::from(f32::EPSILON) / 2.0, 1e-45, 1e30, 1e3),
            false => (UNIT, f64::from_bits(1), 1e280, 1e6),
        };
        Scalar {
            unit,
            least,
            most,
            far,
        }
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

/// Bounds how far polynomials of an angle are from its sine or cosine, with the rounding on the way;
/// infinite if nothing can be said. Polynomials that take off whole turns first are bounded as
/// far as [`Scalar::far`], wherever the angle is.
pub fn error(
    polynomials: &Program<f64>,
    result: usize,
    is_sine: bool,
    range: Interval,
    scalar: Scalar,
) -> f64 {
    match Reduction::read(polynomials, scalar) {
        None => error_near(polynomials, result, is_sine, range, scalar),
        Some(_) if !(range.magnitude() <= scalar.far) => f64::INFINITY,
        Some(reduction) => {
            let near = Interval::new(-reduction.most, reduction.most);
            reduction.error + error_near(&reduction.rest, result, is_sine, near, scalar)
        }
    }
}

/// Polynomials behind the steps that take whole turns off an angle.
struct Reduction {
    rest: Program<f64>,
    /// The largest angle that is left, and how far it is from the angle less whole turns.
    most: f64,
    error: f64,
}

impl Reduction {
    /// k = (q·ι + M) − M with ι ≈ 1/2π, and M so that floats next to it are the integers; then
    /// (q − k·A) − k·B with A + B ≈ 2π, where k·A is exact.
    fn read(program: &Program<f64>, scalar: Scalar) -> Option<Reduction> {
        const ANGLE: Operand<f64> = Operand::Entry(0, 0);
        let (steps, behind) = program.steps.split_first_chunk::<7>()?;
        let number = |step: usize| match steps[step].1[1] {
            Operand::Constant(value) => Some(value),
            _ => None,
        };
        let [inverse, magic, much, little] = [number(0)?, number(1)?, number(3)?, number(5)?];
        let of = |operation, a, b| (operation, [a, b]);
        let (step, value) = (Operand::Step, Operand::Constant);
        let expected = [
            of('*', ANGLE, value(inverse)),
            of('+', step(0), value(magic)),
            of('-', step(1), value(magic)),
            of('*', step(2), value(much)),
            of('-', ANGLE, step(3)),
            of('*', step(2), value(little)),
            of('-', step(4), step(5)),
        ];
        // Nothing else reads what came before.
        let moved = |operand: &Operand<f64>| match operand {
            Operand::Step(6) => Some(ANGLE),
            Operand::Step(step) => step.checked_sub(7).map(Operand::Step),
            Operand::Constant(value) => Some(Operand::Constant(*value)),
            _ => None,
        };
        let step = |(operation, [a, b]): &Step<f64>| Some((*operation, [moved(a)?, moved(b)?]));
        let output =
            |(negative, operand): &(bool, Operand<f64>)| Some((*negative, moved(operand)?));
        let rest = Program {
            steps: behind.iter().map(step).collect::<Option<_>>()?,
            outputs: program.outputs.iter().map(output).collect::<Option<_>>()?,
        };
        let (unit, least, far) = (scalar.unit, scalar.least, scalar.far);
        // 2^(p − 1) times 1.5, of p bits.
        (*steps == expected && magic == 0.75 / unit).then_some(())?;
        let scaled = far * inverse.abs();
        let counted = far * ((inverse - INVERSE).abs() + 2e-17) + unit * scaled + least;
        let turns = (scaled + 1.0).ceil();
        (4.0 * turns * unit < 1.0).then_some(())?;
        // k·A is exact: k has so many bits at most, and A the others.
        let grid = (turns as u64).next_power_of_two() as f64 * unit;
        let is_short = much > 4.0 && (much / (8.0 * grid)).fract() == 0.0 && much < 8.0;
        // Both differences are exact, of numbers so near to one another.
        let apart = TAU - much;
        let is_near = little > 0.5 * apart && little < 2.0 * apart;
        (is_short && is_near).then_some(())?;
        let off = ((apart - little) + TAU_REST).abs() + 1e-30;
        let most = (PI + TAU * counted) * (1.0 + 1e-15);
        let shift = turns * off + unit * (2.0 * turns * little + 3.0 * most + 1.0) + 3.0 * least;
        let error = shift * (1.0 + 1e-12);
        let most = (most + error) * (1.0 + 1e-15);
        Some(Reduction { rest, most, error })
    }
}

/// The double next to 1/2π, and 2π as the sum of two.
const INVERSE: f64 = 0.159_154_943_091_895_35;
const TAU_REST: f64 = 2.449_293_598_294_706_4e-16;

/// Bounds f, the polynomials of an angle in real numbers less its sine or cosine: the value and the
/// slope at the middle of each cell and the second derivative over the cell are enclosed, |f| ≤
/// |f(m)| + |f′(m)|·w + ½ max|f″|·w². The rounding on the way is added.
fn error_near(
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
        let (value, slope) = if is_sine { (sin, cos) } else { (cos, -sin) };
        let ([at, rise, _], _) = evaluate(polynomials, result, Interval::point(middle), scalar);
        let ([_, _, bend], rounding) = evaluate(polynomials, result, over, scalar);
        let apart = |interval: Interval, other: f64, radius: f64| {
            (interval + -Interval::around(other, radius)).magnitude()
        };
        // The second derivative of the sine is −sin, and so of the cosine.
        let bent = apart(bend, -value, half + SINE_ERROR);
        let off = apart(at, value, SINE_ERROR)
            + apart(rise, slope, SINE_ERROR) * half
            + 0.5 * bent * half * half
            + rounding;
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

/// The value and two derivatives over a range of angles, and the rounding error up to it.
type Enclosed = ([Interval; 3], f64);

fn evaluate(program: &Program<f64>, result: usize, angle: Interval, scalar: Scalar) -> Enclosed {
    let leaf = |operand: &Operand<f64>| match operand {
        Operand::Constant(literal) => Some(([*literal, 0.0, 0.0].map(Interval::point), 0.0)),
        Operand::Entry(..) => {
            let [one, zero] = [1.0, 0.0].map(Interval::point);
            Some(([angle, one, zero], 0.0))
        }
        _ => None,
    };
    let apply = |operation: char, (a, a_error): Enclosed, (b, b_error): Enclosed| {
        let (intervals, inherited) = match operation {
            '+' => ([0, 1, 2].map(|k| a[k] + b[k]), a_error + b_error),
            '-' => ([0, 1, 2].map(|k| a[k] + -b[k]), a_error + b_error),
            '*' | '×' => {
                let a_term = a_error * (b[0].magnitude() + b_error);
                let inherited = a_term + b_error * a[0].magnitude();
                let cross = a[1] * b[1];
                let bend = a[2] * b[0] + (cross + cross) + a[0] * b[2];
                ([a[0] * b[0], a[1] * b[0] + a[0] * b[1], bend], inherited)
            }
            _ => ([Interval::NOTHING_KNOWN; 3], 0.0),
        };
        let error = match operation {
            '×' => inherited,
            _ => scalar.rounded(intervals[0].magnitude(), inherited),
        };
        (intervals, error)
    };
    let opposite = |(intervals, error): Enclosed| (intervals.map(|interval| -interval), error);
    let results = program.run(leaf, apply, opposite).unwrap_or_default();
    let nothing = ([Interval::NOTHING_KNOWN; 3], f64::INFINITY);
    results.get(result).copied().unwrap_or(nothing)
}
