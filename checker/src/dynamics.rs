//! The recursion of Newton and Euler, in the frames behind the joints.
//!
//! From a joint's frame to the next, constant turns and shifts lead, those behind the one
//! and before the other, and then the joint's turn about z and shift along it. A link's bodies
//! are brought into its joint's frame. Vectors have three entries in the axes of one of these.

use crate::fault::Fault;
use crate::number::{Number, Work};
use crate::robot::{Body, Step, Z};
use crate::scene::Setting;

pub(crate) type Vector<N> = [N; 3];

/// The state of one joint.
#[derive(Clone, Debug, Default)]
pub struct State<N> {
    /// sin q, of a joint that turns.
    pub sin: N,
    /// cos q, of a joint that turns.
    pub cos: N,
    /// q, m, of a joint that slides.
    pub position: N,
    /// q̇, rad/s or m/s
    pub velocity: N,
    /// q̈, rad/s² or m/s²
    pub acceleration: N,
}

pub(crate) fn sum<N: Number>(a: &Vector<N>, b: &Vector<N>) -> Vector<N> {
    [0, 1, 2].map(|i| a[i].plus(&b[i]))
}

fn each<N>(mut entry: impl FnMut(usize) -> Result<N, Fault>) -> Result<Vector<N>, Fault> {
    Ok([entry(0)?, entry(1)?, entry(2)?])
}

/// Products, which are counted.
pub(crate) struct Products<'w>(pub(crate) &'w mut Work);

impl Products<'_> {
    /// Returns a·b + c·d
    fn two<N: Number>(&mut self, a: &N, b: &N, c: &N, d: &N) -> Result<N, Fault> {
        Ok(a.times(b, self.0)?.plus(&c.times(d, self.0)?))
    }

    pub(crate) fn cross<N: Number>(
        &mut self,
        a: &Vector<N>,
        b: &Vector<N>,
    ) -> Result<Vector<N>, Fault> {
        let mut entry = |i: usize, k: usize| self.two(&a[i], &b[k], &a[k].negated(), &b[i]);
        Ok([entry(1, 2)?, entry(2, 0)?, entry(0, 1)?])
    }

    pub(crate) fn dot<N: Number>(&mut self, a: &Vector<N>, b: &Vector<N>) -> Result<N, Fault> {
        Ok(self
            .two(&a[0], &b[0], &a[1], &b[1])?
            .plus(&a[2].times(&b[2], self.0)?))
    }

    /// Returns ẇ × v + w × (w × v), of w and ẇ.
    fn swing<N: Number>(&mut self, v: &Vector<N>, w: [&Vector<N>; 2]) -> Result<Vector<N>, Fault> {
        let swing = self.cross(w[0], v)?;
        Ok(sum(&self.cross(w[1], v)?, &self.cross(w[0], &swing)?))
    }

    fn scaled<N: Number>(&mut self, a: &N, b: &Vector<N>) -> Result<Vector<N>, Fault> {
        each(|i| a.times(&b[i], self.0))
    }

    fn apply<N: Number>(&mut self, m: &[Vector<N>; 3], v: &Vector<N>) -> Result<Vector<N>, Fault> {
        each(|i| self.dot(&m[i], v))
    }

    /// Returns v turned about the axis before two others, from the first of them to the second.
    fn turned<N: Number>(
        &mut self,
        v: &Vector<N>,
        [i, k]: [usize; 2],
        [sin, cos]: [&N; 2],
    ) -> Result<Vector<N>, Fault> {
        let mut turned = v.clone();
        turned[i] = self.two(cos, &v[i], &sin.negated(), &v[k])?;
        turned[k] = self.two(sin, &v[i], cos, &v[k])?;
        Ok(turned)
    }

    /// Returns a vector, or a point, of the last frame of a way in the axes of the first.
    pub(crate) fn outward<N: Number>(
        &mut self,
        v: &Vector<N>,
        way: &[Step<N>],
        is_point: bool,
    ) -> Result<Vector<N>, Fault> {
        let mut v = v.clone();
        for step in way.iter().rev() {
            v = match step {
                Step::Turn(axes, [sin, cos]) => self.turned(&v, *axes, [sin, cos])?,
                Step::Shift(shift) if is_point => sum(&v, shift),
                Step::Shift(_) => v,
            };
        }
        Ok(v)
    }

    /// Returns a vector of the first frame of a way in the axes of the last.
    fn inward<N: Number>(&mut self, v: &Vector<N>, way: &[Step<N>]) -> Result<Vector<N>, Fault> {
        let mut v = v.clone();
        for step in way {
            if let Step::Turn(axes, [sin, cos]) = step {
                v = self.turned(&v, *axes, [&sin.negated(), cos])?;
            }
        }
        Ok(v)
    }
}

