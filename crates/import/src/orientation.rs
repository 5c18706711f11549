//! Poses whose orientation is not written as roll, pitch and yaw.
//!
//! Each orientation is kept twice: as written (quaternions normalised), and as meant, by the rules
//! for angles.

use dalembert_model::equations::matrix::{Columns, Vector, cross, difference, dot, scaled};
use dalembert_model::number::{Angle, Rational, Wide};
use dalembert_model::placed::frame::{direction, length, placement, pose, turned, unit};
use dalembert_model::robot::Placement;
use dalembert_model::scalar::Scalar;
use num_traits::{One, Signed, Zero};

use crate::meant::{self, NOTHING, power};
use crate::merge::size_of;
use crate::model::{Number, Origin, Value};
use crate::text::Span;

/// Angles are computed to more digits than this, in radians.
const SAME: i32 = -15;

/// A pose as its digits stand, and as they were meant.
pub(crate) type Both = [Columns<Wide>; 2];

pub(crate) fn both_identities() -> Both {
    [Columns::identity(), Columns::identity()]
}

pub(crate) fn composed([exact, meant]: &Both, next: &Both) -> Both {
    [exact.then(&next[0]), meant.then(&next[1])]
}

#[derive(Clone, Debug)]
pub(crate) struct Pose {
    both: Both,
    /// The lengths that it comes from.
    size: Rational,
    /// The file's own numbers, where they are the position.
    xyz: Option<[Number; 3]>,
    at: Span,
}

fn moved_by(origin: Vector<Wide>) -> Columns<Wide> {
    Columns {
        origin,
        ..Columns::identity()
    }
}

fn wide(vector: &[Rational; 3]) -> Vector<Wide> {
    vector.each_ref().map(Wide::from_rational)
}

impl Pose {
    /// Returns the pose at a position with an orientation.
    pub(crate) fn of(xyz: [Number; 3], orientation: Both, at: &Span) -> Pose {
        let values = xyz.each_ref().map(|x| x.value.clone());
        let origin = wide(&values);
        Pose {
            both: orientation.map(|turned| Columns { origin, ..turned }),
            size: values.iter().map(Signed::abs).sum(),
            xyz: Some(xyz),
            at: at.clone(),
        }
    }

    pub(crate) fn identity(at: Span) -> Pose {
        Pose {
            both: both_identities(),
            size: Rational::zero(),
            xyz: None,
            at,
        }
    }

    pub(crate) fn then(&self, next: &Pose) -> Pose {
        Pose {
            both: composed(&self.both, &next.both),
            size: &self.size + &next.size,
            // After an identity the file's numbers stay.
            xyz: next.xyz.clone().filter(|_| self.is_identity()),
            at: next.at.clone(),
        }
    }

    /// Returns the pose with its origin moved along its own axes.
    pub(crate) fn shift(&self, by: &[Rational; 3]) -> Pose {
        if by.iter().all(Zero::is_zero) {
            return self.clone();
        }
        let size = by.iter().map(Signed::abs).sum::<Rational>();
        let shifted = moved_by(wide(by));
        Pose {
            both: self.both.each_ref().map(|pose| pose.then(&shifted)),
            size: &self.size + size,
            xyz: None,
            at: self.at.clone(),
        }
    }

    pub(crate) fn turn(&self, axis: &Vector<Wide>, by: &Angle) -> Pose {
        let turned = turned(axis, by);
        Pose {
            both: self.both.each_ref().map(|pose| pose.then(&turned)),
            ..self.clone()
        }
    }

    fn is_identity(&self) -> bool {
        self.size.is_zero() && placement(&self.both[0], &Rational::one()).is_identity()
    }

    /// Returns a direction in the axes of the frame that this one is in.
    pub(crate) fn rotate(&self, direction: &[Number; 3]) -> [Number; 3] {
        let wide = direction.each_ref().map(|x| Wide::from_rational(&x.value));
        let along = moved_by(self.both[1].rotate(&wide));
        let xyz = placement(&along, &Rational::one()).xyz;
        std::array::from_fn(|i| direction[i].clone().map(|_| xyz[i].clone()))
    }

    pub(crate) fn apply(&self, point: &[Rational; 3]) -> [Rational; 3] {
        let size = &self.size + point.iter().map(Signed::abs).sum::<Rational>();
        placement(&self.both[1].then(&moved_by(wide(point))), &size_of(size)).xyz
    }

    pub(crate) fn origin(&self) -> Origin {
        let size = size_of(self.size.clone());
        let [exact, meant] = self.both.each_ref().map(|pose| placement(pose, &size));
        let length = |x: &Rational| {
            let text = Angle::Radians(x.clone()).to_string();
            Value::new(x.clone(), text, &self.at)
        };
        let xyz = exact.xyz.each_ref().map(length);
        let angle = |angle: &Angle| Value::new(angle.clone(), short(angle), &self.at);
        let rpy = exact.rpy.each_ref().map(angle);
        let is_same = |(one, other): (&Angle, &Angle)| {
            let off = (one.radians() - other.radians()).abs();
            one == other || off < power(SAME)
        };
        let same = exact.rpy.iter().zip(&meant.rpy).all(is_same);
        Origin {
            xyz: self.xyz.clone().unwrap_or(xyz),
            rpy,
            meant: (!same).then_some(meant),
        }
    }
}

