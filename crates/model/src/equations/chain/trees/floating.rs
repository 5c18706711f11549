//! Trees on a base that floats: six joints on links without mass, but for the last.

use super::*;

#[test]
fn floating_trees_move_as_lagrange_and_euler_say() {
    let mut draw = Draw(Points::new(0xf10a7));
    for round in 0..20 {
        let skeleton = draw.skeleton(round % 5, true);
        floating(&skeleton, &mut draw, round);
    }
}

/// The base as six joints on links without mass, but for the last: slides along x, y and z, turns
/// about z, x and y.
fn carriers(body: &Body<S>) -> Vec<ChainLink<S>> {
    let link = |k: usize| {
        let slides = k < 3;
        let axis = if slides { identity()[k] } else { unit_z() };
        let cycle: Rotation<S> = three(|i| identity()[(i + 2) % 3]);
        ChainLink {
            parent: k.checked_sub(1),
            kind: match slides {
                true => JointKind::Prismatic,
                false => JointKind::Revolute,
            },
            rotation: if k <= 3 { identity() } else { cycle },
            offset: zero_vector(),
            axis,
            theta: SinCosPair::straight(),
            body: if k == 5 { body.clone() } else { Body::zero() },
            probes: Vec::new(),
            free: zero_vector(),
            armature: S::zero(),
            friction: Friction::none(),
            spins_freely: false,
            axes: 0,
        }
    };
    (0..6).map(link).collect()
}

/// The motion of a base in its axes.
struct Base {
    omega: Vector<S>,
    omega_dot: Vector<S>,
    /// Of the origin.
    acceleration: Vector<S>,
    gravity: Vector<S>,
    /// The twists of the six joints, linear over angular.
    twists: Vec<Vec<S>>,
}

impl Base {
    fn of(position: &[JointPosition<S>], qd: &[S], qdd: &[S], gravity: &Vector<S>) -> Base {
        let links = carriers(&Body::zero());
        let pose = |derived: &[usize]| {
            (0..6).fold(Columns::identity(), |m, i| {
                let (link, at) = (&links[i], &position[i]);
                let joint = Joint { link, at };
                let times = derived.iter().filter(|by| **by == i);
                times.fold(joint.append(&m), |m, _| joint.derive(&m))
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
            gravity: back(gravity),
            twists: first.iter().map(twist).collect(),
        }
    }

    /// Returns what the six joints feel of a wrench on the base, over τ.
    fn felt(&self, loads: &[S]) -> Vec<S> {
        let felt = product_of(&self.twists, &loads[..6]);
        felt.into_iter().chain(loads[6..].iter().cloned()).collect()
    }
}

fn floating(skeleton: &Skeleton<S>, draw: &mut Draw, round: usize) {
    let n = skeleton.links.len();
    let body = skeleton.base.as_ref().expect("a base that floats");
    let mut position: Position = (0..6)
        .map(|k| match k < 3 {
            true => JointPosition::Prismatic(draw.value()),
            false => JointPosition::Revolute(draw.angle()),
        })
        .collect();
    let joints = draw.position(skeleton);
    position.extend(joints.iter().cloned());
    let [qd, qdd] = [(); 2].map(|()| draw.values(6 + n));
    let trunk = carriers(body);
    let limbs = skeleton.links.iter().map(|own| ChainLink {
        parent: Some(own.link.parent.map_or(5, |parent| 6 + parent)),
        ..own.link.clone()
    });
    let all: Vec<ChainLink<S>> = trunk.into_iter().chain(limbs).collect();
    let links: Vec<&ChainLink<S>> = all.iter().collect();
    let written = LagrangeEuler::of(&links, &position, &skeleton.gravity);
    let mut expected = written.torques(&qd, &qdd);
    for (torque, own) in expected[6..].iter_mut().zip(friction(skeleton, &qd[6..])) {
        *torque = plus(torque, &own);
    }
    let base = Base::of(&position[..6], &qd[..6], &qdd[..6], &skeleton.gravity);
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
        assert_eq!(flat(&full), flat(&written.inertia), "{round} D");
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
