//! One row of the table: from a frame on the axis of joint i to one on the axis of joint i + 1.

use super::frame::{length, unit};
use super::{along, is_nothing};
use crate::equations::SinCosPair;
use crate::equations::matrix::{
    Columns, Vector, cross, difference, dot, identity, opposite, scaled,
};
use crate::number::{Angle, Rational, Wide};
use crate::scalar::{Divide, Scalar};

/// Axes with a sine of the angle between them below this, and not parallel, are nearly parallel:
/// 0.9°. Where it is more, the common normal is at most 64 times as far away as the axes are apart.
pub const NEARLY_PARALLEL: f64 = 1.0 / 64.0;

/// Sines below 2⁻¹⁵⁰ are none: of axes that are parallel.
const PARALLEL: f64 = 7e-46;

/// A joint's axis in the frame of the link before it.
pub(super) struct JointAxis {
    pub(super) along: Vector<Wide>,
    /// The link's own frame at q = 0, whose origin is a point of it.
    pub(super) link: Columns<Wide>,
}

pub(super) struct Row {
    pub(super) theta: Angle,
    pub(super) d: Wide,
    pub(super) a: Wide,
    pub(super) alpha: Angle,
    pub(super) beta: Angle,
    pub(super) frame: Columns<Wide>,
}

/// Returns frame 0: on the first axis, next to the origin, its x beside the base's x, else its y.
pub(super) fn first_frame(first: &JointAxis) -> Columns<Wide> {
    let z = &first.along;
    let back = dot(&first.link.origin, z).neg();
    // Along x: within 26°.
    let near_x = z[0].magnitude() > 0.9;
    let start: Vector<Wide> = identity()[usize::from(near_x)];
    let across = along(&start, &dot(&start, z).neg(), z);
    let x = unit(&across).unwrap_or(start);
    frame(x, z, along(&first.link.origin, &back, z))
}

fn frame(x: Vector<Wide>, z: &Vector<Wide>, origin: Vector<Wide>) -> Columns<Wide> {
    let axes = [x, cross(z, &x), *z];
    Columns { axes, origin }
}

pub(super) fn to_axis(here: &Columns<Wide>, next: &JointAxis, size: &Rational) -> Row {
    let u = &here.axes[2];
    let beside = dot(&here.origin, u).neg();
    let normal = cross(u, &next.along);
    let sine = length(&normal).magnitude();
    if sine < PARALLEL {
        return parallel(here, next, beside, size);
    }
    let origin = along(&here.origin, &beside, u);
    let p = difference(&next.link.origin, &origin);
    let drop = dot(&p, u).over(&dot(&next.along, u));
    let passes = drop.map(|drop| along(&p, &drop.neg(), &next.along));
    match passes {
        Some(passes) if sine < NEARLY_PARALLEL && !is_nothing(&length(&passes), size) => {
            nearly_parallel(here, next, beside, &passes)
        }
        _ => askew(here, next, &normal),
    }
}

/// The row only turns and slides, to the link's own axes where these are quarter turns away.
pub(super) fn to_link(here: &Columns<Wide>) -> Row {
    let u = &here.axes[2];
    let d = dot(&opposite(&here.origin), u);
    let [ahead, _, up] = identity();
    let theta = turn(here, &ahead);
    let tilt = Angle::recovered(&length(&cross(u, &up)), &dot(u, &up));
    let is_parallel = tilt.quarter_turns().is_some_and(|n| n % 2 == 0);
    let (theta, x) = match is_parallel && theta.quarter_turns().is_some() {
        true => (theta, ahead),
        false => (Angle::default(), here.axes[0]),
    };
    Row {
        theta,
        a: Wide::zero(),
        alpha: Angle::default(),
        beta: Angle::default(),
        frame: frame(x, u, along(&here.origin, &d, u)),
        d,
    }
}