/// Returns nine digits of an angle that is not a simple multiple of π.
fn short(angle: &Angle) -> String {
    match angle {
        Angle::PiTimes(multiple) if multiple.denom().bits() <= 20 => angle.to_string(),
        _ => {
            let digits = Rational::from_integer(1_000_000_000.into());
            Angle::Radians((angle.radians() * &digits).round() / digits).to_string()
        }
    }
}

/// Returns the rotation of w, x, y, z, of any length.
pub(crate) fn of_quaternion(numbers: [Number; 4]) -> Option<Both> {
    let [w, x, y, z] = numbers.each_ref().map(|number| &number.value);
    let square: Rational = [w, x, y, z].into_iter().map(|a| a * a).sum();
    if square.is_zero() {
        return None;
    }
    let two = Rational::from_integer(2.into());
    let entry = |value: Rational| Wide::from_rational(&(value / &square));
    let diagonal = |a: &Rational, b: &Rational, c: &Rational| entry(w * w + a * a - b * b - c * c);
    let [xy, yz, xz] = [x * y, y * z, x * z];
    let [wx, wy, wz] = [w * x, w * y, w * z];
    let off = |a: Rational| entry(&two * a);
    let axes = [
        [diagonal(x, y, z), off(&xy + &wz), off(&xz - &wy)],
        [off(&xy - &wz), diagonal(y, x, z), off(&yz + &wx)],
        [off(&xz + &wy), off(&yz - &wx), diagonal(z, x, y)],
    ];
    Some(by_digits(axes, &numbers))
}

pub(crate) fn of_axes(numbers: [Number; 6]) -> Option<Both> {
    let [x, y] = [0, 3].map(|at| {
        let part = [at, at + 1, at + 2].map(|i| numbers[i].value.clone());
        direction(&part)
    });
    let (x, y) = (x?, y?);
    let across = difference(&y, &scaled(&dot(&x, &y), &x));
    // Parallel but for their digits is parallel.
    if length(&across).magnitude() < 1e-12 {
        return None;
    }
    let y = unit(&across)?;
    let z = cross(&x, &y);
    Some(by_digits([x, y, z], &numbers))
}

/// Returns the shortest rotation that turns z to a direction.
pub(crate) fn of_third_axis(axis: [Number; 3]) -> Option<Both> {
    let z = direction(&axis.each_ref().map(|x| x.value.clone()))?;
    let [x, y] = [&z[0], &z[1]];
    let level = length(&[*x, *y, Wide::zero()]);
    let angle = Angle::recovered(&level, &z[2]);
    let about = unit(&[y.neg(), *x, Wide::zero()]);
    // Upside down there are many shortest ones: about x.
    let about = about.unwrap_or([Wide::one(), Wide::zero(), Wide::zero()]);
    Some(by_digits(turned(&about, &angle).axes, &axis))
}

/// Pairs a rotation with its intended one. The tolerance is that of angles, because many
/// quaternions were computed from 1.5708.
fn by_digits(axes: [Vector<Wide>; 3], numbers: &[Number]) -> Both {
    let exact = Columns {
        axes,
        origin: [(); 3].map(|()| Wide::zero()),
    };
    let digits = numbers.iter().map(|number| meant::digits(&number.text).1);
    let count = digits.max().unwrap_or(0);
    let unit = match count >= meant::TELLING {
        true => power(meant::MAX),
        false => power(NOTHING),
    };
    let [x, y, _] = &exact.axes;
    let level = length(&[x[0], x[1], Wide::zero()]);
    let angles = match level.to_rational() <= unit {
        // Roll and yaw are about one axis.
        true => {
            let up = if x[2].is_negative() { 1 } else { -1 };
            let yaw = Angle::recovered(&y[0].neg(), &y[1]);
            [Angle::default(), Angle::right_angles(up), yaw]
        }
        false => placement(&exact, &Rational::one()).rpy,
    };
    let rpy = angles.map(|angle| match &angle {
        Angle::Radians(value) => meant::within(value, unit.clone(), count).unwrap_or(angle),
        _ => angle,
    });
    let meant = pose(&Placement {
        rpy,
        ..Placement::default()
    });
    [exact, meant]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 2.7e-17 beside a right angle, as a robot file has it, is 21 digits long.
    #[test]
    fn messages_show_a_simple_multiple_of_pi_or_nine_digits() {
        let multiple = |numer: i128, denom: i128| {
            short(&Angle::PiTimes(Rational::new(numer.into(), denom.into())))
        };
        assert_eq!(multiple(-3, 4), "-3*pi/4");
        let long = multiple(250_000_000_000_000_006_247, 500_000_000_000_000_000_000);
        assert_eq!(long, "1.570796327");
    }
}
