//! The text run at states of the box, beside the recursion at the same states: no proof,
//! but what would contradict one.

use crate::certificate::Claim;
use crate::dynamics::State;
use crate::fault::Fault;
use crate::interval::{SINE_ERROR, sin_cos};
use crate::number::{Number, Real, Work};
use crate::polynomial::Polynomial;
use crate::program::{Node, Program, Source};
use crate::scene::Setting;

/// A state: positions, velocities and accelerations.
pub(crate) type At = [Vec<f64>; 3];

/// Returns the outputs of a claim's function at a state.
///
/// # Errors
/// As of [`crate::dynamics::torques`]; in practice none, numbers being short polynomials.
pub(crate) fn outputs<N: Number>(
    claim: &Claim,
    setting: &Setting,
    at: &At,
    work: &mut Work,
) -> Result<Vec<N>, Fault> {
    let (states, rows) = (states(setting, at), claim.rows());
    claim.function()?.outputs(setting, &states, &rows, work)
}

/// Returns the state of each joint.
pub(crate) fn states<N: Number>(setting: &Setting, at: &[Vec<f64>]) -> Vec<State<N>> {
    let number = |value: f64, radius: f64| N::constant(Real { value, radius });
    let state = |joint: usize| {
        let [q, velocity, acceleration] = [0, 1, 2].map(|which: usize| at[which][joint]);
        let moves = |which: usize| setting.locks[joint].is_none() && !setting.still[which];
        let (sin, cos) = sin_cos(q);
        let [sin, cos] = [sin, cos].map(|value| number(value, SINE_ERROR));
        let free = [sin, cos, number(q, 0.0)];
        let [sin, cos, position] = setting.locks[joint].map_or(free, |at| at.map(N::constant));
        State {
            sin,
            cos,
            position,
            velocity: number(if moves(0) { velocity } else { 0.0 }, 0.0),
            acceleration: number(if moves(1) { acceleration } else { 0.0 }, 0.0),
        }
    };
    (0..setting.joints.len()).map(state).collect()
}

/// The errors seen of an output.
#[derive(Clone, Copy, Debug, Default)]
pub struct Seen {
    /// The largest difference between text and recursion.
    pub off: f64,
    /// The largest magnitude.
    pub size: f64,
}

/// Returns what is seen of each output at `count` states, of every second one all rates at ends of their ranges.
///
/// # Errors
/// As of [`outputs`].
pub fn worst(
    claim: &Claim,
    setting: &Setting,
    program: &Program,
    count: usize,
) -> Result<Vec<Seen>, Fault> {
    let mut random = Random(1);
    let mut worst = vec![Seen::default(); program.outputs.len()];
    for index in 0..count {
        let is_odd = index % 2 == 1;
        let state = random.state(setting, [false, is_odd, is_odd]);
        for (worst, own) in worst
            .iter_mut()
            .zip(seen(claim, setting, program, state)?.0)
        {
            // So that a result that is no number counts.
            if own.off > worst.off || own.off.is_nan() {
                worst.off = own.off;
            }
            worst.size = worst.size.max(own.size);
        }
    }
    Ok(worst)
}

/// Returns what is seen of each output at a state, once that is of the scalar's numbers.
///
/// # Errors
/// As of [`outputs`].
pub(crate) fn seen(
    claim: &Claim,
    setting: &Setting,
    program: &Program,
    mut at: At,
) -> Result<(Vec<Seen>, At), Fault> {
    let is_single = claim.scalar == "f32";
    let values = at.iter_mut().flatten();
    for (value, range) in values.zip(setting.ranges.iter().flatten()) {
        let [low, high] = ends(*range);
        *value = rounded(*value, is_single).clamp(low, high);
    }
    let formula: Vec<Polynomial> = outputs(claim, setting, &at, &mut Work::default())?;
    let computed = run(program, &at, is_single);
    let seen = formula.iter().zip(computed).map(|(formula, computed)| {
        let (value, size) = (formula.value(), formula.value().abs());
        Seen {
            off: (computed - value).abs() - formula.rest,
            size: size - formula.rest,
        }
    });
    Ok((seen.collect(), at))
}

/// Numbers that are the same on every machine.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    /// Returns the next number, from zero to one.
    pub(crate) fn next(&mut self) -> f64 {
        // Knuth's multiplier and increment; the high bits are the good ones.
        let next = self.0.wrapping_mul(6_364_136_223_846_793_005);
        self.0 = next.wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Returns a number of a range, or one of its ends.
    pub(crate) fn within(&mut self, range: [f64; 2], is_end: bool) -> f64 {
        let ([low, high], share) = (ends(range), self.next());
        low + (high - low) * if is_end { share.round() } else { share }
    }

    /// Returns a state of the box; positions, velocities or accelerations may be ends of their ranges.
    pub(crate) fn state(&mut self, setting: &Setting, are_ends: [bool; 3]) -> At {
        [0, 1, 2].map(|which: usize| {
            let ranges = setting.ranges[which].iter();
            let drawn = ranges.map(|range| self.within(*range, are_ends[which]));
            drawn.collect()
        })
    }
}

pub(crate) fn rounded(value: f64, is_single: bool) -> f64 {
    let single = f64::from(value as f32);
    if is_single { single } else { value }
}

/// Returns a range, of what has none a point.
pub(crate) fn ends([low, high]: [f64; 2]) -> [f64; 2] {
    if low <= high { [low, high] } else { [0.0; 2] }
}

/// Runs the text in its scalar and returns its results.
pub(crate) fn run(program: &Program, state: &[Vec<f64>], is_single: bool) -> Vec<f64> {
    // A sum or product of two f32 in f64, rounded to f32, is rounded as in f32: f64 has
    // more than twice as many bits.
    let round = |value: f64| rounded(value, is_single);
    let mut values: Vec<f64> = Vec::with_capacity(program.nodes.len());
    for &node in &program.nodes {
        let value = match node {
            Node::Sine(angle, is_sine, Source::Library) => {
                let (sin, cos) = sin_cos(values[angle]);
                if is_sine { sin } else { cos }
            }
            Node::Sine(angle, _, Source::Block(block, result)) => {
                let mut inside = vec![values[angle]];
                for &node in program.blocks[block].iter().skip(1) {
                    inside.push(round(step(node, &inside, state)));
                }
                inside[result]
            }
            Node::Fused(a, b, c) if is_single => {
                let [a, b, c] = [a, b, c].map(|node| values[node] as f32);
                f64::from(a.mul_add(b, c))
            }
            _ => step(node, &values, state),
        };
        values.push(round(value));
    }
    let outputs = program.outputs.iter();
    outputs.map(|&output| values[output]).collect()
}

fn step(node: Node, values: &[f64], state: &[Vec<f64>]) -> f64 {
    match node {
        Node::Constant(value) => value,
        Node::Input(argument, joint) => state[argument][joint],
        Node::Add(a, b) => values[a] + values[b],
        Node::Sub(a, b) => values[a] - values[b],
        Node::Mul(a, b) => values[a] * values[b],
        Node::Div(a, b) => values[a] / values[b],
        Node::Neg(a) => -values[a],
        Node::Fused(a, b, c) => values[a].mul_add(values[b], values[c]),
        Node::Sine(..) => f64::NAN,
    }
}
