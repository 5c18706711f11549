// The pose of a base that floats. Velocities and steps are six numbers, linear over angular.

use core::ops::{Add, Div, Mul, Neg, Sub};

/// A number that poses are made of: f32 or f64.
pub trait Real:
    Copy
    + PartialOrd
    + From<u16>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
}

impl Real for f32 {}
impl Real for f64 {}

/// A rotation from the base's axes to those of the world. No function reads its entries by their
/// order, since libraries differ in it: Pinocchio, ROS and SciPy write x, y, z, w, and MuJoCo,
/// Drake and Eigen's constructor w, x, y, z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quaternion<T> {
    /// The axis times sin(θ/2).
    pub x: T,
    /// The axis times sin(θ/2).
    pub y: T,
    /// The axis times sin(θ/2).
    pub z: T,
    /// cos(θ/2)
    pub w: T,
}

/// A base's pose: its origin in the world in m, and its orientation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose<T> {
    /// The base's origin in world axes, m.
    pub position: [T; 3],
    /// From the base's axes to the world's.
    pub orientation: Quaternion<T>,
}

/// Axes and point of a base's velocity or acceleration, six numbers, other than the base's axes
/// and origin, which generated functions take.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axes {
    /// World axes at the base's origin: Pinocchio's `LOCAL_WORLD_ALIGNED`; Drake's floating
    /// velocities in another order, angular over linear.
    Mixed,
    /// World axes at the world's origin: Pinocchio's `WORLD`.
    World,
    /// Linear in world axes, angular in the base's: `qvel` and `qacc` of a free joint of MuJoCo.
    Split,
}

impl<T: Real> Quaternion<T> {
    /// Returns the quaternion of four numbers in the order x, y, z, w.
    pub fn from_xyzw([x, y, z, w]: [T; 4]) -> Self {
        Self { x, y, z, w }
    }

    /// Returns the quaternion of four numbers in the order w, x, y, z.
    pub fn from_wxyz([w, x, y, z]: [T; 4]) -> Self {
        Self { x, y, z, w }
    }

    /// Returns x, y, z, w.
    pub fn to_xyzw(self) -> [T; 4] {
        [self.x, self.y, self.z, self.w]
    }

    /// Returns w, x, y, z.
    pub fn to_wxyz(self) -> [T; 4] {
        [self.w, self.x, self.y, self.z]
    }

    /// Returns a vector of the base's axes in world axes. The quaternion's length may be any but
    /// zero.
    pub fn rotate(self, vector: [T; 3]) -> [T; 3] {
        self.turned(vector, self.w)
    }

    /// Returns a vector of world axes in the base's axes: of the world's gravity, (0, 0, −9.81)
    /// where z points upward, it is the argument `g` of generated functions. The quaternion's
    /// length may be any but zero.
    pub fn rotate_back(self, vector: [T; 3]) -> [T; 3] {
        self.turned(vector, -self.w)
    }

    /// p + 2 (w u×p + u×(u×p)) / |q|²
    fn turned(self, vector: [T; 3], w: T) -> [T; 3] {
        let u = [self.x, self.y, self.z];
        let first = cross(u, vector);
        let second = cross(u, first);
        let scale = T::from(2) / self.squared();
        add(vector, times(scale, add(times(w, first), second)))
    }

    fn squared(self) -> T {
        self.x * self.x + self.y * self.y + self.z * self.z + self.w * self.w
    }

    /// Returns the rotation by `other`, then by this one.
    pub fn after(self, other: Self) -> Self {
        let (u, v) = ([self.x, self.y, self.z], [other.x, other.y, other.z]);
        let [x, y, z] = add(add(times(self.w, v), times(other.w, u)), cross(u, v));
        let w = self.w * other.w - (u[0] * v[0] + u[1] * v[1] + u[2] * v[2]);
        Self { x, y, z, w }
    }

    fn scaled(self, factor: T) -> Self {
        let [x, y, z, w] = self.to_xyzw().map(|entry| factor * entry);
        Self { x, y, z, w }
    }

    /// 2/(1 + |q|²) times it, which takes a length 1 + ε to 1 − ε²/2 without a root.
    fn nearly_unit(self) -> Self {
        self.scaled(T::from(2) / (T::from(1) + self.squared()))
    }
}

