//! The registry of outputs: what there is, and identities of its formulas that
//! hold for every arm, checked exactly in the prime field.

use crate::equations_support::random::{Case, case, kinds, pair, pose};
use dalembert_model::equations::chain::Body;
use dalembert_model::equations::frames::NamedFrame;
use dalembert_model::equations::regressor::{Column, LinkParameter, of_links};
use dalembert_model::equations::{Arm, DhVariables, Formulation};
use dalembert_model::outputs::{Argument, Axis, Function, Motion, Quantity, Sizes, Written};
use dalembert_model::robot::{Convention, Inertia, JointKind};
use dalembert_model::scalar::dual::Dual;
use dalembert_model::scalar::field::{Field, Points};
use dalembert_model::scalar::{Divide, Scalar};

/// Every function with its arguments, and its results' axes for six joints and
/// 36 base parameters.
const GOLDEN: [&str; 35] = [
    "inverse_dynamics(q, qd, qdd) -> tau[6]",
    "gravity(q) -> c[6]",
    "inertia(q) -> d[6][6]",
    "coriolis(q, qd) -> h[6]",
    "manipulator_equation(q, qd) -> d[6][6] h[6] c[6]",
    "dynamic_coefficients(q) -> d[6][6] h[6][6][6] c[6]",
    "kinetic_energy(q, qd) -> kinetic",
    "potential_energy(q) -> potential",
    "momentum(q, qd) -> p[6] ct_qd[6]",
    "coriolis_matrix(q, qd) -> c_matrix[6][6]",
    "dalembert_terms(q, qd) -> d_rot[6][6] d_tran[6][6] h_rot[6] h_tran[6] c[6]",
    "forward_kinematics(q) -> pose[3][4]",
    "link_poses(q) -> poses[6][3][4]",
    "jacobian(q) -> jacobian[6][6]",
    "jacobian_rate(q, qd) -> jacobian_rate[6]",
    "reaction_wrenches(q, qd, qdd) -> wrenches[6][6]",
    "inverse_dynamics_derivatives(q, qd, qdd) -> dtau_dq[6][6] dtau_dqd[6][6] d[6][6]",
    "passivity(q, qd, v, a) -> tau[6]",
    "forward_dynamics(q, qd, tau) -> qdd[6]",
    "inertia_inverse(q) -> d_inv[6][6]",
    "forward_dynamics_derivatives(q, qd, tau) -> dqdd_dq[6][6] dqdd_dqd[6][6] dqdd_dtau[6][6]",
    "regressor(q, qd, qdd) -> y[6][36]",
    "full_regressor(q, qd, qdd) -> y[6][60]",
    "passivity_regressor(q, qd, v, a) -> y[6][36]",
    "momentum_observer(q, qd) -> p[6] drift[6]",
    "inverse_dynamics_with_wrench(q, qd, qdd, wrench) -> tau[6]",
    "forward_dynamics_with_wrench(q, qd, tau, wrench) -> qdd[6]",
    "contact_wrench(q, tau, damping) -> contact_wrench[6]",
    "operational_inertia_inverse(q) -> operational_inertia_inverse[6][6]",
    "operational_inertia(q, damping) -> operational_inertia[6][6]",
    "consistent_inverse(q, damping) -> consistent_inverse[6][6]",
    "operational_bias(q, qd, damping) -> operational_bias[6]",
    "null_space_projector(q, damping) -> null_space[6][6]",
    "inverse_dynamics_second_derivatives(q, qd, qdd, multiplier) -> \
     d2tau_dq_dq[6][6] d2tau_dq_dqd[6][6] d2tau_dqd_dqd[6][6] d2tau_dqdd_dq[6][6]",
    "forward_dynamics_second_derivatives(q, qd, tau, multiplier) -> \
     d2qdd_dq_dq[6][6] d2qdd_dq_dqd[6][6] d2qdd_dqd_dqd[6][6] d2qdd_dtau_dq[6][6]",
];