fn askew(here: &Columns<Wide>, next: &JointAxis, normal: &Vector<Wide>) -> Row {
    let (u, w) = (&here.axes[2], &next.along);
    let p = difference(&next.link.origin, &here.origin);
    let x = near(here, unit(normal).unwrap_or_else(|| here.axes[0]));
    // p = d u + a x − s w
    let square = dot(normal, normal);
    let d = dot(&cross(&p, w), normal).div(&square);
    let a = dot(&p, &x);
    let foot = along(&along(&here.origin, &d, u), &a, &x);
    Row {
        theta: turn(here, &x),
        alpha: Angle::recovered(&dot(&cross(u, w), &x), &dot(u, w)),
        beta: Angle::default(),
        frame: frame(x, w, foot),
        d,
        a,
    }
}

/// Chooses among many common normals the one beside the link's own origin.
fn parallel(here: &Columns<Wide>, next: &JointAxis, d: Wide, size: &Rational) -> Row {
    let u = &here.axes[2];
    let origin = along(&here.origin, &d, u);
    let p = difference(&next.link.origin, &origin);
    let across = along(&p, &dot(&p, u).neg(), u);
    let distance = length(&across);
    let apart = !is_nothing(&distance, size);
    let x = match unit(&across) {
        Some(x) if apart => near(here, x),
        _ => here.axes[0],
    };
    let a = if apart { dot(&p, &x) } else { Wide::zero() };
    let against = dot(u, &next.along).is_negative();
    let z = if against { opposite(u) } else { *u };
    Row {
        theta: turn(here, &x),
        d,
        alpha: Angle::right_angles(if against { 2 } else { 0 }),
        beta: Angle::default(),
        frame: frame(x, &z, along(&origin, &a, &x)),
        a,
    }
}

/// Keeps the frame beside the link's own origin where the common normal may be far away: it turns
/// about y too, z = Rx(α) Ry(β) z_0 = (sin β, −sin α cos β, cos α cos β) in the axes turned by θ.
fn nearly_parallel(here: &Columns<Wide>, next: &JointAxis, d: Wide, passes: &Vector<Wide>) -> Row {
    let (u, w) = (&here.axes[2], &next.along);
    let origin = along(&here.origin, &d, u);
    let x = near(here, unit(passes).unwrap_or_else(|| here.axes[0]));
    let y = cross(u, &x);
    let a = dot(passes, &x);
    let [wx, wy, wz] = [dot(w, &x), dot(w, &y), dot(w, u)];
    let level = length(&[Wide::zero(), wy, wz]);
    // x of the new frame is (cos β, sin α sin β, −cos α sin β); with cos β = level.
    let back = wx.div(&level);
    let tilt = along(&scaled(&wy, &y), &wz, u);
    let new_x = along(&scaled(&level, &x), &back.neg(), &tilt);
    Row {
        theta: turn(here, &x),
        d,
        alpha: Angle::recovered(&wy.neg(), &wz),
        beta: Angle::recovered(&wx, &level),
        frame: frame(new_x, w, along(&origin, &a, &x)),
        a,
    }
}

/// Returns the direction of a normal that is nearer to the frame's x; to its y where it is across.
fn near(here: &Columns<Wide>, x: Vector<Wide>) -> Vector<Wide> {
    let SinCosPair { sin, cos } = components(here, &x);
    let one = Rational::from_integer(1.into());
    let is_across = is_nothing(&cos, &one);
    let part = if is_across { sin } else { cos };
    if part.is_negative() { opposite(&x) } else { x }
}

fn turn(here: &Columns<Wide>, x: &Vector<Wide>) -> Angle {
    let SinCosPair { sin, cos } = components(here, x);
    Angle::recovered(&sin, &cos)
}

fn components(here: &Columns<Wide>, x: &Vector<Wide>) -> SinCosPair<Wide> {
    let [cos, sin] = [0, 1].map(|axis| dot(&here.axes[axis], x));
    SinCosPair { sin, cos }
}