impl<T: Real> Pose<T> {
    /// Returns the pose after a step in the base's axes, six numbers: a velocity times a time, in m
    /// over rad. It is the exponential map of SE(3), Pinocchio's `integrate`.
    ///
    /// There is no branch, no root and no sine: the step's angle θ appears as θ² in series, whose
    /// rest is below 1e-18 up to half a turn and 1e-11 up to a whole turn. Up to half a turn each
    /// entry of the orientation errs by less than 4 u, and each of the position by less than
    /// 16 u of the longest of position and step (u = 2⁻⁵³ of f64, 2⁻²⁴ of f32). The orientation's
    /// length stays 1 within 8 u however many steps are made.
    #[must_use]
    pub fn integrate(&self, step: [T; 6]) -> Self {
        let (linear, turn) = halves(step);
        let square = turn[0] * turn[0] + turn[1] * turn[1] + turn[2] * turn[2];
        let quarter = square / T::from(4);
        // cos(θ/2), sin(θ/2)/θ and (θ − sin θ)/θ³
        let cosine = series(quarter, 0);
        let sine = series(quarter, 1) / T::from(2);
        let rest = series(square, 3) / T::from(6);
        let bend = T::from(2) * sine * sine;
        let once = cross(turn, linear);
        let twice = cross(turn, once);
        let travel = add(linear, add(times(bend, once), times(rest, twice)));
        let [x, y, z] = times(sine, turn);
        let step = Quaternion { x, y, z, w: cosine };
        Self {
            position: add(self.position, self.orientation.rotate(travel)),
            orientation: self.orientation.after(step).nearly_unit(),
        }
    }

    /// Returns the step in this base's axes that leads to another pose, six numbers in m over rad:
    /// the shorter way round. It is the logarithm of SE(3), Pinocchio's `difference`, and the inverse
    /// of [`Pose::integrate`].
    ///
    /// The orientations have length 1 within 1e-8 (f32: 1e-4). Nothing is divided by an angle: with
    /// u = v / (1 + w), whose length is tan(θ/4), the turn is 4 u · atan|u|/|u|, a quotient of
    /// polynomials in |u|² with positive coefficients. Its rest is below 1e-17; each entry of the
    /// turn errs by less than 16 u rad, and each of the linear part by less than 32 u of the longest
    /// position (u = 2⁻⁵³ of f64, 2⁻²⁴ of f32). At half a turn, where both ways are as short, one is taken.
    pub fn difference(&self, to: &Self) -> [T; 6] {
        let [x, y, z, w] = self.orientation.to_xyzw();
        let back = Quaternion {
            x: -x,
            y: -y,
            z: -z,
            w,
        };
        let between = back.after(to.orientation).nearly_unit();
        let between = match between.w < T::from(0) {
            true => between.scaled(-T::from(1)),
            false => between,
        };
        let u = [between.x, between.y, between.z];
        let u = times(T::from(1) / (T::from(1) + between.w), u);
        let square = u[0] * u[0] + u[1] * u[1] + u[2] * u[2];
        let [angle, rest] = arc(square);
        let away = subtract(to.position, self.position);
        let away = self.orientation.rotate_back(away);
        let once = cross(u, away);
        let twice = cross(u, once);
        let linear = subtract(away, times(T::from(2) * angle, once));
        let linear = add(linear, times(angle + rest, twice));
        six(linear, times(T::from(4) * angle, u))
    }

    /// Returns the velocity (v, ω) of the base, which generated functions take, in other axes.
    pub fn velocity_in(&self, axes: Axes, velocity: [T; 6]) -> [T; 6] {
        let (linear, angular) = halves(velocity);
        let linear = self.orientation.rotate(linear);
        match axes {
            Axes::Split => six(linear, angular),
            Axes::Mixed => six(linear, self.orientation.rotate(angular)),
            Axes::World => {
                let angular = self.orientation.rotate(angular);
                six(add(linear, cross(self.position, angular)), angular)
            }
        }
    }

