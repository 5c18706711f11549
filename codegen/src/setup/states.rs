//! Seeded states of a robot in its scene: those of its robot, and the parameters that are
//! arguments.

use dalembert_model::number::{Exact, Rational, Rounded};
use dalembert_model::outputs::RuntimeParameter;
use dalembert_model::scalar::Scalar;

use super::Setup;
use crate::function::Argument;
use crate::program::Input;
use crate::random::Random;
use crate::states::{JointState, seeded};

/// Distinguishes the seed of the parameters from that of the states, which they must not move.
const PARAMETERS: u64 = 0x7061_7261;

impl Setup {
    /// States inside the limits of the scene's robot, the same on every machine; with gravity in
    /// any direction, and other bodies and drives, where these are arguments.
    pub fn states(&self, count: usize, seed: u64) -> Vec<JointState> {
        let mut states = seeded(self.robot(), count, seed);
        let mut random = Random::new(seed ^ PARAMETERS);
        // Numbers that both scalars hold, so that both are of one payload.
        let mut draw = |most: f64| f64::from((most * (2.0 * random.unit() - 1.0)) as f32);
        let (mass, length) = (self.heaviest(), self.longest());
        for state in &mut states {
            if self.has(RuntimeParameter::Gravity) {
                state.g = (0..3).map(|_| draw(Argument::Gravity.reach())).collect();
            }
            if self.has(RuntimeParameter::Payload) {
                state.payload = body(&mut draw, mass, length);
            }
            let bodies = 0..self.body_links().len();
            state.bodies = bodies.flat_map(|_| body(&mut draw, mass, length)).collect();
            for (argument, _) in self.drives() {
                // As a large drive has it: no more than the links.
                let most = match argument {
                    Argument::Armature => mass * length * length / 16.0,
                    _ => 2.0,
                };
                state.entries_mut(argument).push(draw(most).abs());
            }
            if self.has_load() {
                state.load = self.load_at(state);
            }
        }
        states
    }

    pub(crate) fn input_at(&self, input: Input, state: &JointState) -> f64 {
        match input {
            Input::Sin(joint) => libm::sin(state.q[joint]),
            Input::Cos(joint) => libm::cos(state.q[joint]),
            Input::PerSpeed(coordinate) => {
                let qd = state.entry(Argument::Velocity, coordinate);
                self.per_speed(coordinate, &qd, f64::nearest, |x| libm::sqrt(*x))
            }
            Input::Entry(argument, index) => state.entry(argument, index),
        }
    }

    /// Returns the load of a state's bodies and drives, each number rounded once.
    pub fn load_at(&self, state: &JointState) -> Vec<f64> {
        let entry = |input| {
            let number = match input {
                Input::Entry(argument, index) => Rational::from_float(state.entry(argument, index)),
                Input::Sin(_) | Input::Cos(_) | Input::PerSpeed(_) => None,
            };
            number.map_or_else(Exact::zero, Exact::from)
        };
        let load = self.loading(entry, Exact::clone).load();
        load.iter().map(f64::nearest).collect()
    }

    fn heaviest(&self) -> f64 {
        let bodies = self.robot().bodies();
        let masses = bodies.map(|body| f64::nearest_rational(&body.mass));
        positive(masses.fold(0.0, f64::max))
    }

    fn longest(&self) -> f64 {
        let joints = self.robot().joints.iter();
        let lengths = joints.flat_map(|joint| [&joint.a, &joint.d]);
        let sizes = lengths.map(|x| f64::nearest_rational(x).abs());
        positive(sizes.fold(0.0, f64::max))
    }
}

fn positive(x: f64) -> f64 {
    if x > 0.0 { x } else { 1.0 }
}

/// Moments of which the least is at least half the largest, and products of inertia of a tenth of
/// that, are those of a body.
fn body(draw: &mut impl FnMut(f64) -> f64, mass: f64, length: f64) -> Vec<f64> {
    let mass = draw(mass).abs();
    let centre = [(); 3].map(|()| draw(length / 4.0));
    let size = mass * length * length / 64.0;
    let moments = [(); 3].map(|()| f64::from((size * 0.75 + draw(size / 4.0)) as f32));
    let products = [(); 3].map(|()| draw(size / 20.0));
    [&[mass][..], &centre, &moments, &products].concat()
}
