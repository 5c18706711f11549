//! The recursion of Newton and Euler, in the frames behind the joints.
//!
//! Every row is taken as a twist about and a shift along x, then the joint's turn about
//! and shift along z: A_i = Rx(α)·Tx(a)·Rz(θ)·Tz(d), as the modified convention has it.
//! Of the standard one, A_i = Rz(θ)·Tz(d)·Tx(a)·Rx(α), the twist and shift of each row
//! come before the next joint's turn, and its bodies are brought into the frame before
//! them. Vectors have three entries in the axes of one link's frame.

use crate::fault::Fault;
use crate::number::{Angle, Ball, Number};
use crate::polynomial::Work;
use crate::robot::{Body, Robot};

type Vector<T> = [T; 3];

/// The state of one joint: sine and cosine of q if it turns, q itself if it slides.
#[derive(Clone, Debug)]
pub struct State<T> {
    /// sin q, of a joint that turns.
    pub sin: T,
    /// cos q, of a joint that turns.
    pub cos: T,
    /// q, m, of a joint that slides.
    pub position: T,
    /// q̇, rad/s or m/s
    pub velocity: T,
    /// q̈, rad/s² or m/s²
    pub acceleration: T,
}

/// Arithmetic that counts its work.
struct Arithmetic<'w>(&'w mut Work);

impl Arithmetic<'_> {
    fn times<T: Number>(&mut self, a: &T, b: &T) -> Result<T, Fault> {
        a.times(b, self.0)
    }

    /// a·b + c·d
    fn two<T: Number>(&mut self, a: &T, b: &T, c: &T, d: &T) -> Result<T, Fault> {
        Ok(self.times(a, b)?.plus(&self.times(c, d)?))
    }

    fn cross<T: Number>(&mut self, a: &Vector<T>, b: &Vector<T>) -> Result<Vector<T>, Fault> {
        let mut entry = |i: usize, k: usize| self.two(&a[i], &b[k], &a[k].negated(), &b[i]);
        Ok([entry(1, 2)?, entry(2, 0)?, entry(0, 1)?])
    }

    fn dot<T: Number>(&mut self, a: &Vector<T>, b: &Vector<T>) -> Result<T, Fault> {
        Ok(self.two(&a[0], &b[0], &a[1], &b[1])?.plus(&self.times(&a[2], &b[2])?))
    }

    fn scaled<T: Number>(&mut self, a: &T, b: &Vector<T>) -> Result<Vector<T>, Fault> {
        Ok([self.times(a, &b[0])?, self.times(a, &b[1])?, self.times(a, &b[2])?])
    }

    fn apply<T: Number>(&mut self, m: &[Vector<T>; 3], v: &Vector<T>) -> Result<Vector<T>, Fault> {
        Ok([self.dot(&m[0], v)?, self.dot(&m[1], v)?, self.dot(&m[2], v)?])
    }

    /// v turned by an angle in the plane of two axes, from the first to the second.
    fn turned<T: Number>(
        &mut self,
        v: &Vector<T>,
        [first, second]: [usize; 2],
        [sin, cos]: [&T; 2],
    ) -> Result<Vector<T>, Fault> {
        let mut turned = v.clone();
        turned[first] = self.two(cos, &v[first], &sin.negated(), &v[second])?;
        turned[second] = self.two(sin, &v[first], cos, &v[second])?;
        Ok(turned)
    }
}

fn sum<T: Number>(a: &Vector<T>, b: &Vector<T>) -> Vector<T> {
    [0, 1, 2].map(|i| a[i].plus(&b[i]))
}

fn constants<T: Number, const N: usize>(values: [Ball; N]) -> [T; N] {
    values.map(T::constant)
}

/// The mass of bodies, its first moment and its inertia about the origin of the frame
/// that is twisted by α and shifted by a against the bodies' own.
struct Moments<T> {
    mass: T,
    first: Vector<T>,
    second: [Vector<T>; 3],
}

fn moments<T: Number>(
    bodies: &[Body],
    (alpha, a): (Angle, Ball),
    math: &mut Arithmetic,
) -> Result<Moments<T>, Fault> {
    let zero = || T::constant(Ball::default());
    let zeros = || [zero(), zero(), zero()];
    let [sin, cos] = constants::<T, 2>(alpha.sin_cos().into());
    let mut all = Moments { mass: zero(), first: zeros(), second: [zeros(), zeros(), zeros()] };
    for body in bodies {
        let mass = T::constant(body.mass);
        let [xx, yy, zz, xy, yz, xz] = constants::<T, 6>(body.inertia);
        let rows = [[xx, xy.clone(), xz.clone()], [xy, yy, yz.clone()], [xz, yz, zz]];
        // R I Rᵀ: every row turned, then every column.
        let (plane, turn) = ([1, 2], [&sin, &cos]);
        let mut own = rows;
        for _ in 0..2 {
            for row in &mut own {
                *row = math.turned(row, plane, turn)?;
            }
            own = [0, 1, 2].map(|i| [0, 1, 2].map(|k: usize| own[k][i].clone()));
        }
        let com = math.turned(&constants(body.com), plane, turn)?;
        let com = sum(&com, &[T::constant(a), zero(), zero()]);
        let first = math.scaled(&mass, &com)?;
        let square = math.dot(&com, &first)?;
        for i in 0..3 {
            for k in 0..3 {
                // Steiner: m (c·c 1 − c cᵀ)
                let mixed = math.times(&com[i], &first[k])?.negated();
                let moved = if i == k { mixed.plus(&square) } else { mixed };
                all.second[i][k] = all.second[i][k].plus(&own[i][k]).plus(&moved);
            }
        }
        all.mass = all.mass.plus(&mass);
        all.first = sum(&all.first, &first);
    }
    Ok(all)
}