    /// Returns the velocity in the base's axes, (v, ω), from that in other axes.
    pub fn velocity_from(&self, axes: Axes, velocity: [T; 6]) -> [T; 6] {
        let (linear, angular) = halves(velocity);
        let linear = match axes {
            Axes::World => subtract(linear, cross(self.position, angular)),
            Axes::Mixed | Axes::Split => linear,
        };
        let angular = match axes {
            Axes::Split => angular,
            Axes::Mixed | Axes::World => self.orientation.rotate_back(angular),
        };
        six(self.orientation.rotate_back(linear), angular)
    }

    /// Returns the rate of the velocity in other axes from `acceleration`, the rate of (v, ω) in the
    /// base's axes, and `velocity`, which is (v, ω).
    ///
    /// The axes of a base turn, so that this is not a rotation: in mixed axes the linear part is
    /// R (v̇ + ω × v).
    pub fn acceleration_in(&self, axes: Axes, velocity: [T; 6], acceleration: [T; 6]) -> [T; 6] {
        let (linear, angular) = halves(acceleration);
        let linear = add(linear, turning(axes, velocity));
        self.velocity_in(axes, six(linear, angular))
    }

    /// Returns the rate of (v, ω) in the base's axes from that of the velocity in other axes;
    /// `velocity` is (v, ω), in the base's axes.
    pub fn acceleration_from(&self, axes: Axes, velocity: [T; 6], acceleration: [T; 6]) -> [T; 6] {
        let (linear, angular) = halves(self.velocity_from(axes, acceleration));
        six(subtract(linear, turning(axes, velocity)), angular)
    }
}

/// ω × v where the point moves with the base; in the world's origin the two parts of it cancel.
fn turning<T: Real>(axes: Axes, velocity: [T; 6]) -> [T; 3] {
    let (linear, angular) = halves(velocity);
    match axes {
        Axes::Mixed | Axes::Split => cross(angular, linear),
        Axes::World => [T::from(0); 3],
    }
}

/// 1 − x/((n+1)(n+2)) (1 − x/((n+3)(n+4)) (1 − …)): for n = 0 cos θ, for n = 1 sin θ/θ
/// and for n = 3 (θ − sin θ) · 6/θ³, with x = θ².
fn series<T: Real>(x: T, n: u16) -> T {
    let mut sum = T::from(1);
    for k in (0..TERMS).rev() {
        let divisor = (n + 2 * k + 1) * (n + 2 * k + 2);
        sum = T::from(1) - x / T::from(divisor) * sum;
    }
    sum
}

/// The rest of the series is below 1e-18 for θ ≤ π.
const TERMS: u16 = 14;

/// With x = tan²(φ), returns φ/tan φ and (1 − φ/tan φ)/tan² φ by Gauss's continued fraction
/// 1/(1 + x/(3 + 4x/(5 + 9x/(7 + …)))), whose quotients are made without division from the innermost
/// one outward.
fn arc<T: Real>(x: T) -> [T; 2] {
    let (mut over, mut under) = (T::from(2 * LEVELS + 1), T::from(1));
    for k in (1..LEVELS).rev() {
        let next = T::from(2 * k + 1) * over + T::from((k + 1) * (k + 1)) * x * under;
        (over, under) = (next, over);
    }
    let whole = over + x * under;
    [over / whole, under / whole]
}

/// Each level takes the error down to 0.18 of it for x ≤ 1.
const LEVELS: u16 = 23;

fn halves<T: Real>([a, b, c, d, e, f]: [T; 6]) -> ([T; 3], [T; 3]) {
    ([a, b, c], [d, e, f])
}

fn six<T: Real>([a, b, c]: [T; 3], [d, e, f]: [T; 3]) -> [T; 6] {
    [a, b, c, d, e, f]
}

fn add<T: Real>([a, b, c]: [T; 3], [d, e, f]: [T; 3]) -> [T; 3] {
    [a + d, b + e, c + f]
}

fn subtract<T: Real>([a, b, c]: [T; 3], [d, e, f]: [T; 3]) -> [T; 3] {
    [a - d, b - e, c - f]
}

fn times<T: Real>(factor: T, vector: [T; 3]) -> [T; 3] {
    vector.map(|entry| factor * entry)
}

fn cross<T: Real>([a, b, c]: [T; 3], [d, e, f]: [T; 3]) -> [T; 3] {
    [b * f - c * e, c * d - a * f, a * e - b * d]
}