/// Returns the numbers of a way.
pub(crate) fn way<N: Number>(steps: &[Step]) -> Vec<Step<N>> {
    let step = |step: &Step| match step {
        Step::Turn(axes, pair) => Step::Turn(*axes, pair.map(N::constant)),
        Step::Shift(shift) => Step::Shift(shift.map(N::constant)),
    };
    steps.iter().map(step).collect()
}

/// Returns the direction of a joint's axis in the frame of the joint before it.
///
/// # Errors
/// As of [`Number::times`].
pub fn axis<N: Number>(setting: &Setting, joint: usize, work: &mut Work) -> Result<[N; 3], Fault> {
    let mut steps = joint
        .checked_sub(1)
        .map_or(vec![], |k| way(&setting.joints[k].behind));
    steps.extend(way(&setting.joints[joint].before));
    Products(work).outward(&[N::default(), N::default(), N::one()], &steps, false)
}

/// Mass, first moment and inertia about the origin.
#[derive(Default)]
struct Moments<N> {
    mass: N,
    first: Vector<N>,
    second: [Vector<N>; 3],
}

impl<N: Number> Moments<N> {
    /// Adds a body that is given in the frame of its link, to which a way leads.
    fn add(&mut self, body: &Body, link: &[Step], products: &mut Products) -> Result<(), Fault> {
        let steps: Vec<Step<N>> = way(&[link, &body.frame].concat());
        let [xx, yy, zz, xy, yz, xz] = body.inertia.map(N::constant);
        let mut own = [
            [xx, xy.clone(), xz.clone()],
            [xy, yy, yz.clone()],
            [xz, yz, zz],
        ];
        // R I Rᵀ: every row turned, then every column.
        for _ in 0..2 {
            for row in &mut own {
                *row = products.outward(row, &steps, false)?;
            }
            own = [0, 1, 2].map(|i| [0, 1, 2].map(|k: usize| own[k][i].clone()));
        }
        let com = products.outward(&body.com.map(N::constant), &steps, true)?;
        let first = products.scaled(&N::constant(body.mass), &com)?;
        let square = products.dot(&com, &first)?;
        for i in 0..3 {
            for k in 0..3 {
                // Steiner: m (c·c 1 − c cᵀ)
                let mut moved = com[i].times(&first[k], products.0)?.negated();
                moved = if i == k { moved.plus(&square) } else { moved };
                self.second[i][k] = self.second[i][k].plus(&own[i][k]).plus(&moved);
            }
        }
        self.mass = self.mass.plus(&N::constant(body.mass));
        self.first = sum(&self.first, &first);
        Ok(())
    }
}

/// How a link's frame lies in the one before, and what its motion takes.
struct Link<N> {
    way: Vec<Step<N>>,
    shift: Vector<N>,
    force: Vector<N>,
    moment: Vector<N>,
}