#[test]
fn golden_list() {
    let sizes = Sizes {
        base: 36,
        ..Sizes::whole(6)
    };
    let said = |function: &Function| {
        let arguments: Vec<&str> = function.arguments().iter().map(|a| a.name()).collect();
        let result = |q: &Quantity| {
            let lengths = q.shape().lengths(sizes).map(|length| format!("[{length}]"));
            format!(" {}{}", q.field(), lengths.collect::<String>())
        };
        let results: String = function.quantities().iter().map(result).collect();
        format!("{function}({}) ->{results}", arguments.join(", "))
    };
    let found: Vec<String> = Function::ALL.iter().map(said).collect();
    assert_eq!(found, GOLDEN);
    let fields = Function::ALL.map(|function| {
        let mut fields: Vec<_> = function.quantities().iter().map(|q| q.field()).collect();
        fields.dedup();
        fields.len() == function.quantities().len()
            && (fields.len() > 1) == function.structure().is_some()
    });
    assert!(fields.iter().all(|fits| *fits));
    // What a controller calls.
    let by_default = [
        Function::InverseDynamics,
        Function::Gravity,
        Function::Inertia,
        Function::Coriolis,
        Function::ForwardKinematics,
        Function::Jacobian,
        Function::ForwardDynamics,
    ];
    assert_eq!(Function::by_default(), by_default);
}

/// Every kind pattern up to three joints, then one of six, then links with a
/// turn about y; all of them again with a base and a tool.
fn cases() -> Vec<Case> {
    let mut points = Points::new(0x6f75);
    let mut cases = Vec::new();
    for convention in [Convention::Standard, Convention::Modified] {
        for n in 1..=3 {
            for bits in 0..1 << n {
                cases.push(case(convention, &kinds(n, bits), &mut points));
            }
        }
        cases.push(case(convention, &kinds(6, 0b001010), &mut points));
    }
    // Nearly parallel axes: the turn about y that only standard DH has.
    for bits in [0b00, 0b01, 0b10] {
        let mut tilted = case(Convention::Standard, &kinds(3, bits), &mut points);
        for link in &mut tilted.arm.links {
            link.beta = Some(pair(&mut points));
        }
        cases.push(tilted);
    }
    for at in 0..cases.len() {
        let mut placed = cases[at].clone();
        placed.arm.base = Some(pose(&mut points));
        placed.arm.tool = Some(pose(&mut points));
        cases.push(placed);
    }
    cases
}

/// Formulations share as little as they can: for each quantity all of them
/// give what Lagrange–Euler gives.
#[test]
fn formulations_agree_on_every_quantity() {
    for case in cases() {
        let mut points = Points::new(7);
        let mut motion = Motion::new(Vec::new(), |argument| match argument {
            Argument::Velocity => case.qd.clone(),
            Argument::Acceleration => case.qdd.clone(),
            other => entries(other, case.qd.len(), &mut points),
        });
        motion.moves = vec![true; case.qd.len()];
        // Columns of bodies that no parameter has by itself, and of drives.
        let columns = columns(&case, &mut points);
        for &quantity in Quantity::ALL {
            let by = |formulation| {
                quantity.written(&Written {
                    formulation,
                    arm: &case.arm,
                    at: &case.at,
                    motion: &motion,
                    columns: &columns,
                })
            };
            let n = case.arm.links.len();
            let expected = by(Formulation::LagrangeEuler);
            let sizes = Sizes {
                base: columns.len(),
                ..Sizes::whole(n)
            };
            assert_eq!(expected.len(), quantity.len(sizes), "{quantity:?}");
            assert!(expected.iter().any(|x| *x != Field::zero()) || n < 6);
            for formulation in Formulation::ALL {
                assert_eq!(by(formulation), expected, "{quantity:?} {formulation:?}");
            }
        }
    }
}

