//! Operation counts of the formulas as written.

use crate::equations_support::{golden, random};
use crate::support::ROBOTS;
use dalembert_model::equations::Formulation::{self, *};
use dalembert_model::equations::friction::Friction;
use dalembert_model::equations::{Arm, JointPosition, SinCosPair};
use dalembert_model::robot::{Convention, JointKind};
use dalembert_model::scalar::count::{Count, Counter};
use dalembert_model::scalar::field::Points;

fn generic(formulation: Formulation, n: usize) -> (u64, u64) {
    let counter = Counter::new();
    let mut arm = random::case(Convention::Standard, n, 0, &mut Points::new(1))
        .arm
        .map(|_| counter.value());
    for link in &mut arm.links {
        (link.friction, link.armature) = (Friction::none(), Count::Zero);
        (link.theta.sin, link.theta.cos) = (Count::Zero, Count::One);
    }
    torques(formulation, &arm, &counter)
}

fn torques<'a>(formulation: Formulation, arm: &Arm<Count<'a>>, counter: &'a Counter) -> (u64, u64) {
    let [sin, cos] = [(); 2].map(|()| counter.value());
    let position = arm.links.iter().map(|link| match link.kind {
        JointKind::Revolute => JointPosition::Revolute(SinCosPair { sin, cos }),
        JointKind::Prismatic => JointPosition::Prismatic(counter.value()),
    });
    let at = arm.at(&position.collect::<Vec<_>>());
    let rates = vec![counter.value(); arm.links.len()];
    formulation.inverse_dynamics(arm, &at, &rates, &rates);
    counter.counts()
}

/// Returns the counts of a golden robot: its numbers are numbers, not values.
fn golden(name: &str, formulation: Formulation) -> (u64, u64) {
    let counter = Counter::new();
    let arm = golden::read(name).0.map(|x| match x {
        0.0 => Count::Zero,
        1.0 => Count::One,
        -1.0 => Count::MinusOne,
        _ => Count::Number,
    });
    torques(formulation, &arm, &counter)
}

#[test]
fn one_joint_is_counted_as_by_hand() {
    // Multiplications: X for ω, ω̇, v̇: 2 + 2 + 8; p* twice: 4; ω̇ × and ω × (ω × p*): 12; the same
    // with s̄: 12; F: 3; N: 16; moment: 6; axis: 2. Additions: 4 + 9 for v̇, 9 for the centre of
    // mass, 10 for N, 9 for the moment, 1 for the axis. ω_1 has two components.
    let multiplications = 2 + 2 + 8 + 4 + 12 + 12 + 3 + 16 + 6 + 2;
    let by_hand = (multiplications, 4 + 9 + 9 + 10 + 9 + 1);
    assert_eq!(generic(NewtonEulerLink, 1), by_hand);
}

/// The differences of that degree do not vanish, the next ones do.
#[test]
fn recursions_grow_linearly_and_closed_forms_as_their_degree() {
    for (formulation, degree) in [
        (NewtonEulerBase, 1),
        (NewtonEulerLinkAsPrinted, 1),
        (NewtonEulerLink, 1),
        (Dalembert, 3),
        (LagrangeEuler, 4),
    ] {
        let mut row: Vec<i64> = (4..=11).map(|n| generic(formulation, n).0 as i64).collect();
        for order in 0..=degree {
            assert!(row.iter().any(|d| *d != 0), "{formulation:?} {order}");
            row = row.windows(2).map(|pair| pair[1] - pair[0]).collect();
        }
        assert!(row.iter().all(|d| *d == 0), "{formulation:?}");
    }
}

/// Table 3: coefficients of n⁰ to n⁴ of the multiplications, and of the additions.
#[test]
fn none_needs_more_than_the_paper_counts() {
    let lagrange = [
        &[0.0, 160.0 / 3.0, 739.0 / 3.0, 512.0 / 3.0, 128.0 / 3.0][..],
        &[0.0, 245.0 / 6.0, 559.0 / 3.0, 781.0 / 6.0, 98.0 / 3.0],
    ];
    let dalembert = [
        &[69.0, 268.0 / 3.0, 52.5, 13.0 / 6.0][..],
        &[45.0, 146.0 / 3.0, 44.0, 4.0 / 3.0],
    ];
    let linear = [&[0.0, 132.0][..], &[-4.0, 111.0]];
    for (formulation, printed) in [
        (LagrangeEuler, lagrange),
        (Dalembert, dalembert),
        (NewtonEulerLinkAsPrinted, linear),
        (NewtonEulerLink, linear),
    ] {
        for n in 1..=7 {
            let next = |sum: f64, coefficient: &f64| sum * f64::from(n) + coefficient;
            let [most_mul, most_add] = printed.map(|row| row.iter().rev().fold(0.0, next));
            let (mul, add) = generic(formulation, n as usize);
            let is_less = mul as f64 <= most_mul && add as f64 <= most_add;
            assert!(is_less, "{formulation:?} {n}");
        }
    }
}

#[test]
fn rotating_first_is_cheaper_on_every_golden_robot() {
    for robot in ROBOTS {
        let printed = golden(robot, NewtonEulerLinkAsPrinted);
        let rotated = golden(robot, NewtonEulerLink);
        println!("{robot}: as printed {printed:?}, rotate-first {rotated:?}");
        assert!(rotated.0 <= printed.0 && rotated.1 <= printed.1);
    }
    // Work that no torque depends on, and what is shared, goes when the formulas are traced.
    assert_eq!(golden("puma560", NewtonEulerLink), (290, 207));
}
