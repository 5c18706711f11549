//! A state: what functions are given at a point of a field.

use super::exact::Point;
use super::number::Number;
use super::program::ARGUMENTS;
use super::setting::Setting;
use super::table::length;

/// A state: the arguments, and sine and cosine of every joint.
#[derive(Clone, Debug)]
pub struct State {
    /// The entries of each argument, in the order of [`ARGUMENTS`].
    pub given: Vec<Vec<Number>>,
    /// Sine and cosine of each joint's angle.
    pub pairs: Vec<[Number; 2]>,
    /// 1/√(q̇² + w²) of each joint with Coulomb friction.
    pub speeds: Vec<Number>,
}

impl State {
    /// Draws a state of a robot in its scene at a point of a field.
    ///
    /// # Errors
    /// A position that the scene fixes is no number.
    pub fn draw(point: &Point, setting: &Setting) -> Result<State, String> {
        let sizes = [setting.joints(), setting.links()];
        let list = |axis: char| (0..length(axis, sizes)).map(|_| point.residue()).collect();
        let mut state = State {
            given: ARGUMENTS.iter().map(|own| list(own.1)).collect(),
            pairs: (0..sizes[0]).map(|_| point.pair()).collect(),
            speeds: vec![0.into(); sizes[0]],
        };
        setting.fix(&mut state, point)?;
        Ok(state)
    }

    /// Returns the state in which an entry of an argument has a slope of one in direction 1 or 2.
    pub fn moving(&self, argument: usize, joint: usize, direction: usize) -> State {
        let (mut state, step) = (self.clone(), Number::step(direction));
        let own = self.given[argument][joint];
        state.given[argument][joint] = own + step;
        // f(x + ε) is f(x) + f′(x) ε, also where x moves already.
        if argument == 0 {
            let [sin, cos] = self.pairs[joint];
            state.pairs[joint] = [sin + cos * step, cos - sin * step];
        } else if argument == 1 {
            let speed = self.speeds[joint];
            state.speeds[joint] = speed - own * speed * speed * speed * step;
        }
        state
    }
}
