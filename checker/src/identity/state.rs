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
        let mut state = self.clone();
        let moving = |own: &mut Number, by: Number| *own = own.moving(by, direction);
        moving(&mut state.given[argument][joint], 1.into());
        // Where something moves already, so do the slopes of what follows from it.
        let follow = |own: &mut Number, rate: Number| {
            moving(own, rate.slope(0));
            if direction == 2 {
                *own = own.moving(rate.slope(1), 3);
            }
        };
        if argument == 0 {
            let [sin, cos] = self.pairs[joint];
            follow(&mut state.pairs[joint][0], cos);
            follow(&mut state.pairs[joint][1], -sin);
        } else if argument == 1 {
            let (rate, own) = (self.given[1][joint], self.speeds[joint]);
            follow(&mut state.speeds[joint], -(rate * own * own * own));
        }
        state
    }
}
