//! The text run at states of the box, beside the recursion in doubles: no proof, but what
//! would contradict one.

use crate::certificate::{Claim, Function};
use crate::dynamics::{State, torques};
use crate::fault::Fault;
use crate::interval::sin_cos;
use crate::polynomial::Work;
use crate::scene::{Lock, Setting};
use crate::text::{Argument, Node, Program, Source};

/// Numbers from 0 to 1, the same on every machine.
#[derive(Debug)]
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        // Knuth's multiplier and increment; the high bits are the good ones.
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// The largest difference between text and recursion that is seen, one an output: at
/// `count` states, of every second one all rates at ends of their ranges.
///
/// # Errors
/// None in practice: doubles have no terms to count.
pub fn worst(claim: &Claim, setting: &Setting, program: &Program, count: usize) -> Result<Vec<f64>, Fault> {
    let mut random = Random(1);
    let mut worst = vec![0.0f64; program.outputs.len()];
    for index in 0..count {
        let lists = [&claim.ranges.position, &claim.ranges.velocity, &claim.ranges.acceleration];
        let state = [0, 1, 2].map(|which| {
            let draw = |&[low, high]: &[f64; 2]| {
                let share = random.next();
                let at_end = which > 0 && index % 2 == 1;
                let value = low + (high - low) * if at_end { share.round() } else { share };
                // The scalar's numbers only.
                if claim.is_single { f64::from(value as f32).clamp(low, high) } else { value.clamp(low, high) }
            };
            lists[which].iter().map(draw).collect::<Vec<f64>>()
        });
        let formula = formula(claim, setting, &state)?;
        let computed = run(program, &state);
        for ((worst, formula), computed) in worst.iter_mut().zip(formula).zip(computed) {
            let off = (computed - formula).abs();
            *worst = if off <= *worst { *worst } else { off };
        }
    }
    Ok(worst)
}

/// The function's outputs by the recursion.
fn formula(claim: &Claim, setting: &Setting, state: &[Vec<f64>; 3]) -> Result<Vec<f64>, Fault> {
    let at = |joint: usize| {
        let [q, velocity, acceleration] = [0, 1, 2].map(|which: usize| state[which][joint]);
        let (q, sin, cos) = match setting.locks[joint] {
            Some(Lock::Angle(angle)) => {
                let (sin, cos) = angle.sin_cos();
                (0.0, sin.value, cos.value)
            }
            Some(Lock::Length(length)) => (length.value, 0.0, 1.0),
            None => (q, sin_cos(q).0, sin_cos(q).1),
        };
        let moves = |which: usize| setting.locks[joint].is_none() && !setting.still[which];
        let velocity = if moves(0) { velocity } else { 0.0 };
        let acceleration = if moves(1) { acceleration } else { 0.0 };
        State { sin, cos, position: q, velocity, acceleration }
    };
    let states: Vec<State<f64>> = (0..setting.locks.len()).map(at).collect();
    outputs(claim, setting, &states, &mut Work::default(), &0.0, &1.0)
}

/// The function's outputs over the rows, in any numbers: that the audit's polynomials are
/// of the same formula is seen here.
///
/// # Errors
/// As of [`torques`].
pub fn outputs<T: crate::number::Number>(
    claim: &Claim,
    setting: &Setting,
    states: &[State<T>],
    work: &mut Work,
    zero: &T,
    one: &T,
) -> Result<Vec<T>, Fault> {
    let robot = &setting.robot;
    let mut states = states.to_vec();
    let (still, unforced) = match claim.function {
        Function::InverseDynamics => (false, false),
        Function::Gravity | Function::Inertia => (true, true),
        Function::Coriolis => (false, true),
    };
    for state in &mut states {
        state.velocity = if still { zero.clone() } else { state.velocity.clone() };
        state.acceleration = if unforced { zero.clone() } else { state.acceleration.clone() };
    }
    let select = |all: Vec<T>| claim.rows.iter().map(|&row| all[row].clone()).collect::<Vec<T>>();
    let loads = match claim.function {
        Function::InverseDynamics => (true, true),
        Function::Gravity => (true, false),
        Function::Inertia | Function::Coriolis => (false, false),
    };
    if claim.function != Function::Inertia {
        return Ok(select(torques(robot, &states, loads, work)?));
    }
    let mut columns = Vec::new();
    for &row in &claim.rows {
        states[row].acceleration = one.clone();
        columns.push(select(torques(robot, &states, loads, work)?));
        states[row].acceleration = zero.clone();
    }
    // D is symmetric; row by row, from its columns.
    let entry = |i: usize| columns.iter().map(move |column| column[i].clone());
    Ok((0..claim.rows.len()).flat_map(entry).collect())
}

/// What the text returns, computed in its scalar.
fn run(program: &Program, state: &[Vec<f64>; 3]) -> Vec<f64> {
    let round = |value: f64| if program.is_single { f64::from(value as f32) } else { value };
    let sines = |angle: f64| match program.is_single {
        true => (f64::from(libm::sinf(angle as f32)), f64::from(libm::cosf(angle as f32))),
        false => libm::sincos(angle),
    };
    let mut values: Vec<f64> = Vec::with_capacity(program.nodes.len());
    for &node in &program.nodes {
        let value = match node {
            Node::Sin(angle, Source::Library) => sines(values[angle]).0,
            Node::Cos(angle, Source::Library) => sines(values[angle]).1,
            Node::Sin(angle, Source::Block(block, result)) | Node::Cos(angle, Source::Block(block, result)) => {
                let mut inside = vec![values[angle]];
                for &node in program.blocks[block].iter().skip(1) {
                    inside.push(round(step(node, &inside, state)));
                }
                inside[result]
            }
            _ => step(node, &values, state),
        };
        // A sum or product of two f32 in f64, rounded to f32, is rounded once: f64 has
        // more than twice as many bits and two.
        values.push(round(value));
    }
    program.outputs.iter().map(|&output| values[output]).collect()
}

fn step(node: Node, values: &[f64], state: &[Vec<f64>; 3]) -> f64 {
    match node {
        Node::Constant(value) => value,
        Node::Input(argument, joint) => state[match argument {
            Argument::Position => 0,
            Argument::Velocity => 1,
            Argument::Acceleration => 2,
        }][joint],
        Node::Add(a, b) => values[a] + values[b],
        Node::Sub(a, b) => values[a] - values[b],
        Node::Mul(a, b) => values[a] * values[b],
        Node::Neg(a) => -values[a],
        Node::Sin(..) | Node::Cos(..) => f64::NAN,
    }
}
