//! Seeded joint states inside a robot's limits.

use dalembert_model::number::Rounded;
use dalembert_model::outputs::{Argument, Sizes};
use dalembert_model::robot::{Joint, JointKind, Limit, Position, Robot};

use crate::random::Random;

/// One value a joint, but for wrench, damping, gravity, load and what makes a load.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct JointState {
    /// Positions, rad or m.
    pub q: Vec<f64>,
    /// Velocities, the same per second.
    pub qd: Vec<f64>,
    /// Accelerations, per second squared.
    pub qdd: Vec<f64>,
    /// Torques; as what follows empty where nothing reads them.
    pub tau: Vec<f64>,
    /// Velocities wished for.
    pub v: Vec<f64>,
    /// Accelerations wished for.
    pub a: Vec<f64>,
    /// Force over moment that act on the hand.
    pub wrench: Vec<f64>,
    /// λ², one number.
    pub damping: Vec<f64>,
    /// λ, which torques or accelerations are multiplied by.
    pub multiplier: Vec<f64>,
    /// The acceleration of gravity in base axes, where it is an argument.
    pub g: Vec<f64>,
    /// The load that the arguments of `load` are, where it is an argument.
    pub load: Vec<f64>,
    /// Mass, centre of mass and inertia of each link whose body is an argument.
    pub bodies: Vec<f64>,
    /// Rotors' inertias, one a row, where they are arguments.
    pub armature: Vec<f64>,
    /// Viscous friction, one a row, where it is an argument.
    pub viscous: Vec<f64>,
    /// Mass, centre of mass and inertia of a payload, where it is one.
    pub payload: Vec<f64>,
}

impl JointState {
    pub fn new(mut entries: impl FnMut(Argument) -> Vec<f64>) -> JointState {
        let mut state = JointState::default();
        for argument in Argument::ALL {
            *state.entries_mut(argument) = entries(argument);
        }
        state
    }

    /// Makes the state of joints that stand still.
    pub fn at_rest(q: Vec<f64>) -> JointState {
        JointState {
            qd: vec![0.0; q.len()],
            qdd: vec![0.0; q.len()],
            q,
            ..JointState::default()
        }
    }

    pub fn entries(&self, argument: Argument) -> &[f64] {
        match argument {
            Argument::Position => &self.q,
            Argument::Velocity => &self.qd,
            Argument::Acceleration => &self.qdd,
            Argument::Torque => &self.tau,
            Argument::ReferenceVelocity => &self.v,
            Argument::ReferenceAcceleration => &self.a,
            Argument::Wrench => &self.wrench,
            Argument::Damping => &self.damping,
            Argument::Multiplier => &self.multiplier,
            Argument::Gravity => &self.g,
            Argument::Load => &self.load,
            Argument::Bodies => &self.bodies,
            Argument::Armature => &self.armature,
            Argument::Viscous => &self.viscous,
            Argument::Payload => &self.payload,
        }
    }

    pub fn is_finite(&self) -> bool {
        let is_finite = |argument| self.entries(argument).iter().all(|x| x.is_finite());
        Argument::ALL.into_iter().all(is_finite)
    }

    /// Returns an entry of an argument; NaN if the state has none, which reaches all that reads it.
    pub fn entry(&self, argument: Argument, index: usize) -> f64 {
        let entry = self.entries(argument).get(index);
        entry.copied().unwrap_or(f64::NAN)
    }

    pub fn entries_mut(&mut self, argument: Argument) -> &mut Vec<f64> {
        match argument {
            Argument::Position => &mut self.q,
            Argument::Velocity => &mut self.qd,
            Argument::Acceleration => &mut self.qdd,
            Argument::Torque => &mut self.tau,
            Argument::ReferenceVelocity => &mut self.v,
            Argument::ReferenceAcceleration => &mut self.a,
            Argument::Wrench => &mut self.wrench,
            Argument::Damping => &mut self.damping,
            Argument::Multiplier => &mut self.multiplier,
            Argument::Gravity => &mut self.g,
            Argument::Load => &mut self.load,
            Argument::Bodies => &mut self.bodies,
            Argument::Armature => &mut self.armature,
            Argument::Viscous => &mut self.viscous,
            Argument::Payload => &mut self.payload,
        }
    }