/// Entries of an argument of an arm of n joints.
fn entries(argument: Argument, n: usize, points: &mut Points) -> Vec<Field> {
    let length = argument.length(Sizes::whole(n));
    (0..length).map(|_| points.field()).collect()
}

/// As many columns as a full regressor has.
fn columns(case: &Case, points: &mut Points) -> Vec<Column<Field>> {
    let n = case.arm.links.len();
    let mut columns = of_links(n);
    for (joint, place) in [(0, 3), (n - 1, 7)] {
        let mut any = || points.field();
        columns[10 * joint + place] = Column::Body {
            joint,
            body: Body {
                mass: any(),
                first: [any(), any(), any()],
                second: Inertia {
                    xx: any(),
                    yy: any(),
                    zz: any(),
                    xy: any(),
                    yz: any(),
                    xz: any(),
                },
            },
        };
    }
    (columns[4], columns[5]) = (Column::Armature(n - 1), Column::Viscous(0));
    columns
}

/// τ = Y π and D a + C v + c + b∘v = Y π with π of the links, and what the drives add.
#[test]
fn regressors_give_the_torques() {
    let mut points = Points::new(0x7265);
    let (exact, recursion) = (Formulation::LagrangeEuler, Formulation::NewtonEulerLink);
    for case in cases() {
        let Case { arm, at, qd, qdd } = &case;
        let columns = of_links(arm.links.len());
        let tau = exact.inverse_dynamics(arm, at, qd, qdd);
        let y = recursion.regressor(arm, at, qd, qdd, &columns);
        assert_eq!(products(arm, &y, [qd, qdd]), tau);
        let mut wished = || -> Vec<Field> { qd.iter().map(|_| points.field()).collect() };
        let (v, a) = (wished(), wished());
        let tau = exact.passivity(arm, at, qd, [&v, &a]);
        let y = recursion.passivity_regressor(arm, at, qd, [&v, &a], &columns);
        assert_eq!(products(arm, &y, [&v, &a]), tau);
    }
}

/// Y π of the links, and what friction and rotors take at these rates.
fn products(
    arm: &Arm<Field>,
    y: &[Vec<Field>],
    [rates, accelerations]: [&[Field]; 2],
) -> Vec<Field> {
    let links = arm.links.iter();
    let pi: Vec<Field> = links
        .flat_map(|link| LinkParameter::ALL.map(|parameter| parameter.of(link)))
        .collect();
    let sum = |(i, row): (usize, &Vec<Field>)| {
        let products = row.iter().zip(&pi).map(|(y, pi)| y.mul(pi));
        let links = products.fold(Field::ZERO, |sum, x| sum.add(&x));
        let link = &arm.links[i];
        let friction = link.friction.torque(&rates[i]);
        links.add(&friction.add(&link.armature.mul(&accelerations[i])))
    };
    y.iter().enumerate().map(sum).collect()
}
/// The arm and its position as they change at the case's velocities.
fn moving(case: &Case) -> (Arm<Dual<Field>>, Vec<DhVariables<Dual<Field>>>) {
    let links = case.arm.links.iter().zip(&case.at).zip(&case.qd);
    let at = links.map(|((link, at), rate)| {
        let turns = link.kind == JointKind::Revolute;
        let still = |x: &Field| Dual::constant(*x);
        DhVariables {
            theta: match turns {
                true => at.theta.clone().turning(rate),
                false => at.theta.map(still),
            },
            d: Dual {
                value: at.d,
                rate: if turns { Field::zero() } else { *rate },
            },
        }
    });
    (case.arm.map(|x| Dual::constant(*x)), at.collect())
}

