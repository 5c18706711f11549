//! Motions, wrenches, poses and bodies.
//!
//! A motion is (ω, v): the angular velocity, and the velocity of the point at the base's origin. A
//! wrench is (n, f): the moment about that origin, and the force. So motions, wrenches and masses
//! of all links add up without any frame between them.

use std::array::from_fn;
use std::ops::{Add, Mul, Neg};

use super::number::Number;

pub(super) trait Ring:
    Clone + From<i64> + Add<Output = Self> + Mul<Output = Self> + Neg<Output = Self>
{
}

impl Ring for Number {}

pub(super) type Vector = [Number; 3];

pub(super) fn sum<S: Ring>(a: [S; 3], b: [S; 3]) -> [S; 3] {
    from_fn(|i| a[i].clone() + b[i].clone())
}

pub(super) fn scaled<S: Ring>(x: S, a: [S; 3]) -> [S; 3] {
    a.map(|a| x.clone() * a)
}

pub(super) fn opposite<S: Ring>(a: [S; 3]) -> [S; 3] {
    a.map(|a| -a)
}

pub(super) fn dot<S: Ring>(a: [S; 3], b: [S; 3]) -> S {
    let [x, y, z]: [S; 3] = from_fn(|i| a[i].clone() * b[i].clone());
    x + y + z
}

pub(super) fn cross<S: Ring>(a: [S; 3], b: [S; 3]) -> [S; 3] {
    let [i, k] = [[1, 2, 0], [2, 0, 1]];
    let product = |a: &[S; 3], b: &[S; 3], axis: usize| a[i[axis]].clone() * b[k[axis]].clone();
    from_fn(|axis| product(&a, &b, axis) + -product(&b, &a, axis))
}

/// A motion (ω, v), or a wrench (n, f).
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Screw(pub(super) Vector, pub(super) Vector);

impl Screw {
    pub(super) fn plus(self, other: Screw) -> Screw {
        Screw(sum(self.0, other.0), sum(self.1, other.1))
    }

    pub(super) fn times(self, x: Number) -> Screw {
        Screw(scaled(x, self.0), scaled(x, self.1))
    }

    pub(super) fn power(self, wrench: Screw) -> Number {
        dot(self.0, wrench.0) + dot(self.1, wrench.1)
    }

    pub(super) fn across(self, other: Screw) -> Screw {
        let linear = sum(cross(self.0, other.1), cross(self.1, other.0));
        Screw(cross(self.0, other.0), linear)
    }

    pub(super) fn across_momentum(self, other: Screw) -> Screw {
        let moment = sum(cross(self.0, other.0), cross(self.1, other.1));
        Screw(moment, cross(self.0, other.1))
    }
}

/// A turn R, by its columns, and a shift p: r ↦ R r + p.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pose<S = Number> {
    pub(super) axes: [[S; 3]; 3],
    pub(super) origin: [S; 3],
}

impl<S: Ring> Pose<S> {
    pub(super) fn shift(origin: [S; 3]) -> Pose<S> {
        let axes = from_fn(|k| from_fn(|i| i64::from(i == k).into()));
        Pose { axes, origin }
    }

    /// Returns the turn about an axis of the frame, x being 0.
    pub(super) fn turn(axis: usize, [sin, cos]: [S; 2]) -> Pose<S> {
        let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
        let mut pose = Pose::shift([0i64; 3].map(S::from));
        (pose.axes[next][next], pose.axes[next][last]) = (cos.clone(), sin.clone());
        (pose.axes[last][next], pose.axes[last][last]) = (-sin, cos);
        pose
    }

    pub(super) fn rotate(&self, v: [S; 3]) -> [S; 3] {
        let [x, y, z] = &self.axes;
        from_fn(|i| dot([x, y, z].map(|axis| axis[i].clone()), v.clone()))
    }

    pub(super) fn apply(&self, point: [S; 3]) -> [S; 3] {
        sum(self.rotate(point), self.origin.clone())
    }

    pub(super) fn then(&self, next: &Pose<S>) -> Pose<S> {
        let axes = next.axes.clone().map(|axis| self.rotate(axis));
        let origin = self.apply(next.origin.clone());
        Pose { axes, origin }
    }

