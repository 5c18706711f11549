//! The box of states as polynomials: which variables stand for positions, rates and loads.
//!
//! Where the axes of two joints that turn are parallel, the second one's variable is the
//! sum φ of its angle and of the one before (their difference, where the axes point
//! against each other): then a link's direction is one sine, not a product of many. That
//! is done only where the second joint goes all the way round: as q does so does φ, at
//! every angle of the joint before, so that the box of the φ is the box of the q.

use crate::fault::Fault;
use crate::identity::arm::Arm;
use crate::identity::exact::Point;
use crate::identity::setting::Setting;
use crate::interval::sin_cos;
use crate::polynomial::{MAX_JOINTS, MAX_LOADS, Polynomial, Powers, Variable, exponent};
use crate::program::{ARGUMENTS, GRAVITY, Operand, argument};
use crate::rounding::Ranges;
use crate::work::Work;

/// A range of at least so much counts as all angles.
const WHOLE_TURN: f64 = std::f64::consts::TAU - 1e-9;
/// The arguments that results are polynomials in.
const LINEAR: [(Variable, &str); 3] = [
    (Variable::Velocity, "qd"),
    (Variable::Acceleration, "qdd"),
    (Variable::Load, "load"),
];

#[derive(Default)]
pub struct Ring {
    /// Sine, cosine and position of each joint, or what there is of them.
    positions: Vec<[Option<Polynomial>; 3]>,
    /// q̇, q̈ and the load.
    linear: [Vec<Polynomial>; 3],
    gravity: Vec<Polynomial>,
    /// The ranges of the positions, and the sign with which the angle before is taken off.
    places: Vec<([f64; 2], f64)>,
    /// The range of each joint's angle φ; `None` where it goes all the way round, or
    /// stands for a position between two ends. Behind them are two by which gravity turns.
    pub angles: Vec<Option<[f64; 2]>>,
    /// The ranges of these in their units.
    units: [Vec<[f64; 2]>; 3],
}

/// Returns the least power of two that is not below a size, which is not zero.
fn unit(size: f64) -> f64 {
    // To the next exponent, unless nothing is behind the point.
    let behind = (1 << 52) - 1;
    f64::from_bits((size.to_bits() + behind) & !behind)
}

/// The middle and a cosine's share of half the distance, whatever the angle.
fn between([low, high]: [f64; 2], joint: usize) -> Polynomial {
    let middle = 0.5 * low + 0.5 * high;
    let half = (high - middle).max(middle - low).next_up();
    let share = Polynomial::variable(Variable::Cos, joint, half);
    Polynomial::constant(middle, 0.0).plus(&share)
}

/// Returns sine and cosine of a joint: sin(φ ∓ ψ) and cos(φ ∓ ψ), ψ being the variable of the
/// joint before, if the sign of that is given.
fn pair(joint: usize, sign: Option<f64>, work: &Work) -> Result<[Polynomial; 2], Fault> {
    let variables =
        |joint| [Variable::Sin, Variable::Cos].map(|v| Polynomial::variable(v, joint, 1.0));
    let [sin, cos] = variables(joint);
    let Some(sign) = sign else {
        return Ok([sin, cos]);
    };
    let [sin_b, cos_b] = variables(joint - 1);
    let sin_b = if sign < 0.0 { sin_b.negated() } else { sin_b };
    let across = cos.times(&sin_b, work)?.negated();
    let along = sin.times(&sin_b, work)?;
    let sine = sin.times(&cos_b, work)?.plus(&across);
    Ok([sine, cos.times(&cos_b, work)?.plus(&along)])
}

impl Ring {
    pub fn new(setting: &Setting, ranges: &Ranges, work: &Work) -> Result<Ring, Fault> {
        let of_robot = |why| Fault::Robot("joint".into(), why);
        let count = setting.joints();
        if setting.sizes().coordinates > MAX_JOINTS {
            let most = MAX_JOINTS - setting.base();
            let end = match setting.base() {
                0 => "",
                _ => " where the base floats",
            };
            let why = format!("under a tolerance at most {most} joints are checked{end}");
            return Err(of_robot(why));
        }
        let arm = Arm::read(setting, &Point::new(&["axes"])).map_err(of_robot)?;
        let mut ring = Ring::default();
        let moves = |joint: usize| setting.turns_by(joint) && !setting.is_locked(joint);
        for (joint, &position) in ranges[0].iter().enumerate() {
            let is_whole = position[1] - position[0] >= WHOLE_TURN;
            let angle = Some(position).filter(|_| moves(joint) && !is_whole);
            ring.angles.push(angle);
            let mut sign = None;
            ring.positions.push(if setting.is_locked(joint) {
                // A program of the scene has a number in its place.
                [None, None, None]
            } else if !setting.turns_by(joint) {
                [None, None, Some(between(position, joint))]
            } else {
                let before = joint.checked_sub(1).filter(|k| is_whole && moves(*k));
                sign = before.and_then(|before| arm.parallel([before, joint]));
                let [sin, cos] = pair(joint, sign, work)?;
                [Some(sin), Some(cos), None]
            });
            ring.places.push((position, sign.unwrap_or(0.0)));
        }
        if let Some(length) = setting.gravity() {
            // ρ |g| (sin α, -cos α sin β, -cos α cos β), ρ from 0 to 1, are all directions and lengths. No
            // payload is an argument where the base floats: ρ stands in the place of a load.
            ring.angles.extend([None; 2]);
            ring.units[2].push([0.0, 1.0]);
            let length = Polynomial::variable(Variable::Load, 0, length);
            let [sin, cos] = pair(count, None, work)?;
            ring.gravity.push(sin.times(&length, work)?);
            for other in pair(count + 1, None, work)? {
                let share = other.times(&length.negated(), work)?;
                ring.gravity.push(cos.times(&share, work)?);
            }
        }
        let place =
            |entry: &(Variable, &str)| argument(entry.1).and_then(|place| ranges.get(place));
        let lists = LINEAR.each_ref().map(place);
        if lists[2].is_some_and(|load| load.len() > MAX_LOADS) {
            let why = format!("a load of more than {MAX_LOADS} numbers");
            return Err(of_robot(why));
        }
        if !ring.gravity.is_empty() && lists[2].is_some_and(|load| !load.is_empty()) {
            return Err(of_robot("a load, and a base that floats".into()));
        }
        for (which, (list, (variable, _))) in lists.iter().zip(LINEAR).enumerate() {
            for (index, &[low, high]) in list.iter().copied().flatten().enumerate() {
                let size = low.abs().max(high.abs());
                let unit = if size > 0.0 { unit(size) } else { 0.0 };
                let range = [low / unit, high / unit];
                ring.units[which].push(if size > 0.0 { range } else { [0.0; 2] });
                ring.linear[which].push(Polynomial::variable(variable, index, unit));
            }
        }
        Ok(ring)
    }

