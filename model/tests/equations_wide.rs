//! The wide float against the 30-digit truth of the extreme cases.
use crate::equations_support::extremes::{self, Extreme};
use dalembert_model::equations::{Arm, DhVariables, Formulation, JointPosition, SinCosPair};
use dalembert_model::number::parse::parse_decimal;
use dalembert_model::number::{Rational, Wide};
use dalembert_model::reference::Reference;
use dalembert_model::robot::JointKind;
use dalembert_model::scalar::Scalar;
use nalgebra::DVector;

fn number(x: f64) -> Wide {
    Wide::from_f64(x).unwrap()
}

fn pair(angle: f64) -> SinCosPair<Wide> {
    Wide::sincos_of(angle).unwrap()
}

fn at(arm: &Arm<Wide>, q: &[f64]) -> Vec<DhVariables<Wide>> {
    let position = |(link, q): (&dalembert_model::equations::Link<Wide>, &f64)| match link.kind {
        JointKind::Revolute => JointPosition::Revolute(pair(*q)),
        JointKind::Prismatic => JointPosition::Prismatic(number(*q)),
    };
    let position: Vec<_> = arm.links.iter().zip(q).map(position).collect();
    arm.at(&position)
}

/// Returns max|found − truth| / max|truth| as an f64.
fn relative(found: &[Wide], truth: &[Wide]) -> f64 {
    assert_eq!(found.len(), truth.len());
    // Some are below the least double: compared as they are.
    let largest = |values: &mut dyn Iterator<Item = Wide>| {
        let sizes = values.map(|x| if x.is_negative() { x.neg() } else { x });
        sizes.fold(
            Wide::zero(),
            |a, b| if a.sub(&b).is_negative() { b } else { a },
        )
    };
    let error = largest(&mut found.iter().zip(truth).map(|(a, b)| a.sub(b)));
    let size = largest(&mut truth.iter().copied());
    // The file writes entries below 1e-70 of the scale as zero.
    error.over(&size).unwrap_or(error).magnitude()
}

/// Reads the file's numbers, of which some are beyond what a robot file may hold.
fn read(numbers: &[String]) -> Vec<Wide> {
    let read = |text: &String| {
        let (digits, power) = text.split_once('e').unwrap_or((text, "0"));
        let digits = parse_decimal(digits).unwrap();
        let ten = Rational::from_integer(10.into());
        Wide::from_rational(&(digits * ten.pow(power.parse().unwrap())))
    };
    numbers.iter().map(read).collect()
}

/// Returns the worst error of τ, D, h, c.
fn errors(case: &Extreme, arm: &Arm<Wide>, formulation: Formulation) -> [f64; 4] {
    let at = at(arm, &case.q);
    let rates = |values: &[f64]| values.iter().map(|x| number(*x)).collect::<Vec<_>>();
    let [qd, qdd] = [rates(&case.qd), rates(&case.qdd)];
    let d = formulation.inertia(arm, &at);
    let d = d
        .iter()
        .zip(&case.d)
        .flat_map(|(row, truth)| row[..truth.len()].to_vec());
    [
        relative(
            &formulation.inverse_dynamics(arm, &at, &qd, &qdd),
            &read(&case.tau),
        ),
        relative(&d.collect::<Vec<_>>(), &read(&case.d.concat())),
        relative(&formulation.velocity_terms(arm, &at, &qd), &read(&case.h)),
        relative(&formulation.gravity(arm, &at), &read(&case.c)),
    ]
}

#[test]
fn link_frame_recursion_meets_every_extreme() {
    let mut worst = [0.0f64; 4];
    let cases = extremes::read();
    assert_eq!(cases.len(), 114);
    for case in cases {
        let arm = case.arm(number, pair);
        let folded = arm.clone().fold_base();
        for arm in [arm, folded] {
            let errors = errors(&case, &arm, Formulation::NewtonEulerLink);
            assert!(
                errors.iter().all(|e| *e <= 1e-28),
                "{}: {errors:?}",
                case.id
            );
            for (worst, error) in worst.iter_mut().zip(errors) {
                *worst = worst.max(error);
            }
        }
    }
    println!("worst error of τ, D, h, c: {worst:?}");
}

#[test]
fn every_formulation_meets_the_short_extremes() {
    for case in extremes::read().iter().filter(|case| case.q.len() <= 7) {
        let arm = case.arm(number, pair);
        for formulation in Formulation::ALL {
            let errors = errors(case, &arm, formulation);
            assert!(
                errors.iter().all(|e| *e <= 1e-28),
                "{} {formulation:?}: {errors:?}",
                case.id
            );
        }
    }
}

#[test]
fn f32_runtime_stays_within_100_u() {
    let u = f64::from(f32::EPSILON) / 2.0;
    // Out of the range of f32, on purpose.
    let out_of_range = [
        "f32overflow_qd1e20",
        "subnormal_vel_nograv",
        "tiny_all",
        "tiny_vel_nograv",
    ];
    let mut worst = (0.0, String::new());
    for case in extremes::read() {
        if out_of_range.contains(&case.category.as_str()) {
            continue;
        }
        // The same arm and state in both: parameters rounded to f32.
        let near = |x: f64| x as f32;
        let near_pair = |angle: f64| {
            let (sin, cos) = libm::sincosf(near(angle));
            SinCosPair { sin, cos }
        };
        let runtime = Reference::new(case.arm(near, near_pair));
        let exact = |x: f32| number(f64::from(x));
        let truth = case.arm(
            |x| exact(near(x)),
            |angle| {
                let SinCosPair { sin, cos } = near_pair(angle);
                SinCosPair {
                    sin: exact(sin),
                    cos: exact(cos),
                }
            },
        );
        let rounded = |values: &[f64]| values.iter().map(|x| near(*x)).collect::<Vec<_>>();
        let [q, qd, qdd] = [&case.q, &case.qd, &case.qdd].map(|x| rounded(x));
        let wide = |values: &[f32]| values.iter().map(|x| f64::from(*x)).collect::<Vec<_>>();
        let big = |values: &[f32]| values.iter().map(|x| exact(*x)).collect::<Vec<_>>();
        let truth = Formulation::NewtonEulerLink.inverse_dynamics(
            &truth,
            &at(&truth, &wide(&q)),
            &big(&qd),
            &big(&qdd),
        );
        let [q, qd, qdd] = [q, qd, qdd].map(DVector::from_vec);
        let tau = runtime.inverse_dynamics(&q, &qd, &qdd).unwrap();
        let found: Vec<Wide> = tau.iter().map(|x| exact(*x)).collect();
        let error = relative(&found, &truth) / u;
        assert!(error <= 100.0, "{}: {error} u", case.id);
        if error > worst.0 {
            worst = (error, case.id.clone());
        }
    }
    println!("worst: {worst:?} u");
}
