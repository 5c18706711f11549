//! The text run at states of the box, beside the recursion at the same states: no proof,
//! but what would contradict one.

use crate::certificate::Claim;
use crate::dynamics::State;
use crate::fault::Fault;
use crate::interval::{SINE_ERROR, sin_cos};
use crate::number::Work;
use crate::number::{Number, Real};
use crate::polynomial::Polynomial;
use crate::program::{Node, Program, Source};
use crate::scene::Setting;

/// The states of all joints at numbers for q, q̇ and q̈.
pub fn states<N: Number>(setting: &Setting, at: &[Vec<f64>; 3]) -> Vec<State<N>> {
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

/// What is seen of each output at `count` states, of every second one all rates at ends of their ranges.
///
/// # Errors
/// As of [`crate::dynamics::torques`]; in practice none, numbers being short polynomials.
pub fn worst(
    claim: &Claim,
    setting: &Setting,
    program: &Program,
    count: usize,
) -> Result<Vec<Seen>, Fault> {
    let (mut random, work) = (Random(1), &mut Work::default());
    let lists = [&claim.position, &claim.velocity, &claim.acceleration];
    let mut worst = vec![Seen::default(); program.outputs.len()];
    for index in 0..count {
        let mut draw = |which: usize, &[low, high]: &[f64; 2]| {
            let (share, is_end) = (random.next(), which > 0 && index % 2 == 1);
            let value = low + (high - low) * if is_end { share.round() } else { share };
            held(value, [low, high], claim.scalar == "f32")
        };
        let state = [0, 1, 2].map(|which| {
            let drawn = lists[which].iter().map(|range| draw(which, range));
            drawn.collect::<Vec<f64>>()
        });
        let seen = at(claim, setting, program, &state, work)?;
        for (worst, own) in worst.iter_mut().zip(seen) {
            // So that a result that is no number counts.
            if own.off > worst.off || own.off.is_nan() {
                worst.off = own.off;
            }
            worst.size = worst.size.max(own.size);
        }
    }
    Ok(worst)
}

/// What is seen of each output at a state of the scalar's numbers.
///
/// # Errors
/// As of [`worst`].
pub(crate) fn at(
    claim: &Claim,
    setting: &Setting,
    program: &Program,
    state: &[Vec<f64>; 3],
    work: &mut Work,
) -> Result<Vec<Seen>, Fault> {
    let states: Vec<State<Polynomial>> = states(setting, state);
    let function = claim.function()?;
    let formula = function.outputs(setting, &states, &claim.rows(), work)?;
    let computed = run(program, state, claim.scalar == "f32");
    let pairs = formula.iter().zip(computed);
    let seen = pairs.map(|(formula, computed)| {
        let value = formula.terms.first().map_or(0.0, |term| term.1);
        Seen {
            off: (computed - value).abs() - formula.rest,
            size: value.abs() - formula.rest,
        }
    });
    Ok(seen.collect())
}

/// A number of the scalar within a range.
pub(crate) fn held(value: f64, [low, high]: [f64; 2], is_single: bool) -> f64 {
    let held = f64::from(value as f32);
    if is_single { held } else { value }.clamp(low, high)
}

/// Numbers that are the same on every machine.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    /// The next number, from zero to one.
    pub(crate) fn next(&mut self) -> f64 {
        // Knuth's multiplier and increment; the high bits are the good ones.
        let next = self.0.wrapping_mul(6_364_136_223_846_793_005);
        self.0 = next.wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// Runs the text in its scalar and returns its results.
pub(crate) fn run(program: &Program, state: &[Vec<f64>; 3], is_single: bool) -> Vec<f64> {
    // A sum or product of two f32 in f64, rounded to f32, is rounded as in f32: f64 has
    // more than twice as many bits.
    let round = |value: f64| match is_single {
        true => f64::from(value as f32),
        false => value,
    };
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
    program
        .outputs
        .iter()
        .map(|&output| values[output])
        .collect()
}

fn step(node: Node, values: &[f64], state: &[Vec<f64>; 3]) -> f64 {
    match node {
        Node::Constant(value) => value,
        Node::Input(argument, joint) => state[argument][joint],
        Node::Add(a, b) => values[a] + values[b],
        Node::Sub(a, b) => values[a] - values[b],
        Node::Mul(a, b) => values[a] * values[b],
        Node::Neg(a) => -values[a],
        Node::Fused(a, b, c) => values[a].mul_add(values[b], values[c]),
        Node::Sine(..) => f64::NAN,
    }
}
