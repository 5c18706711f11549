//! The box of states as polynomials: which variables stand for positions and rates.
//!
//! Where the axes of two joints that turn are parallel, the second one's variable is the
//! sum φ of its angle and of those before it (their difference, where the axes point
//! against each other): then a link's direction is one sine, not a product of many. That
//! is done only where the second joint goes all the way round: as q does so does φ, at
//! every angle of the joint before, so that the box of the φ is the box of the q.

use crate::certificate::Claim;
use crate::dynamics::{State, axis};
use crate::fault::Fault;
use crate::number::Number;
use crate::polynomial::{Key, MAX_JOINTS, Polynomial, Variable, Work, exponent};
use crate::scene::Setting;

/// A range of at least so much counts as all angles.
const WHOLE_TURN: f64 = std::f64::consts::TAU - 1e-9;

/// The variables over a box.
#[derive(Clone, Debug)]
pub struct Ring {
    /// The state of each joint.
    pub states: Vec<State<Polynomial>>,
    /// The range of each joint's angle φ; `None` where it goes all the way round, or
    /// stands for a position between two ends.
    pub angles: Vec<Option<[f64; 2]>>,
    /// The ranges of q̇ and of q̈ in their units.
    rates: [Vec<[f64; 2]>; 2],
}

/// Returns the least power of two that is not below a size, which is not zero.
fn unit(size: f64) -> f64 {
    // To the next exponent, unless nothing is behind the point.
    let behind = (1 << 52) - 1;
    f64::from_bits((size.to_bits() + behind) & !behind)
}

impl Ring {
    /// Returns the variables of a setting's joints over the ranges of a claim.
    ///
    /// # Errors
    /// Ranges that are none: not one a joint, not finite, or with ends in the wrong order.
    pub fn new(setting: &Setting, claim: &Claim, work: &mut Work) -> Result<Ring, Fault> {
        let count = setting.joints.len();
        let good = |range: &[f64; 2]| range[0] <= range[1] && range.iter().all(|x| x.abs() < 1e30);
        for list in [&claim.position, &claim.velocity, &claim.acceleration] {
            let why = format!("expected {count} finite ranges of q, qd, qdd");
            Fault::unless(list.len() == count && list.iter().all(good), &why)?;
        }
        let mut ring = Ring {
            states: Vec::new(),
            angles: Vec::new(),
            rates: [Vec::new(), Vec::new()],
        };
        for joint in 0..count {
            let mut rate = |which: usize, [low, high]: [f64; 2]| {
                let size = low.abs().max(high.abs());
                let moves = size > 0.0 && setting.locks[joint].is_none() && !setting.still[which];
                let unit = if moves { unit(size) } else { 0.0 };
                let range = [low / unit, high / unit];
                ring.rates[which].push(if moves { range } else { [0.0; 2] });
                let variable = [Variable::Velocity, Variable::Acceleration][which];
                Polynomial::variable(variable, joint, unit)
            };
            let velocity = rate(0, claim.velocity[joint]);
            let acceleration = rate(1, claim.acceleration[joint]);
            let state = State {
                velocity,
                acceleration,
                ..State::default()
            };
            let state = ring.positioned(state, setting, claim.position[joint], work)?;
            ring.states.push(state);
        }
        Ok(ring)
    }

    /// Returns sine, cosine and position of the next joint.
    fn positioned(
        &mut self,
        mut state: State<Polynomial>,
        setting: &Setting,
        range: [f64; 2],
        work: &mut Work,
    ) -> Result<State<Polynomial>, Fault> {
        let joint = self.states.len();
        let own =
            |joint| [Variable::Sin, Variable::Cos].map(|v| Polynomial::variable(v, joint, 1.0));
        let is_whole = range[1] - range[0] >= WHOLE_TURN;
        let turns = setting.joints[joint].turns && setting.locks[joint].is_none();
        self.angles.push(Some(range).filter(|_| turns && !is_whole));
        if let Some(at) = setting.locks[joint] {
            [state.sin, state.cos, state.position] = at.map(Number::constant);
        } else if !turns {
            // A position between two ends is their middle and a cosine's share of half
            // their distance, whatever the angle.
            let middle = 0.5 * range[0] + 0.5 * range[1];
            let half = (range[1] - middle).max(middle - range[0]).next_up();
            let share = Polynomial::variable(Variable::Cos, joint, half);
            state.position = Polynomial::constant(middle.into()).plus(&share);
        } else {
            [state.sin, state.cos] = own(joint);
            if let Some(sign) = Ring::parallel(setting, joint, work)?.filter(|_| is_whole) {
                // sin(φ ∓ ψ), cos(φ ∓ ψ), ψ being the variable of the joint before.
                let ([sin, cos], [sin_b, cos_b]) = (own(joint), own(joint - 1));
                let sin_b = sin_b.times(&Polynomial::constant(sign.into()), work)?;
                let across = cos.times(&sin_b, work)?.negated();
                state.sin = sin.times(&cos_b, work)?.plus(&across);
                state.cos = cos.times(&cos_b, work)?.plus(&sin.times(&sin_b, work)?);
            }
        }
        Ok(state)
    }

    /// Returns whether the axis of a joint that turns is parallel to that of the one before,
    /// which turns too and is not locked: 1, or −1 if it points the other way.
    fn parallel(setting: &Setting, joint: usize, work: &mut Work) -> Result<Option<f64>, Fault> {
        let moves = |k: usize| setting.joints[k].turns && setting.locks[k].is_none();
        if !joint.checked_sub(1).is_some_and(moves) {
            return Ok(None);
        }
        let [_, _, along]: [Polynomial; 3] = axis(setting, joint, work)?;
        let sign = |sign: f64| along == Polynomial::constant(sign.into());
        Ok([1.0, -1.0].into_iter().find(|one| sign(*one)))
    }

    /// Returns the values that the rates and errors of a monomial take over the box: the middle
    /// of their range, and half its length.
    pub fn factor(&self, key: Key) -> (f64, f64) {
        let (mut low, mut high) = (1.0f64, 1.0f64);
        for joint in 0..MAX_JOINTS {
            let rates = [Variable::Velocity, Variable::Acceleration];
            for (variable, ranges) in rates.into_iter().zip(&self.rates) {
                let [a, b] = ranges.get(joint).copied().unwrap_or_default();
                let power = exponent(key, variable, joint) as i32;
                let (x, y) = (a.powi(power), b.powi(power));
                let even_about_zero = power > 0 && power % 2 == 0 && a < 0.0 && b > 0.0;
                let least = if even_about_zero { 0.0 } else { x.min(y) };
                let most = x.max(y);
                let ends = [low * least, low * most, high * least, high * most];
                low = ends.iter().copied().fold(f64::INFINITY, f64::min);
                high = ends.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            }
            for error in [Variable::EvenError, Variable::OddError] {
                if exponent(key, error, joint) > 0 {
                    let most = low.abs().max(high.abs());
                    (low, high) = (-most, most);
                }
            }
        }
        (0.5 * low + 0.5 * high, 0.5 * high - 0.5 * low)
    }

    /// Returns at least the largest magnitude of a polynomial over the box.
    pub fn size(&self, polynomial: &Polynomial) -> f64 {
        let size = |&(key, c): &(Key, f64)| {
            let (middle, radius) = self.factor(key);
            c.abs() * (middle.abs() + radius)
        };
        let sum: f64 = polynomial.terms.iter().map(size).sum();
        (sum + polynomial.rest) * (1.0 + 1e-9)
    }
}
