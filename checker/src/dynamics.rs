//! The recursion of Newton and Euler, in the frames behind the joints.
//!
//! Every row is taken as a twist about and a shift along x, then the joint's turn about
//! and shift along z: A_i = Rx(α)·Tx(a)·Rz(θ)·Tz(d), as the modified convention has it.
//! Of the standard one, A_i = Rz(θ)·Tz(d)·Tx(a)·Rx(α), the twist and shift of each row
//! come before the next joint's turn, and its bodies are brought into the frame before
//! them. Vectors have three entries in the axes of one link's frame.

use crate::fault::Fault;
use crate::number::Number;
use crate::polynomial::Work;
use crate::robot::Body;
use crate::scene::Setting;

type Vector<N> = [N; 3];
/// A sine and a cosine.
type Turn<'a, N> = [&'a N; 2];

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

fn sum<N: Number>(a: &Vector<N>, b: &Vector<N>) -> Vector<N> {
    [0, 1, 2].map(|i| a[i].plus(&b[i]))
}

fn zeros<N: Number>() -> Vector<N> {
    Default::default()
}

/// Products, which are counted.
struct Products<'w>(&'w mut Work);

impl Products<'_> {
    /// a·b + c·d
    fn two<N: Number>(&mut self, a: &N, b: &N, c: &N, d: &N) -> Result<N, Fault> {
        Ok(a.times(b, self.0)?.plus(&c.times(d, self.0)?))
    }

    fn cross<N: Number>(&mut self, a: &Vector<N>, b: &Vector<N>) -> Result<Vector<N>, Fault> {
        let mut entry = |i: usize, k: usize| self.two(&a[i], &b[k], &a[k].negated(), &b[i]);
        Ok([entry(1, 2)?, entry(2, 0)?, entry(0, 1)?])
    }

    fn dot<N: Number>(&mut self, a: &Vector<N>, b: &Vector<N>) -> Result<N, Fault> {
        Ok(self
            .two(&a[0], &b[0], &a[1], &b[1])?
            .plus(&a[2].times(&b[2], self.0)?))
    }

    fn scaled<N: Number>(&mut self, a: &N, b: &Vector<N>) -> Result<Vector<N>, Fault> {
        Ok([
            a.times(&b[0], self.0)?,
            a.times(&b[1], self.0)?,
            a.times(&b[2], self.0)?,
        ])
    }

    fn apply<N: Number>(&mut self, m: &[Vector<N>; 3], v: &Vector<N>) -> Result<Vector<N>, Fault> {
        Ok([
            self.dot(&m[0], v)?,
            self.dot(&m[1], v)?,
            self.dot(&m[2], v)?,
        ])
    }

    /// v turned about the axis before two others, from the first of them to the second.
    fn turned<N: Number>(
        &mut self,
        v: &Vector<N>,
        [i, k]: [usize; 2],
        [sin, cos]: Turn<N>,
    ) -> Result<Vector<N>, Fault> {
        let mut turned = v.clone();
        turned[i] = self.two(cos, &v[i], &sin.negated(), &v[k])?;
        turned[k] = self.two(sin, &v[i], cos, &v[k])?;
        Ok(turned)
    }
}

const ABOUT_X: [usize; 2] = [1, 2];
const ABOUT_Z: [usize; 2] = [0, 1];

/// Mass, first moment and inertia about the origin.
#[derive(Default)]
struct Moments<N> {
    mass: N,
    first: Vector<N>,
    second: [Vector<N>; 3],
}