/// Ḋ − 2C is skew, C q̇ = h, and ṗ = Ḋ q̇ + D q̈ obeys ṗ = τ + Cᵀ q̇ − c − b∘q̇.
#[test]
fn coriolis_matrix_is_the_christoffels() {
    for case in cases() {
        let Case { arm, at, qd, qdd } = &case;
        let n = arm.links.len();
        let form = Formulation::LagrangeEuler;
        let c = form.coriolis_matrix(arm, at, qd);
        let (arm_moving, at_moving) = moving(&case);
        let d = form.inertia(&arm_moving, &at_moving);
        let h = form.velocity_terms(arm, at, qd);
        let slope = form.momentum_slope(arm, at, qd);
        let tau = form.inverse_dynamics(arm, at, qd, qdd);
        let gravity = form.gravity(arm, at);
        for i in 0..n {
            let mut load = Field::zero();
            let mut rate = Field::zero();
            for k in 0..n {
                assert_eq!(d[i][k].rate, c[i][k].add(&c[k][i]));
                load = load.add(&c[i][k].mul(&qd[k]));
                let own = d[i][k].rate.mul(&qd[k]);
                rate = rate.add(&own.add(&d[i][k].value.mul(&qdd[k])));
            }
            assert_eq!(load, h[i]);
            let damping = arm.links[i].friction.torque(&qd[i]);
            let rest = tau[i].add(&slope[i]).sub(&gravity[i]).sub(&damping);
            assert_eq!(rate, rest);
        }
    }
}

/// ∂U/∂q = c, and the wrenches' parts along the joints are the torques.
#[test]
fn energy_and_wrenches_belong_to_the_torques() {
    for case in cases() {
        let Case { arm, at, qd, qdd } = &case;
        let form = Formulation::NewtonEulerLink;
        let c = form.gravity(arm, at);
        let tau = form.inverse_dynamics(arm, at, qd, qdd);
        let wrenches = form.wrenches(arm, at, qd, qdd);
        let jacobian_axes = dalembert_model::equations::kinematics::poses(arm, at);
        let base = arm.base.as_ref().map(|base| base.axes[2]);
        let first = base.unwrap_or([Field::zero(), Field::zero(), Field::one()]);
        let (arm_moving, at_moving) = moving(&case);
        let power = form.potential_energy(&arm_moving, &at_moving).rate;
        let of_c = c
            .iter()
            .zip(qd)
            .fold(Field::zero(), |sum, (c, qd)| sum.add(&c.mul(qd)));
        assert_eq!(power, of_c);
        for (i, link) in arm.links.iter().enumerate() {
            let axis = match (arm.convention, i) {
                (Convention::Standard, 0) => first,
                (Convention::Standard, _) => jacobian_axes[i - 1].axes[2],
                (Convention::Modified, _) => jacobian_axes[i].axes[2],
            };
            let load = match link.kind {
                JointKind::Revolute => &wrenches[i].moment,
                JointKind::Prismatic => &wrenches[i].force,
            };
            let along = (0..3).fold(Field::zero(), |sum, k| sum.add(&axis[k].mul(&load[k])));
            let drive = link
                .friction
                .torque(&qd[i])
                .add(&link.armature.mul(&qdd[i]));
            assert_eq!(along.add(&drive), tau[i]);
        }
    }
}

/// The case with torques, where only some joints move.
fn driven(case: &Case, moves: &[bool], points: &mut Points) -> Motion<Field> {
    let held = |values: &[Field]| -> Vec<Field> {
        let values = values.iter().zip(moves);
        let held = values.map(|(x, moves)| if *moves { *x } else { Field::zero() });
        held.collect()
    };
    let mut motion = Motion::new(Vec::new(), |argument| match argument {
        Argument::Velocity => held(&case.qd),
        other => entries(other, case.qd.len(), points),
    });
    motion.moves = moves.to_vec();
    motion
}