/// The torques or forces τ = D q̈ + h + c + b∘q̇, one a joint, in N·m or N; `gravity` and
/// `friction` say whether c and b∘q̇ are in them.
///
/// # Errors
/// As of the numbers' products.
pub fn torques<T: Number>(
    robot: &Robot,
    states: &[State<T>],
    (gravity, friction): (bool, bool),
    work: &mut Work,
) -> Result<Vec<T>, Fault> {
    let math = &mut Arithmetic(work);
    let zero = || T::constant(Ball::default());
    let zeros = || [zero(), zero(), zero()];
    let unmoved = (Angle::number(Ball::default()).unwrap_or_default(), Ball::default());
    let (mut w, mut wd) = (zeros(), zeros());
    // A base that is accelerated upward feels what one in gravity does.
    let mut vd = if gravity { constants(robot.gravity).map(|g: T| g.negated()) } else { zeros() };
    let mut before = unmoved;
    let (mut frames, mut loads) = (Vec::new(), Vec::new());
    for (joint, state) in robot.joints.iter().zip(states) {
        let own = (joint.alpha, joint.a);
        let (twist, behind) = if robot.modified { (own, unmoved) } else { (before, own) };
        before = own;
        let [sin_a, cos_a] = constants::<T, 2>(twist.0.sin_cos().into());
        let [sin_o, cos_o] = constants::<T, 2>(joint.theta.sin_cos().into());
        let constant = T::constant(joint.d);
        let (sin, cos, d) = match joint.turns {
            true => (
                math.two(&state.sin, &cos_o, &state.cos, &sin_o)?,
                math.two(&state.cos, &cos_o, &state.sin.negated(), &sin_o)?,
                constant,
            ),
            false => (sin_o, cos_o, state.position.plus(&constant)),
        };
        let shift = [
            T::constant(twist.1),
            math.times(&sin_a, &d)?.negated(),
            math.times(&cos_a, &d)?,
        ];
        let swing = math.cross(&w, &shift)?;
        let carried = sum(&math.cross(&wd, &shift)?, &math.cross(&w, &swing)?);
        let mut inward = |v: &Vector<T>| {
            let v = math.turned(v, [1, 2], [&sin_a.negated(), &cos_a])?;
            math.turned(&v, [0, 1], [&sin.negated(), &cos])
        };
        (vd, w, wd) = (inward(&sum(&vd, &carried))?, inward(&w)?, inward(&wd)?);
        // w × z
        let sideways = [w[1].clone(), w[0].negated(), zero()];
        let sideways = math.scaled(&state.velocity, &sideways)?;
        if joint.turns {
            wd = sum(&wd, &sideways);
            wd[2] = wd[2].plus(&state.acceleration);
            w[2] = w[2].plus(&state.velocity);
        } else {
            vd = sum(&vd, &sum(&sideways, &sideways));
            vd[2] = vd[2].plus(&state.acceleration);
        }
        let body = moments(&joint.bodies, behind, math)?;
        let swing = math.cross(&w, &body.first)?;
        let force = sum(&math.cross(&wd, &body.first)?, &math.cross(&w, &swing)?);
        let force = sum(&force, &math.scaled(&body.mass, &vd)?);
        let spin = math.apply(&body.second, &w)?;
        let moment = sum(&math.apply(&body.second, &wd)?, &math.cross(&w, &spin)?);
        let moment = sum(&moment, &math.cross(&body.first, &vd)?);
        loads.push((force, moment));
        frames.push(([sin_a, cos_a], [sin, cos], shift));
    }
    let (mut f, mut n) = (zeros(), zeros());
    let mut torques = Vec::new();
    for (i, joint) in robot.joints.iter().enumerate().rev() {
        (f, n) = (sum(&f, &loads[i].0), sum(&n, &loads[i].1));
        let mut torque = if joint.turns { n[2].clone() } else { f[2].clone() };
        let drive = math.times(&T::constant(joint.armature), &states[i].acceleration)?;
        torque = torque.plus(&drive);
        if friction {
            let rubbing = math.times(&T::constant(joint.viscous), &states[i].velocity)?;
            torque = torque.plus(&rubbing);
        }
        torques.push(torque);
        let ([sin_a, cos_a], [sin, cos], shift) = &frames[i];
        let mut outward = |v: &Vector<T>| {
            let v = math.turned(v, [0, 1], [sin, cos])?;
            math.turned(&v, [1, 2], [sin_a, cos_a])
        };
        (f, n) = (outward(&f)?, outward(&n)?);
        n = sum(&n, &math.cross(shift, &f)?);
    }
    torques.reverse();
    Ok(torques)
}