/// Returns the ways from frame 0 to the first joint's frame, moved, and from each joint's to the next.
///
/// # Errors
/// As of [`Number::times`].
pub(crate) fn ways<N: Number>(
    setting: &Setting,
    states: &[State<N>],
    work: &mut Work,
) -> Result<Vec<Vec<Step<N>>>, Fault> {
    let products = &mut Products(work);
    let (mut behind, mut ways): (&[Step], _) = (&[], Vec::new());
    for (joint, state) in setting.joints.iter().zip(states) {
        let mut way: Vec<Step<N>> = way(&[behind, &joint.before].concat());
        behind = &joint.behind;
        let [sin, cos, d] = [joint.theta.sin, joint.theta.cos, joint.d].map(N::constant);
        let (turn, d) = match joint.turns {
            true => {
                let turned = products.two(&state.sin, &cos, &state.cos, &sin)?;
                let cos = products.two(&state.cos, &cos, &state.sin.negated(), &sin)?;
                ([turned, cos], d)
            }
            false => ([sin, cos], d.plus(&state.position)),
        };
        way.extend([
            Step::Turn(Z, turn),
            Step::Shift([N::default(), N::default(), d]),
        ]);
        ways.push(way);
    }
    Ok(ways)
}

/// Returns the torques or forces τ = D q̈ + h + c + b∘q̇, one a joint, in N·m or N; `gravity` and
/// `friction` say whether c and b∘q̇ are in them.
///
/// # Errors
/// As of [`Number::times`].
pub fn torques<N: Number>(
    setting: &Setting,
    states: &[State<N>],
    [gravity, friction]: [bool; 2],
    work: &mut Work,
) -> Result<Vec<N>, Fault> {
    let ways = ways(setting, states, work)?;
    let products = &mut Products(work);
    let [mut w, mut wd, mut vd]: [Vector<N>; 3] = Default::default();
    if gravity {
        // A base that is accelerated upward feels what one in gravity does.
        let up = setting.gravity.map(|g| N::constant(g).negated());
        vd = products.inward(&up, &way(&setting.base))?;
    }
    let mut links: Vec<Link<N>> = Vec::new();
    for ((joint, state), way) in setting.joints.iter().zip(states).zip(ways) {
        let shift = products.outward(&Vector::default(), &way, true)?;
        let carried = products.swing(&shift, [&w, &wd])?;
        let mut inward = |v: &Vector<N>| products.inward(v, &way);
        (vd, w, wd) = (inward(&sum(&vd, &carried))?, inward(&w)?, inward(&wd)?);
        // w × z q̇
        let sideways = [w[1].clone(), w[0].negated(), N::default()];
        let sideways = products.scaled(&state.velocity, &sideways)?;
        if joint.turns {
            wd = sum(&wd, &sideways);
            wd[2] = wd[2].plus(&state.acceleration);
            w[2] = w[2].plus(&state.velocity);
        } else {
            vd = sum(&vd, &sum(&sideways, &sideways));
            vd[2] = vd[2].plus(&state.acceleration);
        }
        let mut body = Moments::default();
        for own in &joint.bodies {
            body.add(own, &joint.behind, products)?;
        }
        let force = products.swing(&body.first, [&w, &wd])?;
        let force = sum(&force, &products.scaled(&body.mass, &vd)?);
        let spin = products.apply(&body.second, &w)?;
        let spin = products.cross(&w, &spin)?;
        let moment = sum(&products.apply(&body.second, &wd)?, &spin);
        let moment = sum(&moment, &products.cross(&body.first, &vd)?);
        links.push(Link {
            way,
            shift,
            force,
            moment,
        });
    }
    let ([mut f, mut n], mut torques): ([Vector<N>; 2], _) = (Default::default(), Vec::new());
    for ((link, joint), state) in links.iter().zip(&setting.joints).zip(states).rev() {
        (f, n) = (sum(&f, &link.force), sum(&n, &link.moment));
        let torque = if joint.turns { &n[2] } else { &f[2] };
        let mut torque =
            torque.plus(&N::constant(joint.armature).times(&state.acceleration, products.0)?);
        if friction {
            let why = "no bound is known of torques with Coulomb friction";
            Fault::require(!joint.rubs, "coulomb", why)?;
            torque = torque.plus(&N::constant(joint.viscous).times(&state.velocity, products.0)?);
        }
        torques.push(torque);
        f = products.outward(&f, &link.way, false)?;
        n = products.outward(&n, &link.way, false)?;
        n = sum(&n, &products.cross(&link.shift, &f)?);
    }
    torques.reverse();
    Ok(torques)
}