/// D q̈ + h + c + b∘q̇ = τ and D D⁻¹ = 1 over the joints that move, whichever
/// do, of every formulation; what is held does not move, and a residual of
/// anything else does not vanish.
#[test]
fn forward_dynamics_solves_the_equations_of_motion() {
    let mut points = Points::new(0x6664);
    for case in cases() {
        let n = case.arm.links.len();
        for bits in 1..1u32 << n.min(4) {
            let moves: Vec<bool> = (0..n).map(|i| i >= 4 || bits >> i & 1 == 1).collect();
            let motion = driven(&case, &moves, &mut points);
            let inverting = Quantity::ALL.iter().filter(|q| q.inverts_inertia());
            for &quantity in inverting {
                let written = |formulation| Written {
                    formulation,
                    arm: &case.arm,
                    at: &case.at,
                    motion: &motion,
                    columns: &[],
                };
                let expected = quantity.written(&written(Formulation::LagrangeEuler));
                let recursion = written(Formulation::NewtonEulerLink);
                assert_eq!(
                    quantity.written(&recursion),
                    expected,
                    "{quantity:?} {moves:?}"
                );
                let residual = quantity.residual(&recursion, &expected);
                assert!(residual.iter().all(|x| *x == Field::zero()));
                let wrong: Vec<Field> = expected.iter().map(|x| x.add(&Field::ONE)).collect();
                let residual = quantity.residual(&recursion, &wrong);
                assert!(residual.is_empty() || residual.iter().any(|x| *x != Field::zero()));
                if quantity.shape().0[0] != Axis::Joints {
                    continue;
                }
                for (index, value) in expected.iter().enumerate() {
                    let row = index / (expected.len() / n);
                    assert!(moves[row] || *value == Field::zero());
                }
            }
        }
    }
}

/// Velocities at which every joint's r is 1/√(q̇² + w²): with a tangent t of half an
/// angle q̇ is w 2t/(1 − t²), and r is (1 − t²)/(w (1 + t²)).
fn at_true_speeds(case: &mut Case, points: &mut Points) {
    for (link, qd) in case.arm.links.iter_mut().zip(&mut case.qd) {
        let Some(coulomb) = &mut link.friction.coulomb else {
            continue;
        };
        let (one, t) = (Field::one(), points.field());
        let [more, less] = [one.add(&t.mul(&t)), one.sub(&t.mul(&t))];
        *qd = coulomb.width.mul(&t.double()).div(&less);
        coulomb.per_speed = less.div(&coulomb.width.mul(&more));
    }
}

/// The arm, its position and its velocities as they change at the case's velocities and
/// accelerations.
type Accelerating = (
    Arm<Dual<Field>>,
    Vec<DhVariables<Dual<Field>>>,
    Vec<Dual<Field>>,
);

/// The r of Coulomb friction changes by −q̇ r³ q̈, as 1/√(q̇² + w²) does.
fn accelerating(case: &Case) -> Accelerating {
    let (mut arm, at) = moving(case);
    for (link, (qd, qdd)) in arm.links.iter_mut().zip(case.qd.iter().zip(&case.qdd)) {
        let r = &mut link.friction.coulomb.as_mut().unwrap().per_speed;
        let cube = r.value.mul(&r.value).mul(&r.value);
        r.rate = qd.mul(&cube).mul(qdd).neg();
    }
    let rates = case.qd.iter().zip(&case.qdd);
    let qd = rates.map(|(value, rate)| Dual {
        value: *value,
        rate: *rate,
    });
    (arm, at, qd.collect())
}

/// ∂q̈/∂q and ∂q̈/∂q̇ are the slopes of q̈ itself: its rate along the motion, with
/// q̇ for the rate of q and q̈ for that of q̇.
#[test]
fn acceleration_slopes_are_its_rates() {
    let mut points = Points::new(0x736c);
    for mut case in cases() {
        at_true_speeds(&mut case, &mut points);
        let n = case.arm.links.len();
        let moves = vec![true; n];
        let motion = driven(&case, &moves, &mut points);
        let form = Formulation::LagrangeEuler;
        let (arm_moving, at_moving, qd) = accelerating(&case);
        let tau: Vec<_> = motion.tau.iter().copied().map(Dual::constant).collect();
        let whole = form.forward_dynamics(&arm_moving, &at_moving, &qd, &tau, &moves);
        let [by_position, by_velocity] =
            form.acceleration_slopes(&case.arm, &case.at, &case.qd, &motion.tau, &moves);
        for i in 0..n {
            let rate = (0..n).fold(Field::zero(), |rate, k| {
                let position = by_position[i][k].mul(&case.qd[k]);
                rate.add(&position.add(&by_velocity[i][k].mul(&case.qdd[k])))
            });
            assert_eq!(rate, whole[i].rate);
        }
    }
}

