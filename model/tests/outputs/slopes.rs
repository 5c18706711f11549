//! First and second derivatives of torques and accelerations, against rates along a motion.

use super::*;

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

/// Returns the r of Coulomb friction changes by −q̇ r³ q̈, as 1/√(q̇² + w²) does.
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
