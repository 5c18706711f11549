//! Certificates of functions whose sines are polynomials: they hold, follow
//! from the tolerance, and are caught when they lie.

use dalembert_codegen::workspace::{
    BoundEffort, Certificate, InputBox, Library, Literal, Node, Printed, Sensitivity, Setup, Sines,
    falsify, scale, sincos_counts, stated, within, write_function,
};
use dalembert_codegen::{Function, Program, Request, ScalarType, Start, generate};
use dalembert_model::number::Rational;
use dalembert_model::robot::Robot;

use crate::support;

const TOLERANCE: f64 = 1e-5;

struct Case {
    robot: Robot,
    limits: InputBox,
    program: Program,
    scales: Vec<f64>,
}

fn case(robot: Robot, scales: impl Fn(&Robot, &Program) -> Vec<f64>) -> Case {
    let generated = support::from(&robot, Function::InverseDynamics, Start::Auto);
    let program = generated.functions[0].program.clone();
    Case {
        limits: InputBox::of(&robot).unwrap(),
        scales: scales(&robot, &program),
        program,
        robot,
    }
}

/// Returns a light one, whose angles add up.
fn planar() -> Case {
    let mut robot = support::robot("planar3r");
    for joint in &mut robot.joints {
        let number = |n: i64| Some(Rational::from_integer(n.into()));
        joint.limits.velocity = number(2);
        joint.limits.acceleration = number(10);
    }
    case(robot, |_, _| vec![20.0, 10.0, 5.0])
}

impl Case {
    fn sines(&self, scalar: ScalarType, tolerance: f64) -> Sines {
        let allowances: Vec<f64> = self.scales.iter().map(|t| t * tolerance).collect();
        let sensitivity = Sensitivity::new(&self.program, &self.limits, BoundEffort::QUICK);
        within(
            &self.program,
            scalar,
            &self.limits.position,
            &allowances,
            &sensitivity,
        )
        .unwrap()
    }

    fn certificate(&self, scalar: ScalarType, sines: &Sines) -> Certificate {
        let (robot, program) = (&self.robot, &self.program);
        let libm = Certificate::make(robot, program, program, scalar, &self.limits, &self.scales);
        let sensitivity = Sensitivity::new(program, &self.limits, BoundEffort::CERTIFY);
        libm.with_sines(&Setup::whole(robot), sines, &sensitivity)
    }

    /// Returns the certificate with other sines in its text, and the same claims.
    fn with_other(&self, honest: &Certificate, sines: Sines) -> Certificate {
        let mut other = honest.clone();
        let code = self.program.code(honest.scalar, Library::Libm, &sines);
        other.text = write_function(&Printed::of(&self.program, &code), Library::Libm, &[]);
        other.sines = sines;
        other
    }
}

#[test]
fn a_certificate_with_polynomials_holds_and_is_not_refuted() {
    let case = planar();
    for (scalar, tolerance) in [(ScalarType::F64, TOLERANCE), (ScalarType::F32, 1e-3)] {
        let sines = case.sines(scalar, tolerance);
        let certificate = case.certificate(scalar, &sines);
        let falsification = falsify(&certificate, 4000, 3, 1).unwrap();
        assert_eq!(
            falsification.violation, None,
            "{:?}",
            falsification.observed
        );
        for bound in &certificate.bounds {
            assert!(bound.sincos <= tolerance && bound.sincos > bound.rounding);
        }
        // All of the tolerance is not too much by far for the worst output.
        let worst = certificate.bounds.iter().map(|b| b.sincos);
        assert!(worst.fold(0.0, f64::max) > tolerance / 100.0);
        assert!(certificate.text.contains("let x1 = ") && !certificate.text.contains("libm"));
    }
}

/// Of the PUMA at 1e-6, the bar of the bench.
#[test]
fn operations_follow_from_the_tolerance() {
    let case = case(support::robot("puma560"), |robot, program| {
        scale::actuator(robot, program).unwrap()
    });
    let operations = |tolerance| {
        let (mul, add) = sincos_counts(&case.sines(ScalarType::F64, tolerance));
        mul + add
    };
    let all: Vec<usize> = [1e-2, 1e-4, 1e-6, 1e-12].map(operations).to_vec();
    assert!(all.is_sorted() && all[0] < all[3], "{all:?}");
    assert!(all[2] <= 88, "{all:?}");
}

#[test]
fn a_changed_coefficient_is_caught_by_the_sampler() {
    let case = planar();
    let sines = case.sines(ScalarType::F64, TOLERANCE);
    let honest = case.certificate(ScalarType::F64, &sines);
    for index in 0..sines[0].kernel.dag.nodes.len() {
        let mut changed = sines.clone();
        let Node::Constant(Literal(value)) = &mut changed[0].kernel.dag.nodes[index] else {
            continue;
        };
        *value *= 1.0 + 1e-2;
        let lie = case.with_other(&honest, changed.clone());
        let found = falsify(&lie, 2000, 2, 3).unwrap();
        assert!(
            found.violation.is_some(),
            "node {index}: {:?}",
            found.observed
        );
    }
}

#[test]
fn a_claim_made_too_small_is_caught() {
    let case = planar();
    let sines = case.sines(ScalarType::F64, TOLERANCE);
    let honest = case.certificate(ScalarType::F64, &sines);
    let mut bound = honest.clone();
    for bound in &mut bound.bounds {
        bound.sincos /= 50.0;
    }
    assert!(falsify(&bound, 4000, 3, 5).unwrap().violation.is_some());
}

/// A joint without limits may turn on: its sines are good far beyond the turn
/// that the bounds are over.
#[test]
fn a_joint_without_limits_turns_on() {
    let more = "\n[scene.turning]\noutputs = [\"gravity\"]\n\
                tolerance = { value = 1e-5, relative_to = \"range\" }\n";
    let mut reading = support::reading_with("planar2r", more);
    reading.robot.joints[0].limits.position = None;
    let (robot, scene) = (reading.robot, reading.scenes.pop().unwrap());
    let request = Request {
        scene: Some(scene.clone()),
        ..Request::new(&[Function::Gravity])
    };
    let generated = generate(&robot, &request).unwrap();
    for scalar in [ScalarType::F64, ScalarType::F32] {
        let function = &generated.functions[0];
        let certificates = &function.admitted.as_ref().unwrap().certificates;
        let certificate = certificates.iter().find(|c| c.scalar == scalar).unwrap();
        let held = certificate.positions(&robot, 0).unwrap();
        assert!(held.high() >= stated(scalar), "{held:?}");
        let mut turning = certificate.clone();
        turning.limits.position[0] = held;
        let found = falsify(&turning, 4000, 2, 7).unwrap();
        assert_eq!(found.violation, None, "{scalar}");
    }
}