/// The second derivatives of λᵀτ and of λᵀq̈ are the rates of λᵀ times the first along the
/// motion, which differentiates other formulas than their own.
#[test]
fn second_derivatives_are_rates_of_slopes() {
    let mut points = Points::new(0x3264);
    for mut case in cases() {
        at_true_speeds(&mut case, &mut points);
        let n = case.arm.links.len();
        let moves = vec![true; n];
        let motion = driven(&case, &moves, &mut points);
        let second = |quantity: Quantity| {
            quantity.written(&Written {
                formulation: Formulation::NewtonEulerLink,
                arm: &case.arm,
                at: &case.at,
                motion: &motion,
                columns: &[],
            })
        };
        let (arm, at, qd) = accelerating(&case);
        let constants = |x: &[Field]| x.iter().copied().map(Dual::constant).collect::<Vec<_>>();
        let [qdd, tau] = [&motion.qdd, &motion.tau].map(|x| constants(x));
        let form = Formulation::Dalembert;
        let [q_slopes, v_slopes] = form.acceleration_slopes(&arm, &at, &qd, &tau, &moves);
        for (first, by_position, by_velocity) in [
            (
                form.torque_by_position(&arm, &at, &qd, &qdd),
                (Quantity::TorqueByPositions, false),
                Some((Quantity::TorqueByPositionAndVelocity, false)),
            ),
            (
                form.torque_by_velocity(&arm, &at, &qd),
                (Quantity::TorqueByPositionAndVelocity, true),
                Some((Quantity::TorqueByVelocities, false)),
            ),
            (
                form.inertia(&arm, &at),
                (Quantity::TorqueByAccelerationAndPosition, false),
                None,
            ),
            (
                q_slopes,
                (Quantity::AccelerationByPositions, false),
                Some((Quantity::AccelerationByPositionAndVelocity, false)),
            ),
            (
                v_slopes,
                (Quantity::AccelerationByPositionAndVelocity, true),
                Some((Quantity::AccelerationByVelocities, false)),
            ),
            (
                form.inertia_inverse(&arm, &at, &moves),
                (Quantity::AccelerationByTorqueAndPosition, false),
                None,
            ),
        ] {
            // Row k of a matrix, or of its transpose, times what changes.
            let along = |(quantity, transposed): (Quantity, bool), rates: &[Field]| {
                let entries = second(quantity);
                let entry = |k: usize, m: usize| match transposed {
                    false => entries[k * n + m],
                    true => entries[m * n + k],
                };
                let row = |k| {
                    let products = rates
                        .iter()
                        .enumerate()
                        .map(move |(m, x)| entry(k, m).mul(x));
                    products.fold(Field::ZERO, |sum, x| sum.add(&x))
                };
                (0..n).map(row).collect::<Vec<Field>>()
            };
            let position = along(by_position, &case.qd);
            let velocity = by_velocity.map(|of| along(of, &case.qdd));
            for k in 0..n {
                let rows = first.iter().zip(&motion.multiplier);
                let rate = rows.fold(Field::ZERO, |sum, (row, l)| sum.add(&row[k].rate.mul(l)));
                let other = velocity.as_ref().map_or(Field::ZERO, |all| all[k]);
                assert_eq!(position[k].add(&other), rate, "{by_position:?} {k}");
            }
        }
    }
}

