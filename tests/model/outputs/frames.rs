//! Quantities at named frames, and the operational space there.

use super::*;
use dalembert_model::equations::frames::NamedFrame;

fn with_frames(case: &Case, points: &mut Points) -> Arm<Field> {
    let last = case.arm.links.len() - 1;
    let mut arm = case.arm.clone();
    let mut named = |name: &str, joint: usize| {
        let (name, pose) = (name.to_string(), pose(points));
        NamedFrame { name, joint, pose }
    };
    arm.frames.named = vec![named("inner", 0), named("outer", last)];
    arm.frames.links = arm.links.iter().map(|_| Some(pose(points))).collect();
    arm
}

fn at_frame(text: &str, arm: &Arm<Field>, case: &Case, motion: &Motion<Field>) -> Vec<Field> {
    let mut case = case.clone();
    case.arm = arm.clone();
    let function = Function::parse(text).unwrap();
    let by =
        |formulation| function.quantities()[0].written(&written(formulation, &case, motion, &[]));
    let expected = by(Formulation::LagrangeEuler);
    let length = function.outputs(Sizes::whole(arm.links.len()));
    assert_eq!(expected.len(), length, "{text}");
    for formulation in Formulation::ALL {
        assert_eq!(by(formulation), expected, "{text} {formulation:?}");
    }
    expected
}

fn matrix_product(a: &[Field], b: &[Field], inner: usize) -> Vec<Field> {
    let columns = b.len() / inner;
    let column = |k: usize| b[k..].iter().step_by(columns).copied().collect::<Vec<_>>();
    let entry = |at: usize| {
        let row = at / columns * inner;
        dot(&a[row..row + inner], &column(at % columns))
    };
    (0..a.len() / inner * columns).map(entry).collect()
}

fn one(n: usize) -> Vec<Field> {
    let mut one = vec![Field::ZERO; n * n];
    (0..n).for_each(|i| one[i * (n + 1)] = Field::ONE);
    one
}

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
        let mut behind = inner.chunks(n).flat_map(|row| &row[1..]);
        assert!(behind.all(|x| *x == Field::ZERO));
        let moving_arm = arm.map(|x| Dual::constant(*x));
        let (_, moving_at) = moving(&case);
        for axes in ["mixed", "local", "world"] {
            for frame in ["inner", "outer"] {
                let view = format!("@{frame}:{axes}");
                let j = of(&format!("jacobian{view}"), &arm);
                let some = of(&format!("jacobian{view}:x_rz"), &arm);
                assert_eq!(some, [&j[..n], &j[5 * n..]].concat());
                let function = Function::parse(&format!("jacobian{view}")).unwrap();
                let Quantity::At(quantity) = function.quantities()[0] else {
                    panic!("a frame");
                };
                let frame_arm = moving_arm.seen(&quantity.view()).unwrap();
                let rates = Formulation::LagrangeEuler.jacobian(&frame_arm, &moving_at);
                let rate = |row: &Vec<Dual<Field>>| {
                    let row: Vec<Field> = row.iter().map(|j| j.rate).collect();
                    dot(&row, &case.qd)
                };
                let rates: Vec<Field> = rates.iter().map(rate).collect();
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
            assert_eq!(matrix_product(&inertia, &damped, m), one(m));
            let mut projector = matrix_product(&inverse, &j, m);
            for (entry, one) in projector.iter_mut().zip(one(n)) {
                *entry = one.sub(entry);
            }
            assert_eq!(of("null_space_projector"), projector);
            let still = arm.clone().without_friction();
            let rest = vec![Field::ZERO; n];
            let exact = Formulation::LagrangeEuler;
            let loads = exact.inverse_dynamics(&still, &case.at, &motion.qd, &rest);
            let driven = matrix_product(&j, &matrix_product(&d_inv, &loads, n), n);
            let rest: Vec<Field> = driven.iter().zip(&rate).map(|(a, b)| a.sub(b)).collect();
            assert_eq!(of("operational_bias"), matrix_product(&inertia, &rest, m));
            let mut pushed = motion.clone();
            pushed.tau = matrix_product(&transposed, &motion.wrench[..m], m);
            let wrench = at_frame(&format!("contact_wrench{view}"), &arm, &case, &pushed);
            let squared = matrix_product(&j, &transposed, n);
            let left: Vec<Field> = matrix_product(&squared, &wrench, m);
            let right = matrix_product(&squared, &motion.wrench[..m], m);
            for ((left, entry), right) in left.iter().zip(&wrench).zip(&right) {
                assert_eq!(left.add(&damping.mul(entry)), *right);
            }
        }
    }
}
