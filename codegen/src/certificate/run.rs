//! The text, run: whatever was proved, no state may contradict it.
//!
//! Corners of the box and random states, the same for the same certificate but
//! not to be aimed at: they are drawn from a hash of all that it says. Entries
//! of locked joints, and arguments that the function does not have, are filled
//! with other numbers at every state, which the text may not notice. The
//! reference is the robot's own recursion in 256 bits
//! ([`reference`](crate::verify::reference)), so nothing is granted: the bound
//! holds at each state, or it is refuted.

use hmac_sha256::Hash;

use super::{Certificate, Refuted};
use crate::bound::input_box::InputBox;
use crate::bound::sample::draw;
use crate::function::Argument;
use crate::interval::Interval;
use crate::program::{Lowered, ScalarType};
use crate::random::Random;
use crate::scene::SceneRobot;
use crate::sincos::stated;
use crate::states::JointState;
use crate::verify::reference::{Reference, recursions};

/// States of a function that takes one recursion; the more it takes, the fewer.
const MAX_STATES: usize = 256;

/// Nor fewer than this.
const MIN_STATES: usize = 24;

/// Corners among them.
const MAX_CORNERS: usize = 16;

/// What was seen.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Ran {
    /// At how many states.
    pub states: usize,
    /// The largest error of each output, relative to its T; zero where T is.
    pub observed: Vec<f64>,
}

/// Runs the text at a modest number of states.
pub(super) fn check(certificate: &Certificate, scene_robot: &SceneRobot) -> Result<Ran, Refuted> {
    let all = recursions(certificate.emitted.function, scene_robot.joints().len());
    let states = (MAX_STATES / all.max(1)).clamp(MIN_STATES, MAX_STATES);
    check_at(certificate, scene_robot, states)
}

/// The same at so many states.
pub(super) fn check_at(
    certificate: &Certificate,
    scene_robot: &SceneRobot,
    states: usize,
) -> Result<Ran, Refuted> {
    let function = certificate.emitted.function;
    let text = Lowered::parse(&certificate.text, function, certificate.scalar)
        .map_err(|error| Refuted::Unreadable(Box::new(error)))?;
    let reference = Reference::new(scene_robot);
    let mut random = Random::new(seed(certificate));
    let bounds = certificate.bounds.iter().zip(&certificate.scales);
    // Up: the product of two doubles is one of the two next to it.
    let bounds: Vec<f64> = bounds
        .map(|(bound, t)| (bound.total() * t).next_up())
        .collect();
    let mut ran = Ran {
        states: 0,
        observed: vec![0.0; bounds.len()],
    };
    let limits = reached(certificate, scene_robot);
    for index in 0..states {
        let drawn = match index {
            0..MAX_CORNERS => corner(&limits, index, &mut random),
            _ => draw(&limits, &mut random),
        };
        let Some(state) = held(&drawn, &limits, certificate.scalar, scene_robot) else {
            continue;
        };
        let unread = with_garbage(&state, certificate, scene_robot, &mut random);
        let results = text.run_at(&unread);
        let truth = reference.run(function, &state);
        ran.states += 1;
        for (output, (result, truth)) in results.iter().zip(&truth).enumerate() {
            let (error, scale) = (truth.error(*result), certificate.scales[output]);
            if error > bounds[output] {
                return Err(Refuted::Ran {
                    entry: certificate.emitted.entry(output),
                    error,
                    bound: bounds[output],
                    state: Box::new(state),
                });
            }
            if scale > 0.0 {
                let seen = &mut ran.observed[output];
                *seen = seen.max(error / scale);
            }
        }
    }
    Ok(ran)
}

/// The box, and for joints that turn freely the angles that it reaches to.
fn reached(certificate: &Certificate, scene_robot: &SceneRobot) -> InputBox {
    let mut limits = certificate.limits.clone();
    let every = Interval::symmetric(stated(certificate.scalar));
    for (joint, range) in limits.position.iter_mut().enumerate() {
        if scene_robot.lock(joint).is_none() {
            let held = certificate.positions(scene_robot.robot(), joint);
            *range = held.unwrap_or(every);
        }
    }
    limits
}

/// From all that the claim says.
fn seed(certificate: &Certificate) -> u64 {
    let Certificate {
        robot,
        input,
        text,
        limits,
        bounds,
        stages,
        ..
    } = certificate;
    let said = format!("{robot}\0{input}\0{text}\0{limits:?}\0{bounds:?}\0{stages:?}");
    let hash = Hash::hash(said.as_bytes());
    let first = hash.iter().take(8);
    first.fold(0, |seed, &byte| seed << 8 | u64::from(byte))
}

/// All ends low, all high, the middle, then ends at random.
fn corner(limits: &InputBox, index: usize, random: &mut Random) -> JointState {
    let mut end = |x: &Interval| match index {
        0 => x.low(),
        1 => x.high(),
        2 => x.mid(),
        _ if random.below(2) == 0 => x.low(),
        _ => x.high(),
    };
    JointState {
        q: limits.position.iter().map(&mut end).collect(),
        qd: limits.velocity.iter().map(&mut end).collect(),
        qdd: limits.acceleration.iter().map(&mut end).collect(),
        ..JointState::default()
    }
}

/// The state in the scalar's own numbers; `None` if none are inside the box,
/// or it is not finite. Locked joints are where the scene says.
fn held(
    state: &JointState,
    limits: &InputBox,
    scalar: ScalarType,
    scene_robot: &SceneRobot,
) -> Option<JointState> {
    let hold = |values: &[f64], ranges: &[Interval]| {
        let pairs = values.iter().zip(ranges).enumerate();
        let one = |(joint, (&x, range)): (usize, (&f64, &Interval))| {
            let inside = |x: f64| range.low() <= x && x <= range.high();
            match scalar {
                _ if scene_robot.lock(joint).is_some() => Some(x),
                ScalarType::F64 => inside(x).then_some(x),
                ScalarType::F32 => {
                    let near = x as f32;
                    let near = [near, near.next_down(), near.next_up()];
                    near.map(f64::from).into_iter().find(|&x| inside(x))
                }
            }
        };
        pairs.map(one).collect::<Option<Vec<f64>>>()
    };
    let state = JointState {
        q: hold(&state.q, &limits.position)?,
        qd: hold(&state.qd, &limits.velocity)?,
        qdd: hold(&state.qdd, &limits.acceleration)?,
        ..JointState::default()
    };
    state.is_finite().then_some(state)
}

/// The state with other numbers where nothing may be read.
fn with_garbage(
    state: &JointState,
    certificate: &Certificate,
    scene_robot: &SceneRobot,
    random: &mut Random,
) -> JointState {
    let mut garbage = || 1e3 * (random.unit() - 0.5);
    let mut state = state.clone();
    let arguments = [
        (Argument::Position, &mut state.q),
        (Argument::Velocity, &mut state.qd),
        (Argument::Acceleration, &mut state.qdd),
    ];
    for (argument, entries) in arguments {
        let is_read = certificate.emitted.arguments.contains(&argument);
        for (joint, entry) in entries.iter_mut().enumerate() {
            if !is_read || scene_robot.lock(joint).is_some() {
                *entry = garbage();
            }
        }
    }
    state
}