/// An arm with frames on its links: `inner` on the first, `outer` on the last, and each
/// link's own.
fn with_frames(case: &Case, points: &mut Points) -> Arm<Field> {
    let last = case.arm.links.len() - 1;
    let mut arm = case.arm.clone();
    arm.frames.named = [("inner", 0), ("outer", last)]
        .map(|(name, joint)| NamedFrame {
            name: name.to_string(),
            joint,
            pose: pose(points),
        })
        .to_vec();
    arm.frames.links = arm.links.iter().map(|_| Some(pose(points))).collect();
    arm
}

/// Values of a text's only quantity.
fn at_frame(text: &str, arm: &Arm<Field>, case: &Case, motion: &Motion<Field>) -> Vec<Field> {
    let written = Written {
        formulation: Formulation::LagrangeEuler,
        arm,
        at: &case.at,
        motion,
        columns: &[],
    };
    let function = Function::parse(text).unwrap();
    let expected = function.quantities()[0].written(&written);
    assert_eq!(
        expected.len(),
        function.outputs(Sizes::whole(arm.links.len())),
        "{text}"
    );
    for formulation in Formulation::ALL {
        let by = Written {
            formulation,
            ..written
        };
        assert_eq!(
            function.quantities()[0].written(&by),
            expected,
            "{text} {formulation:?}"
        );
    }
    expected
}

fn matrix_product(a: &[Field], b: &[Field], inner: usize) -> Vec<Field> {
    let columns = b.len() / inner;
    let entry = |row: &[Field], k: usize| {
        (0..inner).fold(Field::ZERO, |sum, j| {
            sum.add(&row[j].mul(&b[j * columns + k]))
        })
    };
    let rows = a.chunks(inner);
    rows.flat_map(|row| (0..columns).map(move |k| entry(row, k)))
        .collect()
}

/// Every formulation agrees at every frame, in all axes and of chosen components; a frame
/// on the last link is a tool, joints behind a frame do not move it, the rate of J q̇ is
/// J̇ q̇, and velocities and wrenches do the same work in all axes.
#[test]
fn frames_are_hands_in_other_places() {
    let mut points = Points::new(0x6672);
    for case in cases() {
        let n = case.arm.links.len();
        let arm = with_frames(&case, &mut points);
        let motion = driven(&case, &vec![true; n], &mut points);
        let of = |text: &str, arm: &Arm<Field>| at_frame(text, arm, &case, &motion);
        let mut tooled = arm.clone();
        tooled.tool = Some(arm.frames.named[1].pose.clone());
        for name in ["forward_kinematics", "jacobian", "jacobian_rate"] {
            assert_eq!(of(&format!("{name}@outer"), &arm), of(name, &tooled));
            assert_eq!(of(&format!("{name}@hand"), &arm), of(name, &arm));
        }
        let inner = of("jacobian@inner", &arm);
        assert!(
            inner
                .chunks(n)
                .all(|row| row[1..].iter().all(|x| *x == Field::ZERO))
        );
        let moving_arm = arm.map(|x| Dual::constant(*x));
        let (_, moving_at) = moving(&case);
        for axes in ["mixed", "local", "world"] {
            for frame in ["inner", "outer"] {
                let view = format!("@{frame}:{axes}");
                let j = of(&format!("jacobian{view}"), &arm);
                let some = of(&format!("jacobian{view}:x_rz"), &arm);
                assert_eq!(some, [&j[..n], &j[5 * n..]].concat());
                // J̇ q̇ is what J q̇ changes by.
                let seen = Function::parse(&format!("jacobian{view}")).unwrap();
                let Quantity::At(seen) = seen.quantities()[0] else {
                    panic!("a frame");
                };
                let seen = moving_arm.seen(&seen.view()).unwrap();
                let rates = Formulation::LagrangeEuler.jacobian(&seen, &moving_at);
                let rates = rates.iter().map(|row| {
                    let products = row.iter().zip(&case.qd).map(|(j, qd)| j.rate.mul(qd));
                    products.fold(Field::ZERO, |sum, x| sum.add(&x))
                });
                let rates: Vec<Field> = rates.collect();
                assert_eq!(of(&format!("jacobian_rate{view}"), &arm), rates, "{view}");
                let torques = matrix_product(&motion.wrench, &j, 6);
                let with = of(&format!("inverse_dynamics_with_wrench{view}"), &arm);
                let without = of("inverse_dynamics", &arm);
                for ((with, without), torque) in with.iter().zip(&without).zip(&torques) {
                    assert_eq!(with.add(torque), *without);
                }
            }
        }
    }
}

