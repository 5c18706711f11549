//! Motions, wrenches, poses and bodies.
//!
//! A motion is (ω, v): the angular velocity, and the velocity of the point at the base's origin. A
//! wrench is (n, f): the moment about that origin, and the force. So motions, wrenches and masses
//! of all links add up without any frame between them.

use std::array::from_fn;

use super::number::Number;

pub(super) type Vector = [Number; 3];

pub(super) fn sum(a: Vector, b: Vector) -> Vector {
    from_fn(|i| a[i] + b[i])
}

pub(super) fn scaled(x: Number, a: Vector) -> Vector {
    a.map(|a| x * a)
}

pub(super) fn opposite(a: Vector) -> Vector {
    a.map(|a| -a)
}

pub(super) fn dot(a: Vector, b: Vector) -> Number {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(super) fn cross(a: Vector, b: Vector) -> Vector {
    let [i, k] = [[1, 2, 0], [2, 0, 1]];
    from_fn(|axis| a[i[axis]] * b[k[axis]] - a[k[axis]] * b[i[axis]])
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

    /// Returns the power of a wrench in this motion.
    pub(super) fn power(self, wrench: Screw) -> Number {
        dot(self.0, wrench.0) + dot(self.1, wrench.1)
    }

    /// Returns the rate of a motion that this one carries along.
    pub(super) fn across(self, other: Screw) -> Screw {
        let linear = sum(cross(self.0, other.1), cross(self.1, other.0));
        Screw(cross(self.0, other.0), linear)
    }

    /// Returns the rate of a momentum that this motion carries along.
    pub(super) fn across_momentum(self, other: Screw) -> Screw {
        let moment = sum(cross(self.0, other.0), cross(self.1, other.1));
        Screw(moment, cross(self.0, other.1))
    }
}

/// A turn R, by its columns, and a shift p: r ↦ R r + p.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pose {
    pub(super) axes: [Vector; 3],
    pub(super) origin: Vector,
}

impl Pose {
    pub(super) fn shift(origin: Vector) -> Pose {
        let axes = from_fn(|k| from_fn(|i| i64::from(i == k).into()));
        Pose { axes, origin }
    }

    /// Returns the turn about an axis of the frame, x being 0.
    pub(super) fn turn(axis: usize, [sin, cos]: [Number; 2]) -> Pose {
        let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
        let mut pose = Pose::shift(Vector::default());
        (pose.axes[next][next], pose.axes[next][last]) = (cos, sin);
        (pose.axes[last][next], pose.axes[last][last]) = (-sin, cos);
        pose
    }

    pub(super) fn rotate(&self, v: Vector) -> Vector {
        from_fn(|i| self.axes[0][i] * v[0] + self.axes[1][i] * v[1] + self.axes[2][i] * v[2])
    }

    pub(super) fn inverse(&self) -> Pose {
        let axes = from_fn(|k| from_fn(|i| self.axes[i][k]));
        let origin = opposite(self.back(self.origin));
        Pose { axes, origin }
    }

    /// Returns a vector in the axes of the pose.
    pub(super) fn back(&self, v: Vector) -> Vector {
        self.axes.map(|axis| dot(axis, v))
    }

    pub(super) fn apply(&self, point: Vector) -> Vector {
        sum(self.rotate(point), self.origin)
    }

    pub(super) fn then(&self, next: &Pose) -> Pose {
        let axes = next.axes.map(|axis| self.rotate(axis));
        let origin = self.apply(next.origin);
        Pose { axes, origin }
    }

    pub(super) fn screw(&self, own: Screw) -> Screw {
        let turned = self.rotate(own.0);
        Screw(turned, sum(self.rotate(own.1), cross(self.origin, turned)))
    }

    /// Returns [R | p], row by row.
    pub(super) fn rows(&self) -> Vec<Number> {
        let [x, y, z] = self.axes;
        let row = |i: usize| [x[i], y[i], z[i], self.origin[i]];
        (0..3).flat_map(row).collect()
    }

    /// Returns the motion of a joint, by a sine and a cosine or by a length.
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
pub(super) struct Body {
    pub(super) mass: Number,
    pub(super) first: Vector,
    pub(super) tensor: [Vector; 3],
}

impl Body {
    /// Returns a body of m, m x, m y, m z, xx, yy, zz, xy, yz and xz.
    pub(super) fn new([mass, x, y, z, xx, yy, zz, xy, yz, xz]: [Number; 10]) -> Body {
        Body {
            mass,
            first: [x, y, z],
            tensor: [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]],
        }
    }

    pub(super) fn plus(&self, other: &Body) -> Body {
        Body {
            mass: self.mass + other.mass,
            first: sum(self.first, other.first),
            tensor: from_fn(|i| sum(self.tensor[i], other.tensor[i])),
        }
    }

    /// Returns the body moved by a pose.
    pub(super) fn moved(&self, pose: &Pose) -> Body {
        let (p, turned) = (pose.origin, pose.rotate(self.first));
        // R I Rᵀ, then Steiner from the old origin to the new one.
        let half = self.tensor.map(|row| pose.rotate(row));
        let twice = dot(p, turned) + dot(p, turned) + self.mass * dot(p, p);
        let entry = |i: usize, k: usize| {
            let column = [0, 1, 2].map(|j: usize| half[j][k]);
            let row = [0, 1, 2].map(|j: usize| pose.axes[j][i]);
            let across = p[i] * turned[k] + turned[i] * p[k] + self.mass * p[i] * p[k];
            dot(row, column) - across + if i == k { twice } else { 0.into() }
        };
        Body {
            mass: self.mass,
            first: sum(turned, scaled(self.mass, p)),
            tensor: from_fn(|i| from_fn(|k| entry(i, k))),
        }
    }

    /// Returns the momentum of a motion.
    pub(super) fn momentum(&self, motion: Screw) -> Screw {
        let spin = self.tensor.map(|row| dot(row, motion.0));
        let force = sum(scaled(self.mass, motion.1), cross(motion.0, self.first));
        Screw(sum(spin, cross(self.first, motion.1)), force)
    }
}