    /// Returns [R | p], row by row.
    pub(super) fn rows(&self) -> Vec<S> {
        let [x, y, z] = &self.axes;
        let row = |i: usize| [x, y, z, &self.origin].map(|column| column[i].clone());
        (0..3).flat_map(row).collect()
    }
}

impl Pose {
    pub(super) fn inverse(&self) -> Pose {
        let axes = from_fn(|k| from_fn(|i| self.axes[i][k]));
        let origin = opposite(self.back(self.origin));
        Pose { axes, origin }
    }

    /// Returns a vector in the axes of the pose.
    pub(super) fn back(&self, v: Vector) -> Vector {
        self.axes.map(|axis| dot(axis, v))
    }

    pub(super) fn screw(&self, screw: Screw) -> Screw {
        let turned = self.rotate(screw.0);
        let linear = sum(self.rotate(screw.1), cross(self.origin, turned));
        Screw(turned, linear)
    }

    pub(super) fn moved(axis: Screw, turns: bool, [sin, cos]: [Number; 2], slide: Number) -> Pose {
        if !turns {
            return Pose::shift(scaled(slide, axis.1));
        }
        // r ↦ c r + s ω × r + (1 − c) ω (ω·r), about the point ω × v of the axis.
        let about = |r: Vector| {
            let along = scaled((Number::from(1) - cos) * dot(axis.0, r), axis.0);
            sum(sum(scaled(cos, r), scaled(sin, cross(axis.0, r))), along)
        };
        let point = cross(axis.0, axis.1);
        let mut pose = Pose::shift(point);
        pose.axes = pose.axes.map(about);
        pose.origin = sum(point, opposite(pose.rotate(point)));
        pose
    }
}

/// Mass, first moment and the tensor of inertia about the origin.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Body<S = Number> {
    pub(super) mass: S,
    pub(super) first: [S; 3],
    pub(super) tensor: [[S; 3]; 3],
}

impl<S: Ring> Body<S> {
    pub(super) fn new([mass, x, y, z, xx, yy, zz, xy, yz, xz]: [S; 10]) -> Body<S> {
        let first_row = [xx, xy.clone(), xz.clone()];
        Body {
            mass,
            first: [x, y, z],
            tensor: [first_row, [xy, yy, yz.clone()], [xz, yz, zz]],
        }
    }

    pub(super) fn moved(&self, pose: &Pose<S>) -> Body<S> {
        let p = pose.origin.clone();
        let turned = pose.rotate(self.first.clone());
        // R I Rᵀ, then Steiner from the old origin to the new one.
        let half = self.tensor.clone().map(|row| pose.rotate(row));
        let heavy = scaled(self.mass.clone(), p.clone());
        let along = dot(p.clone(), turned.clone());
        let twice = along.clone() + along + dot(heavy.clone(), p.clone());
        let first = sum(turned.clone(), heavy.clone());
        let product = |a: &[S; 3], i: usize, b: &[S; 3], k: usize| a[i].clone() * b[k].clone();
        let entry = |i: usize, k: usize| {
            let column = [0, 1, 2].map(|j: usize| half[j][k].clone());
            let row = [0, 1, 2].map(|j: usize| pose.axes[j][i].clone());
            let across = product(&p, i, &turned, k) + product(&turned, i, &p, k);
            let inertia = dot(row, column) + -(across + product(&heavy, i, &p, k));
            match i == k {
                true => inertia + twice.clone(),
                false => inertia,
            }
        };
        Body {
            mass: self.mass.clone(),
            first,
            tensor: from_fn(|i| from_fn(|k| entry(i, k))),
        }
    }
}

impl Body {
    pub(super) fn plus(&self, other: &Body) -> Body {
        Body {
            mass: self.mass + other.mass,
            first: sum(self.first, other.first),
            tensor: from_fn(|i| sum(self.tensor[i], other.tensor[i])),
        }
    }

    pub(super) fn momentum(&self, motion: Screw) -> Screw {
        let spin = self.tensor.map(|row| dot(row, motion.0));
        let force = sum(scaled(self.mass, motion.1), cross(motion.0, self.first));
        Screw(sum(spin, cross(self.first, motion.1)), force)
    }
}
