//! D stays positive definite where terms were left out, and that is certified.

use dalembert_codegen::workspace::{
    Edit, EditSite, Folding, JointState, PruneSettings, Pruned, Random, Stage, ToleranceError,
    draw, least_eigenvalue, prune, scale,
};
use dalembert_codegen::{Complaint, Function, GenerateError, Program, ScalarType, generate};
use dalembert_model::number::Rational;
use dalembert_model::read::parse;
use dalembert_model::robot::Robot;

use crate::certify_certificate::Exact;
use crate::support::{self, Case};

fn inertia(mut robot: Robot) -> Exact {
    for joint in &mut robot.joints {
        joint.limits.velocity = Some(Rational::from_integer(1.into()));
        joint.limits.acceleration = Some(Rational::from_integer(1.into()));
    }
    let ones = |_: &Robot, program: &Program| vec![1.0; program.dag.outputs.len()];
    Exact::new(robot, Function::Inertia, ones)
}

fn certified(exact: &Exact, emitted: &Program) -> Option<f64> {
    exact.certificate(emitted, ScalarType::F64).lambda_min
}

fn least(exact: &Exact, emitted: &Program) -> Result<f64, Complaint> {
    least_eigenvalue(emitted, ScalarType::F64, &[], &exact.limits)
}

fn pruned(exact: &Exact, stages: usize, alike: usize) -> Pruned {
    let ranges = scale::range(&exact.program, &exact.limits);
    let allowances: Vec<f64> = ranges.iter().map(|(t, _)| 0.15 * t).collect();
    let settings = PruneSettings {
        retries: 2,
        stages,
        alike,
        ..PruneSettings::default()
    };
    prune(&exact.program, &exact.limits, &allowances, &settings)
}

#[test]
fn a_pruned_inertia_is_certified_to_be_positive_definite() {
    let mut robot = support::robot("planar3r");
    let exact = inertia(robot.clone());
    let kept = pruned(&exact, 1, 0);
    // What the tolerance would let go makes this D indefinite.
    assert!(kept.stages.is_empty(), "{:?}", kept.stages[0].edits);
    let found = pruned(&exact, 3, 4);
    assert!(certified(&exact, &found.program).is_some_and(|least| least > 0.0));

    for joint in &mut robot.joints {
        joint.armature = Rational::from_integer(1.into());
    }
    let exact = inertia(robot);
    let pruned = pruned(&exact, 3, 4).program;
    let counts = (exact.program.counts(), pruned.counts());
    assert!(counts.1.operations() < counts.0.operations(), "{counts:?}");
    assert!(certified(&exact, &pruned).is_some_and(|least| least > 0.0));
    let text = pruned.in_doubles();
    let mut random = Random::new(3);
    for _ in 0..3000 {
        let d = text.run_at(&draw(&exact.limits, &mut random));
        let minor = d[0] * d[4] - d[1] * d[3];
        let det = d[0] * (d[4] * d[8] - d[5] * d[7]) - d[1] * (d[3] * d[8] - d[5] * d[6])
            + d[2] * (d[3] * d[7] - d[4] * d[6]);
        assert!(d[0] > 0.0 && minor > 0.0 && det > 0.0, "{d:?}");
        assert_eq!([d[1], d[2], d[5]], [d[3], d[6], d[7]]);
    }
}

/// Dropping the last link's own inertia leaves D singular: no certificate.
#[test]
fn a_singular_d_gets_no_certificate() {
    let exact = inertia(support::robot("planar3r"));
    let mut found = 0;
    for step in 0..exact.program.counts().operations() {
        let stage = Stage {
            program: exact.program.clone(),
            edits: vec![Edit::constant(
                EditSite::Step(step),
                Rational::default().into(),
            )],
        };
        let emitted = stage.program(Folding::Semantic);
        let text = emitted.in_doubles();
        let mut random = Random::new(4);
        let singular = (0..2000).any(|_| {
            let d = text.run_at(&draw(&exact.limits, &mut random));
            d[0] <= 0.0 || d[4] <= 0.0 || d[8] <= 0.0 || d[4] * d[8] <= d[5] * d[7]
        });
        if singular {
            assert!(least(&exact, &emitted).is_err(), "t{} = 0", step + 1);
            assert_eq!(certified(&exact, &emitted), None);
            found += 1;
        }
    }
    assert!(found > 0, "some term is indispensable");
}

#[test]
fn a_link_without_inertia_is_named() {
    let zero = Rational::default;
    let refused = |robot: Robot| {
        let exact = inertia(robot);
        let why = least(&exact, &exact.program).unwrap_err();
        why.to_string()
    };
    let mut robot = support::robot("planar3r");
    let last = &mut robot.joints[2];
    last.mass = zero();
    last.inertia = last.inertia.map(|_| zero());
    let why = refused(robot);
    assert!(why.contains("joint 3 moves nothing"), "{why}");

    // Nothing but a point mass at the tip: singular where the arm is
    // stretched, though every diagonal entry is positive.
    let mut robot = support::robot("planar2r");
    for joint in &mut robot.joints {
        joint.inertia = joint.inertia.map(|_| zero());
        joint.com = [zero(), zero(), zero()];
    }
    robot.joints[0].mass = zero();
    let why = refused(robot);
    assert!(why.contains("could not be shown"), "{why}");

    let mut robot = support::robot("planar2r");
    robot.joints[1].inertia.zz = Rational::from_integer((-1).into());
    let why = refused(robot);
    assert!(why.contains("a motion of joint 2"), "{why}");
}

/// An attack: with these polynomials D of the emitted code has an eigenvalue of −0.044 where the
/// model's least is 0.014.
#[test]
fn sines_that_are_off_leave_d_positive() {
    let source = include_str!("../../crates/cli/tests/data/attacks/indefinite.toml");
    let generated = Case::read(source, "scene: d").generated();
    let admitted = generated.functions[0].admitted.as_ref().unwrap();
    let certificates = admitted.certificates.iter();
    let mut polynomial = certificates.filter(|own| !own.sines.is_empty()).peekable();
    assert!(polynomial.peek().is_some(), "D bears some polynomials");
    assert!(polynomial.all(|own| own.lambda_min.is_some_and(|least| least > 0.0)));
    for emitted in &generated.emitted {
        for at in 0..=1000 {
            let elbow = f64::from(at) / 100.0 - 5.0;
            let state = JointState::at_rest(vec![0.3, elbow]);
            let d = emitted.run(&state);
            assert!(d[0] > 0.0 && d[0] * d[3] > d[1] * d[2], "{elbow}: {d:?}");
        }
    }
}

#[test]
fn an_inertia_that_no_body_has_is_named() {
    let source = include_str!("../../crates/cli/tests/data/negative_energy.toml");
    let refused = parse(source).unwrap_err().to_string();
    assert!(refused.contains("a principal moment is negative"));
    // No file may have it, but a robot that a program made.
    let possible = source.replace("0.05, 0, 0.3, 0]", "0.05, 0, 0, 0]");
    let case = |scene: &str| {
        let mut case = Case::read(&possible, &format!("scene: {scene}"));
        case.reading.robot.joints[1].inertia.yz = Rational::new(3.into(), 10.into());
        case
    };
    let _ = case("t").generated();
    for scene in ["d", "m"] {
        let case = case(scene);
        let why = generate(case.robot(), &case.request).unwrap_err();
        let said = why.to_string();
        assert!(said.contains("an inertia that no body has"), "{said}");
        let GenerateError::Tolerance(_, ToleranceError::Indefinite(why)) = why else {
            panic!("{said}")
        };
        assert!(why.message.contains("a motion of joint 1"), "{why}");
    }
}
