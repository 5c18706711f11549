//! The axes in which links are seen change no result: chains with parallel and antiparallel axes
//! and slides between them, in every choice of axes, against Lagrange–Euler in the prime field.

use crate::equations_slips::Known;
use crate::equations_support::random::{self, CONVENTIONS, known};
use dalembert_model::equations::chain::composite::{Composite, CompositeOrder};
use dalembert_model::equations::chain::recursion::{AccelerationForm, MomentForm};
use dalembert_model::equations::chain::{Chain, Regrouping, Skeleton};
use dalembert_model::equations::{Arm, Formulation, SinCosPair};
use dalembert_model::robot::Convention;
use dalembert_model::scalar::Scalar;
use dalembert_model::scalar::field::{Field, Points};

#[derive(Clone, Copy)]
enum Twist {
    Along,
    Against,
    Across,
}

fn arm(convention: Convention, twists: &[Twist], slides: u32, points: &mut Points) -> Arm<Known> {
    let mut arm = random::case(convention, twists.len(), slides, points).arm;
    for (link, twist) in arm.links.iter_mut().zip(twists) {
        let (sin, cos) = match twist {
            Twist::Along => (Field::ZERO, Field::ONE),
            Twist::Against => (Field::ZERO, Field::ONE.neg()),
            Twist::Across => (Field::ONE, Field::ZERO),
        };
        link.alpha = SinCosPair { sin, cos };
    }
    arm.map(|x| Known(*x))
}

fn choices(chain: &Chain<Known>) -> Vec<Vec<i32>> {
    let mut choices: Vec<Vec<i32>> = vec![Vec::new()];
    for [less, more] in chain.freedoms() {
        let mut longer = Vec::new();
        for choice in choices {
            longer.extend((less..=more).map(|axes| [&choice[..], &[axes]].concat()));
        }
        choices = longer;
    }
    choices
}

fn compare(arm: &Arm<Known>, points: &mut Points) -> usize {
    let position = random::position(arm, points, Known);
    let [qd, qdd, v, a] = [(); 4].map(|()| known(&random::fields(arm.links.len(), points)));
    let (textbook, at) = (Formulation::LagrangeEuler, arm.at(&position));
    let torque = textbook.inverse_dynamics(arm, &at, &qd, &qdd);
    let inertia = textbook.inertia(arm, &at);
    let christoffel = textbook.christoffel(arm, &at);
    let gravity = textbook.gravity(arm, &at);
    let passivity = textbook.passivity(arm, &at, [&qd, &v, &a]);
    let first = [
        textbook.torque_by_position(arm, &at, &qd, &qdd),
        textbook.torque_by_velocity(arm, &at, &qd),
    ];
    let (state, rest) = ([&qd[..], &qdd, &v], [&qd[..], &v]);
    let second = [
        textbook.torque_by_positions(arm, &at, state),
        textbook.torque_by_position_and_velocity(arm, &at, rest),
        textbook.torque_by_velocities(arm, &at, rest),
        textbook.torque_by_acceleration_and_position(arm, &at, &v),
    ];

    let skeleton = Skeleton::new(arm, &[]);
    let mut chain = Chain::new(&skeleton, &Regrouping::base(&skeleton));
    let choices = choices(&chain);
    for choice in &choices {
        for (link, &axes) in chain.links.iter_mut().zip(choice) {
            link.axes = axes;
        }
        let (posed, at) = chain.posed(&position);
        let columns = (AccelerationForm::Column, MomentForm::SecondMoments);
        for (spin, couple) in [columns, (AccelerationForm::Rates, MomentForm::Euler)] {
            let tau = posed.inverse_dynamics(&at, &qd, &qdd, spin, couple);
            assert_eq!(tau, torque, "{choice:?}");
        }
        assert_eq!(posed.passivity(&at, &qd, &v, &a), passivity, "{choice:?}");
        let composite = Composite::new(&posed, &at);
        for travel in [CompositeOrder::Outward, CompositeOrder::Inward] {
            assert_eq!(composite.inertia(travel), inertia, "{choice:?}");
            assert_eq!(composite.gravity(travel), gravity, "{choice:?}");
            let slopes = composite.slopes(&qd, &qdd, travel);
            assert_eq!([slopes.position, slopes.velocity], first, "{choice:?}");
            let derivatives = composite.second_derivatives(state, travel);
            let parts = [
                derivatives.position,
                derivatives.mixed,
                derivatives.velocity,
                derivatives.driven,
            ];
            assert_eq!(parts, second, "{choice:?}");
        }
        assert_eq!(composite.christoffel(), christoffel, "{choice:?}");
    }
    choices.len()
}

#[test]
fn axes_change_nothing() {
    use Twist::{Across, Against, Along};
    let mut points = Points::new(77);
    let mut count = 0;
    for convention in CONVENTIONS {
        for (twists, slides) in [
            (&[Along, Along, Along][..], 0),
            (&[Along, Against, Along, Against], 0),
            (&[Across, Along, Along, Across, Across], 0),
            (&[Across, Against, Across, Along, Across], 0),
            (&[Along, Along, Along, Along], 0b0100),
            (&[Along, Against, Along, Along], 0b0010),
            (&[Across, Along, Across, Along, Along], 0b01001),
        ] {
            count += compare(&arm(convention, twists, slides, &mut points), &mut points);
        }
    }
    assert!(count > 300, "{count}");
}

/// A turn about y after a twist makes axes askew that the twist alone leaves parallel.
#[test]
fn a_turn_about_y_is_part_of_the_step() {
    let mut points = Points::new(0xbe7a);
    for slides in [0b0000, 0b0010, 0b0100] {
        for twists in [
            [Twist::Along, Twist::Along, Twist::Along, Twist::Across],
            [Twist::Against, Twist::Across, Twist::Along, Twist::Along],
        ] {
            let mut arm = arm(Convention::Standard, &twists, slides, &mut points);
            for tilted in [0, 1, 3] {
                let beta = random::pair(&mut points);
                arm.links[tilted].beta = Some(beta.map(|x| Known(*x)));
            }
            compare(&arm, &mut points);
        }
    }
}