    /// Returns the positions at the variables' angles, rad and m: where the angle before is taken off,
    /// as it is there.
    pub fn positions(&self, angles: &[f64]) -> Vec<f64> {
        let places = self.places.iter().zip(&self.positions);
        let (mut positions, mut before) = (Vec::new(), 0.0);
        for ((([low, high], sign), position), angle) in places.zip(angles) {
            positions.push(match position {
                [.., Some(_)] => {
                    0.5 * low + 0.5 * high + (0.5 * high - 0.5 * low) * sin_cos(*angle).1
                }
                [None, ..] => *low,
                _ => angle - sign * before,
            });
            before = *angle;
        }
        positions
    }

    /// Returns gravity of full length at the variables' angles, m/s²; nothing on a fixed base.
    pub fn gravity(&self, angles: &[f64]) -> Vec<f64> {
        let value = |entry: &Polynomial| {
            let term = |(key, value): &(Powers, f64)| {
                let factors = angles.iter().enumerate().map(|(joint, angle)| {
                    let (sin, cos) = sin_cos(*angle);
                    let [s, c] =
                        [Variable::Sin, Variable::Cos].map(|kind| exponent(*key, kind, joint));
                    sin.powi(s as i32) * cos.powi(c as i32)
                });
                value * factors.product::<f64>()
            };
            entry.terms.iter().map(term).sum()
        };
        self.gravity.iter().map(value).collect()
    }

    /// Returns how many joints and coordinates variables are of.
    pub fn width(&self) -> usize {
        let [rates, accelerations, _] = self.units.each_ref().map(Vec::len);
        self.angles.len().max(rates).max(accelerations)
    }

    /// None for other operands, and for a joint that is locked.
    pub fn leaf<C>(&self, operand: &Operand<C>) -> Option<Polynomial> {
        match operand {
            Operand::Sine(joint, is_sine) => {
                self.positions.get(*joint)?[usize::from(!is_sine)].clone()
            }
            Operand::Entry(0, joint) => self.positions.get(*joint)?[2].clone(),
            Operand::Entry(place, index) => {
                let name = ARGUMENTS.get(*place)?.0;
                if name == GRAVITY {
                    return self.gravity.get(*index).cloned();
                }
                let which = LINEAR.iter().position(|entry| entry.1 == name)?;
                self.linear[which].get(*index).cloned()
            }
            _ => None,
        }
    }

    /// The middle of the range over the box, and half its length.
    pub fn factor(&self, key: Powers) -> (f64, f64) {
        let (mut low, mut high) = (1.0f64, 1.0f64);
        for ((variable, _), ranges) in LINEAR.iter().zip(&self.units) {
            for (index, &[a, b]) in ranges.iter().enumerate() {
                let power = exponent(key, *variable, index) as i32;
                if power == 0 {
                    continue;
                }
                let (x, y) = (a.powi(power), b.powi(power));
                let even_about_zero = power % 2 == 0 && a < 0.0 && b > 0.0;
                let least = if even_about_zero { 0.0 } else { x.min(y) };
                let most = x.max(y);
                let ends = [low * least, low * most, high * least, high * most];
                low = ends.iter().copied().fold(f64::INFINITY, f64::min);
                high = ends.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            }
        }
        let errors = [Variable::EvenError, Variable::OddError];
        let has = |joint: usize| errors.iter().any(|error| exponent(key, *error, joint) > 0);
        if (0..self.width()).any(has) {
            let most = low.abs().max(high.abs());
            (low, high) = (-most, most);
        }
        (0.5 * low + 0.5 * high, 0.5 * high - 0.5 * low)
    }

    pub fn size(&self, polynomial: &Polynomial) -> f64 {
        let size = |&(key, c): &(Powers, f64)| {
            let (middle, radius) = self.factor(key);
            c.abs() * (middle.abs() + radius)
        };
        let sum: f64 = polynomial.terms.iter().map(size).sum();
        (sum + polynomial.rest) * (1.0 + 1e-9)
    }
}
