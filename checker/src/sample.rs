//! The text run at states of the box, beside the recursion at the same states: no proof,
//! but what would contradict one.

use crate::certificate::{Claim, Function};
use crate::dynamics::{State, torques};
use crate::fault::Fault;
use crate::interval::{SINE_ERROR, sin_cos};
use crate::number::{Number, Real};
use crate::polynomial::{Polynomial, Work};
use crate::program::{Node, Program, Source};
use crate::scene::Setting;

/// The outputs of the function that is claimed, by the recursion.
///
/// # Errors
/// As of [`torques`].
pub fn outputs<N: Number>(
    claim: &Claim,
    setting: &Setting,
    states: &[State<N>],
    work: &mut Work,
) -> Result<Vec<N>, Fault> {
    let mut states = states.to_vec();
    for state in &mut states {
        if matches!(claim.function, Function::Gravity | Function::Inertia) {
            state.velocity = N::default();
        }
        if claim.function != Function::InverseDynamics {
            state.acceleration = N::default();
        }
    }
    let loads = match claim.function {
        Function::InverseDynamics | Function::Other => (true, true),
        Function::Gravity => (true, false),
        Function::Inertia | Function::Coriolis => (false, false),
    };
    let select = |all: Vec<N>| claim.rows.iter().map(|&row| all[row - 1].clone()).collect();
    if claim.function != Function::Inertia {
        return Ok(select(torques(setting, &states, loads, work)?));
    }
    let mut columns: Vec<Vec<N>> = Vec::new();
    for row in &claim.rows {
        states[row - 1].acceleration = N::one();
        columns.push(select(torques(setting, &states, loads, work)?));
        states[row - 1].acceleration = N::default();
    }
    let entries = |i: usize| columns.iter().map(move |column| column[i].clone());
    Ok((0..claim.rows.len()).flat_map(entries).collect())
}

/// The states of all joints at numbers for q, q̇ and q̈.
pub fn states<N: Number>(setting: &Setting, at: &[Vec<f64>; 3]) -> Vec<State<N>> {
    let number = |value: f64, radius: f64| N::constant(Real { value, radius });
    let state = |joint: usize| {
        let [q, velocity, acceleration] = [0, 1, 2].map(|which: usize| at[which][joint]);
        let moves = |which: usize| setting.locks[joint].is_none() && !setting.still[which];
        let (sin, cos, position) = match setting.locks[joint] {
            Some((angle, position)) => {
                let [sin, cos, position] = [angle.sin, angle.cos, position].map(N::constant);
                (sin, cos, position)
            }
            None => {
                let (sin, cos) = sin_cos(q);
                let [sin, cos] = [sin, cos].map(|value| number(value, SINE_ERROR));
                (sin, cos, number(q, 0.0))
            }
        };
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

/// The largest difference between text and recursion that is seen, one an output: at
/// `count` states, of every second one all rates at ends of their ranges.
///
/// # Errors
/// As of [`torques`]; in practice none, numbers being short polynomials.
pub fn worst(
    claim: &Claim,
    setting: &Setting,
    program: &Program,
    count: usize,
) -> Result<Vec<f64>, Fault> {
    let (mut random, work) = (Random(1), &mut Work::default());
    let lists = [&claim.position, &claim.velocity, &claim.acceleration];
    let mut worst = vec![0.0f64; program.outputs.len()];
    for index in 0..count {
        let mut draw = |which: usize, &[low, high]: &[f64; 2]| {
            let share = if which > 0 && index % 2 == 1 {
                random.next().round()
            } else {
                random.next()
            };
            let value = low + (high - low) * share;
            let held = if claim.scalar == "f32" {
                f64::from(value as f32)
            } else {
                value
            };
            held.clamp(low, high)
        };
        let state = [0, 1, 2].map(|which| {
            lists[which]
                .iter()
                .map(|range| draw(which, range))
                .collect::<Vec<f64>>()
        });
        let states: Vec<State<Polynomial>> = states(setting, &state);
        let formula = outputs(claim, setting, &states, work)?;
        let computed = run(program, &state, claim.scalar == "f32");
        for ((worst, formula), computed) in worst.iter_mut().zip(formula).zip(computed) {
            let value = formula.terms.first().map_or(0.0, |term| term.1);
            let off = (computed - value).abs() - formula.rest;
            // So that a result that is no number counts.
            *worst = if off <= *worst { *worst } else { off };
        }
    }
    Ok(worst)
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

/// What the text returns, computed in its scalar.
fn run(program: &Program, state: &[Vec<f64>; 3], is_single: bool) -> Vec<f64> {
    // A sum or product of two f32 in f64, rounded to f32, is rounded as in f32: f64 has
    // more than twice as many bits.
    let round = |value: f64| {
        if is_single {
            f64::from(value as f32)
        } else {
            value
        }
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
        Node::Sine(..) => f64::NAN,
    }
}
