//! First and second derivatives of torques and accelerations, against rates along a motion.

use super::*;
use dalembert_model::equations::friction::Coulomb;

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

type Moving<S> = (Arm<S>, Vec<DhVariables<S>>, Vec<S>);

/// The r of Coulomb friction changes by −q̇ r³ q̈, as 1/√(q̇² + w²) does.
fn accelerating(case: &Case) -> Moving<Dual<Field>> {
    let (mut arm, at) = moving(case);
    for (link, (qd, qdd)) in arm.links.iter_mut().zip(case.qd.iter().zip(&case.qdd)) {
        let Some(Coulomb { per_speed: r, .. }) = &mut link.friction.coulomb else {
            continue;
        };
        let cube = r.value.mul(&r.value).mul(&r.value);
        r.rate = qd.mul(&cube).mul(qdd).neg();
    }
    let rates = case.qd.iter().zip(&case.qdd);
    let qd = rates.map(|(&value, &rate)| Dual { value, rate });
    (arm, at, qd.collect())
}

/// The rates of λᵀ times the first derivatives differentiate other formulas than the second ones.
#[test]
fn derivatives_are_rates_along_a_motion() {
    use Quantity::*;
    let mut points = Points::new(0x3264);
    for mut case in cases() {
        at_true_speeds(&mut case, &mut points);
        let n = case.arm.links.len();
        let moves = vec![true; n];
        let motion = driven(&case, &moves, &mut points);
        let (arm, at, qd) = accelerating(&case);
        let constants = |x: &[Field]| x.iter().copied().map(Dual::constant).collect::<Vec<_>>();
        let [qdd, tau] = [&motion.qdd, &motion.tau].map(|x| constants(x));
        let form = Formulation::Dalembert;
        let rates = |values: &[Dual<Field>]| values.iter().map(|x| x.rate).collect::<Vec<_>>();
        let weighed = |rows: &[Vec<Dual<Field>>]| -> Vec<Field> {
            let column = |k: usize| rows.iter().map(|row| row[k].rate).collect::<Vec<_>>();
            let sum = |k: usize| dot(&column(k), &motion.multiplier);
            (0..n).map(sum).collect()
        };
        let [q_slopes, v_slopes] = form.acceleration_slopes(&arm, &at, &qd, &tau, &moves);
        let torques = rates(&form.inverse_dynamics(&arm, &at, &qd, &qdd));
        let accelerations = rates(&form.forward_dynamics(&arm, &at, &qd, &tau, &moves));
        let by_position = weighed(&form.torque_by_position(&arm, &at, &qd, &qdd));
        let by_velocity = weighed(&form.torque_by_velocity(&arm, &at, &qd));
        let inertia = weighed(&form.inertia(&arm, &at));
        let inverse = weighed(&form.inertia_inverse(&arm, &at, &moves));
        let (q_slopes, v_slopes) = (weighed(&q_slopes), weighed(&v_slopes));
        let along = |quantity: Quantity, is_transposed: bool, rates: &[Field]| -> Vec<Field> {
            let form = Formulation::NewtonEulerLink;
            let entries = quantity.written(&written(form, &case, &motion, &[]));
            let place = |k: usize, m: usize| if is_transposed { m * n + k } else { k * n + m };
            let row = |k: usize| (0..n).map(|m| entries[place(k, m)]).collect::<Vec<_>>();
            (0..n).map(|k| dot(&row(k), rates)).collect()
        };
        let first = [torques, accelerations, by_position, by_velocity];
        let others = [inertia, q_slopes, v_slopes, inverse];
        let terms: [&[Quantity]; 8] = [
            &[TorqueByPosition, TorqueByVelocity],
            &[AccelerationByPosition, AccelerationByVelocity],
            &[TorqueByPositions, TorqueByPositionAndVelocity],
            &[TorqueByPositionAndVelocity, TorqueByVelocities],
            &[TorqueByAccelerationAndPosition],
            &[AccelerationByPositions, AccelerationByPositionAndVelocity],
            &[AccelerationByPositionAndVelocity, AccelerationByVelocities],
            &[AccelerationByTorqueAndPosition],
        ];
        for (terms, rates) in terms.iter().zip(first.into_iter().chain(others)) {
            // Slopes by velocity have their slopes by position in columns.
            let mixed = [
                TorqueByPositionAndVelocity,
                AccelerationByPositionAndVelocity,
            ];
            let is_mixed = mixed.contains(&terms[0]);
            let mut sum = along(terms[0], is_mixed, &case.qd);
            for quantity in &terms[1..] {
                let other = along(*quantity, false, &case.qdd);
                sum = sum.iter().zip(&other).map(|(a, b)| a.add(b)).collect();
            }
            assert_eq!(sum, rates, "{terms:?}");
        }
    }
}