/// Λ⁻¹, Λ, J̄, N, μ and the wrench of torques are made of J, D⁻¹ and each other as their
/// names say, at frames and of chosen components.
#[test]
fn operational_space_fits_together() {
    let mut points = Points::new(0x6f70);
    for case in cases() {
        let n = case.arm.links.len();
        let arm = with_frames(&case, &mut points);
        let motion = driven(&case, &vec![true; n], &mut points);
        let damping = motion.damping[0];
        for (view, m) in [
            ("@outer", 6),
            ("@outer:local:x_y_rz", 3),
            ("@inner:world:angular", 3),
        ] {
            let of = |name: &str| at_frame(&format!("{name}{view}"), &arm, &case, &motion);
            let (j, rate) = (of("jacobian"), of("jacobian_rate"));
            let mobility = of("operational_inertia_inverse");
            let inertia = of("operational_inertia");
            let inverse = of("consistent_inverse");
            let d_inv = at_frame("inertia_inverse", &arm, &case, &motion);
            let transposed: Vec<Field> = (0..n * m).map(|at| j[at % m * n + at / m]).collect();
            let reached = matrix_product(&d_inv, &transposed, n);
            assert_eq!(matrix_product(&j, &reached, n), mobility);
            assert_eq!(matrix_product(&reached, &inertia, m), inverse);
            let mut damped = mobility;
            (0..m).for_each(|i| damped[i * m + i] = damped[i * m + i].add(&damping));
            let one = |n: usize| -> Vec<Field> {
                let entry = |at: usize| {
                    if at.is_multiple_of(n + 1) {
                        Field::ONE
                    } else {
                        Field::ZERO
                    }
                };
                (0..n * n).map(entry).collect()
            };
            assert_eq!(matrix_product(&inertia, &damped, m), one(m));
            let mut projector = matrix_product(&inverse, &j, m);
            for (entry, one) in projector.iter_mut().zip(one(n)) {
                *entry = one.sub(entry);
            }
            assert_eq!(of("null_space_projector"), projector);
            // μ, with what the joints are loaded with at this velocity.
            let mut still = arm.clone().without_friction();
            still.frames = arm.frames.clone();
            let rest = vec![Field::ZERO; n];
            let exact = Formulation::LagrangeEuler;
            let loads = exact.inverse_dynamics(&still, &case.at, &motion.qd, &rest);
            let driven = matrix_product(&j, &matrix_product(&d_inv, &loads, n), n);
            let rest: Vec<Field> = driven.iter().zip(&rate).map(|(a, b)| a.sub(b)).collect();
            assert_eq!(of("operational_bias"), matrix_product(&inertia, &rest, m));
            // The wrench of its own torques, but for the damping.
            let torques = matrix_product(&transposed, &motion.wrench[..m], m);
            let pushed = Motion {
                tau: torques,
                ..motion.clone()
            };
            let found = at_frame(&format!("contact_wrench{view}"), &arm, &case, &pushed);
            let squared = matrix_product(&j, &transposed, n);
            let left: Vec<Field> = matrix_product(&squared, &found, m);
            let right = matrix_product(&squared, &motion.wrench[..m], m);
            for ((left, found), right) in left.iter().zip(&found).zip(&right) {
                assert_eq!(left.add(&damping.mul(found)), *right);
            }
        }
    }
}
