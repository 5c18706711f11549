//! A state: what functions are given at a point of a field.

use super::exact::Point;
use super::number::Number;
use super::robot::{angle_of, number_of};
use super::setting::Setting;
use super::table::length;
use crate::program::{ARGUMENTS, Operand};

/// A state: the arguments, and sine and cosine of every joint.
#[derive(Clone, Debug)]
pub struct State {
    /// The entries of each argument, in the order of [`ARGUMENTS`].
    pub arguments: Vec<Vec<Number>>,
    /// Sine and cosine of each joint's angle.
    pub pairs: Vec<[Number; 2]>,
    /// 1/√(q̇² + w²) of each coordinate with Coulomb friction.
    pub speeds: Vec<Number>,
}

impl State {
    /// Draws a state of a robot in its scene at a point of a field.
    ///
    /// # Errors
    /// A position that the scene fixes is no number.
    pub fn draw(point: &Point, setting: &Setting) -> Result<State, String> {
        let (sizes, base) = (setting.sizes(), setting.base());
        let list = |axis: char| (0..length(axis, sizes)).map(|_| point.residue()).collect();
        let mut state = State {
            arguments: ARGUMENTS.iter().map(|argument| list(argument.1)).collect(),
            pairs: (0..sizes.joints).map(|_| point.pair()).collect(),
            speeds: vec![0.into(); sizes.coordinates],
        };
        let is_fixed = |operand: Operand<()>| setting.is_fixed(&operand);
        for joint in 0..sizes.joints {
            // Velocities of which 1/√(q̇² + w²) is a residue too: q̇ = (u − w²/u)/2, and the root
            // is (u + w²/u)/2.
            if let Some(width) = setting.width(joint)? {
                let (u, half, width) = (point.residue(), point.half(), point.number(&width));
                let rest = width * width / u;
                state.arguments[1][base + joint] = (u - rest) * half;
                let root = match is_fixed(Operand::Speed(base + joint)) {
                    true => width,
                    false => (u + rest) * half,
                };
                state.speeds[base + joint] = Number::from(1) / root;
            }
        }
        for (joint, lock) in setting.locks.iter().enumerate() {
            if lock.is_some() && setting.turns_by(joint) {
                state.pairs[joint] = point.angle(&angle_of(*lock)?);
            } else if lock.is_some() {
                state.arguments[0][joint] = point.number(&number_of(*lock)?);
            }
        }
        for (place, list) in state.arguments.iter_mut().enumerate().skip(1) {
            for (joint, entry) in list.iter_mut().enumerate() {
                if is_fixed(Operand::Entry(place, joint)) {
                    *entry = 0.into();
                }
            }
        }
        Ok(state)
    }

    /// Returns the state in which an entry of an argument has a slope of one in direction 1 or 2.
    pub fn moving(&self, argument: usize, index: usize, direction: usize) -> State {
        let (mut state, step) = (self.clone(), Number::step(direction));
        let entry = self.arguments[argument][index];
        state.arguments[argument][index] = entry + step;
        // f(x + ε) is f(x) + f′(x) ε, also where x moves already.
        if argument == 0 {
            let [sin, cos] = self.pairs[index];
            state.pairs[index] = [sin + cos * step, cos - sin * step];
        } else if argument == 1 {
            let speed = self.speeds[index];
            state.speeds[index] = speed - entry * speed * speed * speed * step;
        }
        state
    }
}
