//! The box of states as polynomials: which variables stand for positions and rates.
//!
//! Where the axes of two joints that turn are parallel, the second one's variable is the
//! sum φ of its angle and of those before it (their difference, where the axes point
//! against each other): then a link's direction is one sine, not a product of many. That
//! is done only where the second joint goes all the way round: as q does so does φ, at
//! every angle of the joint before, so that the box of the φ is the box of the q.

use crate::dynamics::State;
use crate::fault::Fault;
use crate::number::{Angle, Number};
use crate::polynomial::{Key, MAX_JOINTS, Polynomial, Variable, Work, exponent};
use crate::scene::{Lock, Ranges, Setting};

/// A range of at least so much counts as all angles.
const WHOLE_TURN: f64 = 6.28;

/// The variables over a box.
#[derive(Clone, Debug)]
pub struct Ring {
    /// The state of each joint.
    pub states: Vec<State<Polynomial>>,
    /// The range of each joint's angle φ; `None` where it goes all the way round, or
    /// stands for a position between two ends.
    pub angles: Vec<Option<[f64; 2]>>,
    /// The ranges of q̇ and of q̈ in their units.
    pub rates: [Vec<[f64; 2]>; 2],
}

/// The least power of two that is not below a size, which is not zero.
fn unit(size: f64) -> f64 {
    let mut unit = 1.0;
    while unit < size {
        unit *= 2.0;
    }
    while 0.5 * unit >= size {
        unit *= 0.5;
    }
    unit
}

fn is_whole(range: [f64; 2]) -> bool {
    range[1] - range[0] >= WHOLE_TURN
}

impl Ring {
    /// The variables of a setting's joints over these ranges.
    ///
    /// # Errors
    /// Ranges that are none: not of one length, not finite, or with ends in the wrong
    /// order.
    pub fn new(setting: &Setting, ranges: &Ranges, work: &mut Work) -> Result<Ring, Fault> {
        let count = setting.robot.joints.len();
        let all = [&ranges.position, &ranges.velocity, &ranges.acceleration];
        let good = |range: &[f64; 2]| range[0] <= range[1] && range.iter().all(|x| x.abs() < 1e30);
        if all.iter().any(|list| list.len() != count || !list.iter().all(good)) {
            let why = format!("expected {count} finite ranges [lowest, highest] of each of q, qd, qdd");
            return Err(Fault::certificate(why));
        }
        let mut ring = Ring {
            states: Vec::new(),
            angles: vec![None; count],
            rates: [vec![[0.0; 2]; MAX_JOINTS], vec![[0.0; 2]; MAX_JOINTS]],
        };
        for joint in 0..count {
            let mut rate = |which: usize, list: &[[f64; 2]]| {
                let [low, high] = list[joint];
                let size = low.abs().max(high.abs());
                if size == 0.0 || setting.locks[joint].is_some() || setting.still[which] {
                    return Polynomial::default();
                }
                let unit = unit(size);
                ring.rates[which][joint] = [low / unit, high / unit];
                let variable = [Variable::Velocity, Variable::Acceleration][which];
                Polynomial::variable(variable, joint, unit)
            };
            let velocity = rate(0, &ranges.velocity);
            let acceleration = rate(1, &ranges.acceleration);
            let (sin, cos, position) = ring.position(setting, joint, ranges.position[joint], work)?;
            ring.states.push(State { sin, cos, position, velocity, acceleration });
        }
        Ok(ring)
    }

    /// Sine, cosine and position of a joint.
    fn position(
        &mut self,
        setting: &Setting,
        joint: usize,
        range: [f64; 2],
        work: &mut Work,
    ) -> Result<(Polynomial, Polynomial, Polynomial), Fault> {
        let zero = Polynomial::default;
        match setting.locks[joint] {
            Some(Lock::Angle(angle)) => {
                let (sin, cos) = angle.sin_cos();
                return Ok((Polynomial::constant(sin.value, sin.radius), Number::constant(cos), zero()));
            }
            Some(Lock::Length(length)) => return Ok((zero(), zero(), Number::constant(length))),
            None => {}
        }
        if !setting.robot.joints[joint].turns {
            // A position between two ends is their middle and a cosine's share of half
            // their distance, whatever the angle.
            let middle = 0.5 * range[0] + 0.5 * range[1];
            let half = (range[1] - middle).max(middle - range[0]).next_up();
            let share = Polynomial::variable(Variable::Cos, joint, half);
            return Ok((zero(), zero(), Polynomial::constant(middle, 0.0).plus(&share)));
        }
        let own = |joint| [Variable::Sin, Variable::Cos].map(|v| Polynomial::variable(v, joint, 1.0));
        let [sin, cos] = own(joint);
        if !is_whole(range) {
            self.angles[joint] = Some(range);
            return Ok((sin, cos, zero()));
        }
        match self.parallel(setting, joint) {
            None => Ok((sin, cos, zero())),
            Some(sign) => {
                // sin(φ ∓ ψ), cos(φ ∓ ψ), ψ being the variable of the joint before.
                let [sin_b, cos_b] = own(joint - 1);
                let sign = Polynomial::constant(sign, 0.0);
                let sin_b = sin_b.times(&sign, work)?;
                let across = cos.times(&sin_b, work)?.negated();
                let along = sin.times(&sin_b, work)?;
                let (sin, cos) = (sin.times(&cos_b, work)?, cos.times(&cos_b, work)?);
                Ok((sin.plus(&across), cos.plus(&along), zero()))
            }
        }
    }

    /// Whether the axis of a joint that turns is parallel to that of the one before,
    /// which turns too and is not locked: 1, or −1 if it points the other way.
    fn parallel(&self, setting: &Setting, joint: usize) -> Option<f64> {
        let before = joint.checked_sub(1)?;
        let joints = &setting.robot.joints;
        let twist: Angle = joints[if setting.robot.modified { joint } else { before }].alpha;
        let turns = joints[before].turns && setting.locks[before].is_none();
        match twist.quarters?.rem_euclid(4) {
            0 if turns => Some(1.0),
            2 if turns => Some(-1.0),
            _ => None,
        }
    }

    /// The values that the rates and errors of a monomial take over the box: the middle
    /// of their range, and half its length.
    pub fn factor(&self, key: Key) -> (f64, f64) {
        let (mut low, mut high) = (1.0f64, 1.0f64);
        for joint in 0..self.states.len() {
            let rates = [Variable::Velocity, Variable::Acceleration];
            for (variable, ranges) in rates.into_iter().zip(&self.rates) {
                let [a, b] = ranges[joint];
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

    /// At least the largest magnitude of a polynomial over the box.
    pub fn size(&self, polynomial: &Polynomial) -> f64 {
        let size = |&(key, c): &(Key, f64)| {
            let (middle, radius) = self.factor(key);
            c.abs() * (middle.abs() + radius)
        };
        let sum: f64 = polynomial.terms.iter().map(size).sum();
        (sum + polynomial.rest) * (1.0 + 1e-9)
    }
}
