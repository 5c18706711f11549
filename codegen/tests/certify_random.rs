//! Certificates of robots that nobody chose, sliding joints and parts of the
//! circle among them: no bound is violated, and none is much too large.

use crate::support;
use crate::support::draw::{Draw, robots};
use dalembert_codegen::workspace::{
    Certificate, ErrorBudget, InputBox, PruneSettings, Pruned, Setup, falsify, prune,
};
use dalembert_codegen::{Function, Program, ScalarType, Start};
use dalembert_model::number::{Angle, Rational};
use dalembert_model::robot::{JointKind, Position, Robot};
use dalembert_model::scene::Scale;

/// Returns Limits: the whole circle or a part of it, and rates.
fn limited(mut robot: Robot, draw: &mut Draw) -> Robot {
    for joint in &mut robot.joints {
        joint.limits.position = Some(match joint.kind {
            JointKind::Prismatic => [-300, 500].map(|milli: i64| {
                let metres = Rational::new(milli.into(), 1000.into());
                Position::Length(metres)
            }),
            JointKind::Revolute => {
                let part = if draw.chance(2) { 1 } else { 3 };
                [-1, 1].map(|sign: i64| {
                    let turns = Rational::new(sign.into(), part.into());
                    Position::Angle(Angle::PiTimes(turns))
                })
            }
        });
        joint.limits.velocity = Some(draw.milli(500, 3000));
        joint.limits.acceleration = Some(draw.milli(2000, 20_000));
    }
    robot
}

/// Returns a twentieth of the range, by a short search.
fn pruned(program: &Program, limits: &InputBox, scales: &[f64]) -> Pruned {
    let allowances: Vec<f64> = scales.iter().map(|t| 0.05 * t).collect();
    let settings = PruneSettings {
        samples: 10,
        guesses: 2,
        retries: 0,
        stages: 1,
        ..PruneSettings::default()
    };
    prune(program, limits, &allowances, &settings)
}

/// Robots of 1 to 4 joints: in single precision as they are, and with what a
/// tolerance leaves out, where that takes no longer than a test may.
#[test]
fn bounds_hold_and_are_close() {
    for (seed, robot, mut draw) in robots(12, 0xb0) {
        let n = robot.joints.len();
        if n > 4 {
            continue;
        }
        let robot = limited(robot, &mut draw);
        let what = format!("seed {seed}, {} joints", robot.joints.len());
        let generated = support::from(&robot, Function::InverseDynamics, Start::Auto);
        let program = &generated.functions[0].program;
        let setup = Setup::whole(&robot);
        let scales = ErrorBudget::new(&setup, program, Scale::Range)
            .unwrap()
            .scales;
        let limits = InputBox::of(&robot).unwrap();
        let certify = |emitted: &Program, scalar| {
            let made = Certificate::make(&robot, program, emitted, scalar, &limits, &scales);
            let falsification = falsify(&made, 4000, 3, seed).unwrap();
            assert_eq!(falsification.violation, None, "{what}");
            let certified = made.bounds.iter().map(|bound| bound.total());
            let certified = certified.fold(0.0, f64::max);
            certified / falsification.observed.into_iter().fold(0.0, f64::max)
        };
        let rounding = certify(program, ScalarType::F32);
        assert!(rounding <= 30.0, "{what}: {rounding}");
        if n < 4 {
            let pruned = pruned(program, &limits, &scales);
            assert!(!pruned.stages.is_empty(), "{what}");
            let model = certify(&pruned.program, ScalarType::F64);
            assert!(model <= 1.5, "{what}: {model}");
        }
    }
}
