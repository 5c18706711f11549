//! Trees on a base that floats: six joints on links without mass, but for the last.

use super::*;

#[test]
fn floating_trees_move_as_lagrange_and_euler_say() {
    let mut draw = Draw(Points::new(0xf10a7));
    for round in 0..20 {
        let arm = Arm {
            base: None,
            ..draw.arm(round % 5)
        };
        floating(&arm, &mut draw, round);
    }
}

/// The base as six joints on links without mass, but for the last: slides along x, y and z, turns
/// about z, x and y.
fn carriers(body: &Link<S>) -> Vec<Link<S>> {
    let link = |k: usize| Link {
        kind: match k < 3 {
            true => JointKind::Prismatic,
            false => JointKind::Revolute,
        },
        // From z to x to y to z.
        place: (k != 3).then(|| Columns::turned(three(|i| identity()[(i + 1) % 3]))),
        ..if k == 5 { body.clone() } else { Link::still() }
    };
    (0..6).map(link).collect()
}

/// The motion of a base in its axes.
struct Base {
    omega: Vector<S>,
    omega_dot: Vector<S>,
    /// The acceleration of its origin.
    acceleration: Vector<S>,
    gravity: Vector<S>,
    /// The twists of the six joints, linear over angular.
    twists: Vec<Vec<S>>,
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
        let terms = second.iter().map(|(by, own)| (*by, own));
        let bend = Columns::combination(qdd.iter().cloned().zip(&first).chain(terms));
        let twist = |m: &Columns<S>| back(&m.origin).into_iter().chain(turn(m)).collect();
        Base {
            omega: turn(&rate),
            omega_dot: turn(&bend),
            acceleration: back(&bend.origin),
            gravity: back(&arm.gravity),
            twists: first.iter().map(twist).collect(),
        }
    }

    /// Returns the loads of the six joints under a wrench on the base, over τ.
    fn felt(&self, loads: &[S]) -> Vec<S> {
        let felt = products(&self.twists, &loads[..6]);
        felt.into_iter().chain(loads[6..].iter().cloned()).collect()
    }
}

fn floating(limbs: &Arm<S>, draw: &mut Draw, round: usize) {
    let n = limbs.links.len();
    let trunk = Link {
        parent: None,
        armature: S::zero(),
        friction: Friction::none(),
        theta: SinCosPair::straight(),
        d: S::zero(),
        kind: JointKind::Revolute,
        ..draw.link(0)
    };
    let mut whole = limbs.clone();
    whole.links = carriers(&trunk);
    for (i, link) in limbs.links.iter().enumerate() {
        let carrier = limbs.carrier(i).map_or(5, |carrier| 6 + carrier);
        let parent = (carrier + 1 != 6 + i).then_some(Parent::Row(carrier));
        whole.links.push(Link {
            parent,
            ..link.clone()
        });
    }
    let position = draw.position(&whole.links);
    let joints = position[6..].to_vec();
    let dh = whole.at(&position);
    let [qd, qdd] = [(); 2].map(|()| draw.values(6 + n));
    let written = LagrangeEuler::new(&whole, &dh);
    let expected = written.inverse_dynamics(&qd, &qdd);
    let base = Base::of(&whole, &dh, [&qd, &qdd]);
    let skeleton = &Skeleton {
        base: Some(Body::of(&trunk)),
        ..Skeleton::new(limbs, &vec![None; n])
    };
    let regrouping = draw.regrouping(skeleton);
    let chain = |gravity: Vector<S>| {
        let base_gravity = Skeleton {
            gravity,
            ..skeleton.clone()
        };
        let mut chain = Chain::new(&base_gravity, &regrouping);
        chain.spin = [base.omega, base.omega_dot];
        chain
    };
    let moved = chain(difference(&base.gravity, &base.acceleration));
    let (posed, at) = moved.posed(&joints);
    let (rates, accelerations) = (&qd[6..], &qdd[6..]);
    for spin in SPINS {
        for couple in COUPLES {
            let found = posed.floating_dynamics(&at, rates, accelerations, spin, couple);
            assert_eq!(
                fields(&base.felt(&found)),
                fields(&expected),
                "{round} {spin:?}"
            );
        }
    }
    let composite = Composite::new(&posed, &at);
    for travel in TRAVELS {
        let d = composite.floating_inertia(travel);
        let half: Vec<Vec<S>> = d.iter().map(|row| base.felt(row)).collect();
        let full: Vec<Vec<S>> = columns_of(&half).iter().map(|row| base.felt(row)).collect();
        assert_eq!(flat(&full), flat(&written.inertia()), "{round} D");
    }
    let (spin, couple) = (SPINS[0], COUPLES[0]);
    let loads = posed.floating_dynamics(&at, rates, accelerations, spin, couple);
    let still = chain(base.gravity);
    let (still, at_rest) = still.posed(&joints);
    let found_of = |how: Solving| {
        let form = (spin, couple, TRAVELS[0]);
        still.floating_forward(&at_rest, rates, &loads, form, how)
    };
    let wanted = base.acceleration.iter().chain(&base.omega_dot);
    let wanted: Vec<S> = wanted.chain(accelerations).cloned().collect();
    for how in 0..8 {
        let how = Solving {
            angular_last: how & 1 > 0,
            unknowns: [Unknowns::Joints, Unknowns::AgainstBase][how >> 1 & 1],
            reference: how & 4 > 0,
        };
        assert_eq!(fields(&found_of(how)), fields(&wanted), "{round} {how:?}");
    }
    floating_slopes(&moved, &joints, [rates, accelerations], round);
}

fn floating_slopes(chain: &Chain<S>, position: &Position, [qd, qdd]: [&[S]; 2], round: usize) {
    let n = qd.len();
    let (posed, at) = chain.posed(position);
    let chain = dual(chain);
    let (spin, couple) = (SPINS[0], COUPLES[0]);
    let loads = |chain: &Chain<Dual<S>>, position: &[JointPosition<Dual<S>>], qd: &[Dual<S>]| {
        let (posed, at) = chain.posed(position);
        rates(posed.floating_dynamics(&at, qd, &constants(qdd), spin, couple))
    };
    let rest = moving(position, None);
    for travel in TRAVELS {
        let found = Composite::new(&posed, &at).floating_slopes(qd, qdd, travel);
        let by_position = |k: usize| loads(&chain, &moving(position, Some(k)), &constants(qd));
        let by_velocity = |k: usize| loads(&chain, &rest, &growing(qd, k));
        let by_omega = |k: usize| {
            let mut turning = chain.clone();
            turning.spin[0][k].rate = S::one();
            loads(&turning, &rest, &constants(qd))
        };
        let [position, velocity, omega] = found.each_ref().map(|slopes| flat(slopes));
        assert_eq!(position, columns(n, by_position), "{round} by q");
        assert_eq!(velocity, columns(n, by_velocity), "{round} by q̇");
        assert_eq!(omega, columns(3, by_omega), "{round} by ω");
    }
}