    /// Returns the nearest state of finite f32 numbers, with zero in place of NaN.
    pub fn in_finite_single(&self) -> JointState {
        let most = f64::from(f32::MAX);
        self.each(|x| match x.is_nan() {
            true => 0.0,
            false => f64::from(x.clamp(-most, most) as f32),
        })
    }

    /// Returns the state with each of its entries changed, but for a load.
    pub(crate) fn each(&self, change: impl Fn(f64) -> f64) -> JointState {
        let mut state = self.clone();
        for argument in Argument::ALL {
            if argument != Argument::Load {
                let entries = state.entries_mut(argument).iter_mut();
                entries.for_each(|x| *x = change(*x));
            }
        }
        state
    }
}

/// Entries of each argument, in the order of [`Argument::ALL`]; unread ones may be missing.
pub type State<T> = [Vec<T>; Argument::COUNT];

/// The number of states of a measurement unless another is given.
pub const STATES: usize = 200;

pub const SEED: u64 = 0xa1e3;

/// Distinguishes the seed of the arguments that are no part of a state.
const OTHERS: u64 = 0x6172_6773;

/// States drawn evenly from the robot's limits; where it has none: ±π, or ±1 m, ±3 per second, ±10
/// per second squared, ±100 N·m or N. The same on every machine.
pub fn seeded(robot: &Robot, count: usize, seed: u64) -> Vec<JointState> {
    // Once, not state by state: a multiple of π is rounded from 120 digits.
    let of_joint = |joint: &Joint| Argument::JOINTS.map(|argument| Some(range(joint, argument)));
    let base = (0..robot.base_coordinates())
        .map(|coordinate| Argument::JOINTS.map(|argument| base_range(robot, argument, coordinate)));
    let ranges: Vec<_> = base.chain(robot.joints.iter().map(of_joint)).collect();
    let mut states = vec![JointState::default(); count];
    let (state, others) = Argument::JOINTS.split_at(Argument::STATE.len());
    // Other arguments have draws of their own: theirs do not move the states.
    for (arguments, seed) in [(state, seed), (others, seed ^ OTHERS)] {
        let mut random = Random::new(seed);
        let mut draw = |[low, high]: [f64; 2]| low + (high - low) * random.unit();
        for state in &mut states {
            for ranges in &ranges {
                for &argument in arguments {
                    if let Some(range) = ranges[argument.index()] {
                        state.entries_mut(argument).push(draw(range));
                    }
                }
            }
        }
    }
    for argument in [Argument::Wrench, Argument::Damping, Argument::Multiplier] {
        let mut random = Random::new(seed ^ OTHERS ^ argument.index() as u64);
        let (low, high) = (argument.least(), argument.reach());
        for state in &mut states {
            let length = argument.length(Sizes::of(robot));
            let entries = (0..length).map(|_| low + (high - low) * random.unit());
            *state.entries_mut(argument) = entries.collect();
        }
    }
    states
}

/// Returns between which ends each joint's position is drawn.
pub fn positions(robot: &Robot) -> Vec<[f64; 2]> {
    robot.joints.iter().map(position).collect()
}

fn range(joint: &Joint, argument: Argument) -> [f64; 2] {
    let most = match argument.limit() {
        None | Some(Limit::Position) => return position(joint),
        Some(rate) => joint.limits.rate(rate),
    };
    let most = most.map_or(argument.reach(), f64::nearest_rational);
    [-most, most]
}

fn base_range(robot: &Robot, argument: Argument, coordinate: usize) -> Option<[f64; 2]> {
    let limit = argument.limit().filter(|limit| *limit != Limit::Position)?;
    let known = robot.limit_of(coordinate, limit);
    let most = known.map_or(argument.reach(), f64::nearest_rational);
    Some([-most, most])
}

fn position(joint: &Joint) -> [f64; 2] {
    match (&joint.limits.position, joint.kind) {
        (Some(limits), _) => limits.each_ref().map(Position::to_f64),
        (None, JointKind::Revolute) => [-core::f64::consts::PI, core::f64::consts::PI],
        (None, JointKind::Prismatic) => [-1.0, 1.0],
    }
}
