//! The generic runtime in f64 against the extreme cases: speeds, sizes, mass
//! ratios, far bases, huge angles, long snakes.

use crate::equations_support::extremes::{self, Extreme};
use crate::equations_support::normwise;
use dalembert_model::equations::SinCosPair;
use dalembert_model::reference::{Reference, WrongLength};
use nalgebra::DVector;

const U: f64 = f64::EPSILON / 2.0;

fn runtime(case: &Extreme) -> Reference<f64> {
    let pair = |angle: f64| {
        let (sin, cos) = libm::sincos(angle);
        SinCosPair { sin, cos }
    };
    Reference::new(case.arm(|x| x, pair))
}

fn vector(values: &[f64]) -> DVector<f64> {
    DVector::from_column_slice(values)
}

fn numbers(texts: &[String]) -> Vec<f64> {
    texts.iter().map(|text| text.parse().unwrap()).collect()
}

#[test]
fn torques_stay_within_100_u() {
    let mut worst = (0.0, String::new());
    for case in extremes::read() {
        let reference = runtime(&case);
        let [q, qd, qdd] = [&case.q, &case.qd, &case.qdd].map(|x| vector(x));
        let tau = reference.inverse_dynamics(&q, &qd, &qdd).unwrap();
        let c = reference.gravity(&q).unwrap();
        assert!(tau.iter().chain(&c).all(|x| x.is_finite()), "{}", case.id);
        // Products of subnormal speeds underflow: the error is absolute there.
        if case.category == "subnormal_vel_nograv" {
            let truth = numbers(&case.tau);
            assert!(tau.iter().zip(truth).all(|(a, b)| (a - b).abs() < 1e-300));
            continue;
        }
        for (found, truth) in [(tau, &case.tau), (c, &case.c)] {
            let error = normwise(found.as_slice(), &numbers(truth)) / U;
            assert!(error <= 100.0, "{}: {error} u", case.id);
            if error > worst.0 {
                worst = (error, case.id.clone());
            }
        }
    }
    println!("worst: {worst:?} u");
}

#[test]
fn inertia_and_velocity_terms_are_of_the_arm() {
    for case in extremes::read()
        .iter()
        .filter(|case| case.category == "normal")
    {
        let reference = runtime(case);
        let [q, qd] = [&case.q, &case.qd].map(|x| vector(x));
        let d = reference.inertia(&q).unwrap();
        assert_eq!(d, d.transpose());
        assert!(normwise(d.as_slice(), &numbers(&case.d.concat())) <= 100.0 * U);
        let h = reference.coriolis(&q, &qd).unwrap();
        assert!(normwise(h.as_slice(), &numbers(&case.h)) <= 100.0 * U);
        let symbols = reference.christoffel(&q).unwrap();
        let summed: Vec<f64> = symbols
            .iter()
            .map(|h| (qd.transpose() * h * &qd)[0])
            .collect();
        assert!(normwise(&summed, &numbers(&case.h)) <= 1000.0 * U);
    }
}

#[test]
fn what_is_not_finite_spreads_without_a_panic() {
    let cases = extremes::read();
    let case = &cases[0];
    let reference = runtime(case);
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for joint in 0..case.q.len() {
            let [mut q, mut qd, mut qdd] = [&case.q, &case.qd, &case.qdd].map(|x| vector(x));
            let values = [&mut q, &mut qd, &mut qdd];
            for (which, values) in values.into_iter().enumerate() {
                let good = values[joint];
                values[joint] = bad;
                let arguments = match which {
                    0 => [values.clone(), vector(&case.qd), vector(&case.qdd)],
                    1 => [vector(&case.q), values.clone(), vector(&case.qdd)],
                    _ => [vector(&case.q), vector(&case.qd), values.clone()],
                };
                values[joint] = good;
                let [q, qd, qdd] = arguments;
                let tau = reference.inverse_dynamics(&q, &qd, &qdd).unwrap();
                assert!(!tau[joint].is_finite());
            }
        }
    }
}

#[test]
fn wrong_lengths_are_errors() {
    let cases = extremes::read();
    let reference = runtime(&cases[0]);
    let [right, wrong] = [DVector::zeros(6), DVector::zeros(5)];
    let error = |argument| {
        Err(WrongLength {
            argument,
            expected: 6,
            found: 5,
        })
    };
    assert_eq!(
        reference.inverse_dynamics(&wrong, &right, &right),
        error("q")
    );
    assert_eq!(
        reference.inverse_dynamics(&right, &wrong, &right),
        error("qd")
    );
    assert_eq!(
        reference.inverse_dynamics(&right, &right, &wrong),
        error("qdd")
    );
    let text = reference.gravity(&wrong).unwrap_err().to_string();
    assert_eq!(text, "`q` has 5 values, the arm has 6 joints");
}
