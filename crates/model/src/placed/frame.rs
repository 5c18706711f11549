//! Poses in wide floats.

use num_traits::{One, Signed, Zero};

use crate::equations::matrix::{
    Columns, Vector, cross, dot, identity, opposite, scaled, three, transposed, zero_vector,
};
use crate::equations::{SinCosPair, pose_of};
use crate::number::recover::{recovered, short};
use crate::number::{Angle, Rational, Wide};
use crate::robot::{Inertia, Placement};
use crate::scalar::Scalar;

/// A body, in a frame.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Body {
    /// Mass, kg.
    pub mass: Rational,
    /// Centre of mass, m.
    pub com: [Rational; 3],
    /// Inertia about it in the frame's axes, kg·m².
    pub inertia: Inertia<Rational>,
}

/// Returns [R | p] of a placement.
pub fn pose(placement: &Placement) -> Columns<Wide> {
    pose_of(placement, Wide::sincos, Wide::from_rational)
}

/// Inverts it: rows for columns, and the origin seen from itself.
pub fn inverse(pose: &Columns<Wide>) -> Columns<Wide> {
    let axes = transposed(&pose.axes);
    let origin = opposite(&pose.rotate_back(&pose.origin));
    Columns { axes, origin }
}

/// Returns the placement that a pose is, lengths beside those of this size.
pub fn placement(pose: &Columns<Wide>, size: &Rational) -> Placement {
    let [x, y, z] = &pose.axes;
    // R = Rz(yaw) Ry(pitch) Rx(roll): x is (cos pitch cos yaw, cos pitch sin yaw, −sin pitch).
    let level = length(&[x[0], x[1], Wide::zero()]);
    let pitch = Angle::recovered(&x[2].neg(), &level);
    let (roll, yaw) = match pitch.quarter_turns() {
        // The nose up or down: roll and yaw are about one axis.
        Some(1 | 3) => (Angle::default(), Angle::recovered(&y[0].neg(), &y[1])),
        _ => (
            Angle::recovered(&y[2], &z[2]),
            Angle::recovered(&x[1], &x[0]),
        ),
    };
    let xyz = pose.origin.each_ref().map(|x| recovered(x, size));
    let rpy = [roll, pitch, yaw];
    Placement { xyz, rpy }
}

/// Returns a body given in a frame, seen from one in which that frame has this pose, which was
/// computed from lengths of this size: beside them what is left of a difference may be nothing.
pub fn moved(body: &Body, pose: &Columns<Wide>, size: &Rational) -> Body {
    let com = body.com.each_ref().map(Wide::from_rational);
    let com = pose.apply(&com, &Wide::one());
    let size = size + body.com.iter().map(Signed::abs).sum::<Rational>();

    let turned = pose.turn_tensor(&body.inertia.map(Wide::from_rational));
    let entries = body.inertia.rows();
    let moments: Rational = entries.iter().flatten().map(Signed::abs).sum();
    Body {
        mass: body.mass.clone(),
        com: com.each_ref().map(|x| recovered(x, &size)),
        inertia: turned.map(|x| recovered(x, &moments)),
    }
}

/// Returns the turn by an angle about a unit vector: v → c v + s u × v + (1 − c) u (u·v).
pub fn turned(about: &Vector<Wide>, angle: &Angle) -> Columns<Wide> {
    let SinCosPair { sin, cos } = Wide::sincos(angle);
    let rest = Wide::one().sub(&cos);
    let units = identity();
    let axes = three(|k| {
        let across = cross(about, &units[k]);
        let along = rest.mul(&about[k]);
        three(|i| {
            let turned = cos.mul(&units[k][i]).add(&sin.mul(&across[i]));
            turned.add(&along.mul(&about[i]))
        })
    });
    let origin = zero_vector();
    Columns { axes, origin }
}

/// Returns the unit vector along a direction, unless that is zero.
pub fn direction(axis: &[Rational; 3]) -> Option<Vector<Wide>> {
    // The axis is scaled to ordinary size first: 1e-300 is a direction too.
    let largest = axis.iter().map(Signed::abs).max()?;
    if largest.is_zero() {
        return None;
    }
    let relative = |x: &Rational| Wide::from_rational(&(x / &largest));
    unit(&axis.each_ref().map(relative))
}

/// Returns fractions along a direction whose squares add up to one, exactly: those of the direction
/// where its length is a fraction, else those of a point of the sphere beside it, within 3e-18.
pub fn unit_fraction(axis: &[Rational; 3]) -> Option<[Rational; 3]> {
    let square: Rational = axis.iter().map(|x| x * x).sum();
    let [numer, denom] = [square.numer().sqrt(), square.denom().sqrt()];
    let length = Rational::new(numer, denom);
    if square.is_zero() {
        return None;
    }
    if &length * &length == square {
        return Some(axis.each_ref().map(|x| x / &length));
    }
    // A point of the sphere from the pole that is further away, (u, v) → (2u, 2v, 1 − u² − v²) /
    // (1 + u² + v²), of the circle where a component is zero and stays so: v is zero then.
    let direction = direction(axis)?.map(|x| x.to_rational());
    let order = match axis.each_ref().map(Zero::is_zero) {
        [true, _, _] => [1, 0, 2],
        [_, _, true] => [0, 2, 1],
        _ => [0, 1, 2],
    };
    let pole = &direction[order[2]];
    let height = Rational::one() + pole.abs();
    let [u, v] = [order[0], order[1]].map(|i| match axis[i].is_zero() {
        true => Rational::zero(),
        // A checker compares with the axis of the file to 1e-16.
        false => short(&(&direction[i] / &height), 60),
    });
    let flat = &u * &u + &v * &v;
    let per = (Rational::one() + &flat).recip();
    let up = (Rational::one() - flat) * &per;
    let mut point = core::array::from_fn(|_| Rational::zero());
    point[order[0]] = Rational::from_integer(2.into()) * u * &per;
    point[order[1]] = Rational::from_integer(2.into()) * v * &per;
    point[order[2]] = if pole.is_negative() { -up } else { up };
    Some(point)
}

/// Returns a vector divided by its length, unless that is zero.
pub fn unit(vector: &Vector<Wide>) -> Option<Vector<Wide>> {
    let per_length = Wide::one().over(&length(vector))?;
    Some(scaled(&per_length, vector))
}

/// |v|
pub fn length(vector: &Vector<Wide>) -> Wide {
    dot(vector, vector).sqrt()
}