impl<N: Number> Moments<N> {
    /// Adds a body that is given behind a twist and a shift along x.
    fn add(
        &mut self,
        body: &Body,
        [sin, cos]: Turn<N>,
        a: &N,
        products: &mut Products,
    ) -> Result<(), Fault> {
        let [xx, yy, zz, xy, yz, xz] = body.inertia.map(N::constant);
        let mut own = [
            [xx, xy.clone(), xz.clone()],
            [xy, yy, yz.clone()],
            [xz, yz, zz],
        ];
        // R I Rᵀ: every row turned, then every column.
        for _ in 0..2 {
            for row in &mut own {
                *row = products.turned(row, ABOUT_X, [sin, cos])?;
            }
            own = [0, 1, 2].map(|i| [0, 1, 2].map(|k: usize| own[k][i].clone()));
        }
        let com = products.turned(&body.com.map(N::constant), ABOUT_X, [sin, cos])?;
        let com = sum(&com, &[a.clone(), N::default(), N::default()]);
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
struct Link<'a, N> {
    twist: Turn<'a, N>,
    turn: [N; 2],
    shift: Vector<N>,
    force: Vector<N>,
    moment: Vector<N>,
}

/// The torques or forces τ = D q̈ + h + c + b∘q̇, one a joint, in N·m or N; `gravity` and
/// `friction` say whether c and b∘q̇ are in them.
///
/// # Errors
/// As of [`Number::times`].
pub fn torques<N: Number>(
    setting: &Setting,
    states: &[State<N>],
    (gravity, friction): (bool, bool),
    work: &mut Work,
) -> Result<Vec<N>, Fault> {
    let products = &mut Products(work);
    let (none, one) = (N::default(), N::one());
    let (mut w, mut wd, mut vd) = (zeros(), zeros(), zeros());
    if gravity {
        // A base that is accelerated upward feels what one in gravity does.
        vd = setting.gravity.map(|g| N::constant(g).negated());
    }
    let unmoved = ([&none, &one], &none);
    let (mut before, mut links) = (unmoved, Vec::new());
    let rows = setting.joints.iter();
    let rows: Vec<[N; 3]> = rows
        .map(|joint| [joint.alpha.sin, joint.alpha.cos, joint.a].map(N::constant))
        .collect();
    for ((joint, row), state) in setting.joints.iter().zip(&rows).zip(states) {
        let own = ([&row[0], &row[1]], &row[2]);
        let ((twist, a), behind) = if setting.modified {
            (own, unmoved)
        } else {
            (before, own)
        };
        before = own;
        let [sin, cos, d] = [joint.theta.sin, joint.theta.cos, joint.d].map(N::constant);
        let (turn, d) = match joint.turns {
            true => {
                let turned = products.two(&state.sin, &cos, &state.cos, &sin)?;
                let cos = products.two(&state.cos, &cos, &state.sin.negated(), &sin)?;
                ([turned, cos], d)
            }
            false => ([sin, cos], d.plus(&state.position)),
        };
        let back = [twist[0].negated(), turn[0].negated()];
        let shift = [
            a.clone(),
            back[0].times(&d, products.0)?,
            twist[1].times(&d, products.0)?,
        ];
        let swing = products.cross(&w, &shift)?;
        let carried = sum(&products.cross(&wd, &shift)?, &products.cross(&w, &swing)?);
        let mut inward = |v: &Vector<N>| {
            let v = products.turned(v, ABOUT_X, [&back[0], twist[1]])?;
            products.turned(&v, ABOUT_Z, [&back[1], &turn[1]])
        };
        (vd, w, wd) = (inward(&sum(&vd, &carried))?, inward(&w)?, inward(&wd)?);
        // w × z q̇
        let sideways = [w[1].clone(), w[0].negated(), none.clone()];
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
            body.add(own, behind.0, behind.1, products)?;
        }
        let swing = products.cross(&w, &body.first)?;
        let force = sum(
            &products.cross(&wd, &body.first)?,
            &products.cross(&w, &swing)?,
        );
        let force = sum(&force, &products.scaled(&body.mass, &vd)?);
        let spin = products.apply(&body.second, &w)?;
        let moment = sum(
            &products.apply(&body.second, &wd)?,
            &products.cross(&w, &spin)?,
        );
        let moment = sum(&moment, &products.cross(&body.first, &vd)?);
        links.push(Link {
            twist,
            turn,
            shift,
            force,
            moment,
        });
    }
    let (mut f, mut n, mut torques) = (zeros(), zeros(), Vec::new());
    for ((link, joint), state) in links.iter().zip(&setting.joints).zip(states).rev() {
        (f, n) = (sum(&f, &link.force), sum(&n, &link.moment));
        let mut torque = if joint.turns {
            n[2].clone()
        } else {
            f[2].clone()
        };
        torque = torque.plus(&N::constant(joint.armature).times(&state.acceleration, products.0)?);
        if friction {
            torque = torque.plus(&N::constant(joint.viscous).times(&state.velocity, products.0)?);
        }
        torques.push(torque);
        let mut outward = |v: &Vector<N>| {
            let v = products.turned(v, ABOUT_Z, [&link.turn[0], &link.turn[1]])?;
            products.turned(&v, ABOUT_X, link.twist)
        };
        (f, n) = (outward(&f)?, outward(&n)?);
        n = sum(&n, &products.cross(&link.shift, &f)?);
    }
    torques.reverse();
    Ok(torques)
}
