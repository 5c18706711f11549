//! A base that floats, wherever it is: the six joints that it is are at position zero, and that is
//! no loss.

use super::*;
use crate::robot::JointKind::{Prismatic, Revolute};

#[test]
fn a_floating_base_is_six_joints_anywhere() {
    let mut draw = Draw(Points::new(0x6a5e));
    for round in 0..20 {
        let arm = draw.floating(round % 5);
        anywhere(&arm, &mut draw, round);
    }
}

/// The base as six joints on links without mass, but for the last, in another order than that of
/// the coordinates: slides along x, y and z, turns about z, x and y.
fn carriers(body: &Link<S>) -> Vec<Link<S>> {
    let link = |k: usize| Link {
        kind: if k < 3 { Prismatic } else { Revolute },
        // From z to x to y to z.
        place: (k != 3).then(|| Columns::turned(three(|i| identity()[(i + 1) % 3]))),
        ..if k == 5 { body.clone() } else { Link::still() }
    };
    (0..6).map(link).collect()
}

/// The motion of a base in its axes.
struct Base {
    /// Gravity in its axes.
    gravity: Vector<S>,
    /// (v, ω)
    velocity: Vec<S>,
    /// Their rates.
    acceleration: Vec<S>,
    /// The columns of E, by which rates of the six joints give (v, ω).
    twists: Matrix<S>,
}

impl Base {
    fn of(arm: &Arm<S>, dh: &[DhVariables<S>], [qd, qdd]: [&[S]; 2]) -> Base {
        let pose = |derived: &[usize]| {
            let steps = arm.steps(dh).enumerate().take(6);
            steps.fold(Columns::identity(), |m, (i, step)| {
                let times = derived.iter().filter(|by| **by == i);
                times.fold(step.append(&m), |m, _| m.derive(step.link.kind))
            })
        };
        let at = pose(&[]);
        let back = |v: &Vector<S>| at.rotate_back(v);
        let turn = |m: &Columns<S>| {
            let entry = |i: usize, k: usize| dot(&at.axes[i], &m.axes[k]);
            [(2, 1), (0, 2), (1, 0)].map(|(i, k)| minus(&entry(i, k), &entry(k, i)).half())
        };
        let first: Vec<Columns<S>> = (0..6).map(|k| pose(&[k])).collect();
        let second: Vec<(S, Columns<S>)> = (0..36)
            .map(|at| (at / 6, at % 6))
            .map(|(k, m)| (times(&qd[k], &qd[m]), pose(&[k, m])))
            .collect();
        let rate = Columns::combination(qd.iter().cloned().zip(&first));
        let terms = second.iter().map(|(by, derivative)| (*by, derivative));
        let bend = Columns::combination(qdd.iter().cloned().zip(&first).chain(terms));
        let twist = |m: &Columns<S>| -> Vec<S> { [back(&m.origin), turn(m)].concat() };
        // Components of v in axes that turn: its rate is the acceleration less ω × v.
        let (v, omega) = (back(&rate.origin), turn(&rate));
        let linear = difference(&back(&bend.origin), &cross(&omega, &v));
        Base {
            gravity: back(&arm.gravity),
            velocity: [v, omega].concat(),
            acceleration: [linear, turn(&bend)].concat(),
            twists: first.iter().map(twist).collect(),
        }
    }

    /// Returns the loads of the six joints under a wrench on the base, over τ.
    fn felt(&self, loads: &[S]) -> Vec<S> {
        let felt = products(&self.twists, &loads[..6]);
        felt.into_iter().chain(loads[6..].iter().cloned()).collect()
    }
}

fn anywhere(arm: &Arm<S>, draw: &mut Draw, round: usize) {
    let mut elsewhere = arm.clone();
    elsewhere.floats = false;
    elsewhere.links.splice(..6, carriers(&arm.links[5]));
    let position = draw.position(&elsewhere.links);
    let dh = elsewhere.at(&position);
    let [qd, qdd] = [(); 2].map(|()| draw.values(dh.len()));
    let written = LagrangeEuler::new(&elsewhere, &dh);
    let base = Base::of(&elsewhere, &dh, [&qd, &qdd]);
    let mut floating = arm.clone();
    floating.gravity = base.gravity;
    let position = [&draw.position_of(arm)[..6], &position[6..]].concat();
    let at = floating.at(&position);
    let with_joints = |base: &[S], joints: &[S]| [base, &joints[6..]].concat();
    let velocity = with_joints(&base.velocity, &qd);
    let rates = with_joints(&base.acceleration, &qdd);
    let by = Formulation::LagrangeEuler;
    let found = by.inverse_dynamics(&floating, &at, &velocity, &rates);
    let expected = written.inverse_dynamics(&qd, &qdd);
    assert_eq!(fields(&base.felt(&found)), fields(&expected), "{round} τ");
    let d = by.inertia(&floating, &at);
    let half: Matrix<S> = d.iter().map(|row| base.felt(row)).collect();
    let full: Matrix<S> = columns_of(&half).iter().map(|row| base.felt(row)).collect();
    assert_eq!(flat(&full), flat(&written.inertia()), "{round} D");
    // The symbols are those of any coordinates: C of these is Eᵀ (C E + D Ė), which is skew beside
    // half of Ḋ, as it has to be, and gives h.
    let c = by.coriolis_matrix(&floating, &at, &velocity);
    let h = by.velocity_terms(&floating, &at, &velocity);
    assert_eq!(fields(&products(&c, &velocity)), fields(&h), "{round} h");
    let (moving_arm, moving_at) = floating.bending(&at, &velocity);
    let grown = by.inertia(&moving_arm, &moving_at);
    for (i, row) in grown.iter().enumerate() {
        for (k, entry) in row.iter().enumerate() {
            let both = plus(&c[i][k], &c[k][i]);
            assert_eq!(field(&entry.rate), field(&both), "{round} Ḋ_{i}{k}");
        }
    }
}
