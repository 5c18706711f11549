//! Certificates hold, are tight enough, and the sampler catches them when they lie.

use dalembert_codegen::workspace::{
    BoxEffort, Certificate, Folding, InputBox, Interval, PruneSettings, Pruned, Stage, difference,
    falsify, magnitudes, omissions, overflows, prune,
};
use dalembert_codegen::{Function, Program, Request, ScalarType, Start, generate};
use dalembert_model::robot::Robot;

use crate::support;

/// What is of no joint is held to the tolerance too: of an energy not everything goes.
#[test]
fn an_energy_is_within_the_tolerance() {
    let scene = "[scene.near]\ntolerance = { value = [1e-2, 5e-2], relative_to = \"range\" }\n\
        box = { velocity = [1, 3], acceleration = [3, 3] }\n";
    let mut planar = support::reading_with("planar2r", scene);
    let request = Request {
        scene: Some(planar.scenes.remove(0)),
        ..Request::new(&[Function::KineticEnergy])
    };
    let generated = generate(&planar.robot, &request).unwrap();
    let admitted = generated.functions[0].admitted.as_ref().unwrap();
    for certificate in &admitted.certificates {
        let bound = certificate.bounds[0].total();
        assert!(bound <= 1e-2 && bound > 0.0, "{bound}");
    }
}

fn robot() -> Robot {
    let mut robot = support::robot("planar3r");
    for joint in &mut robot.joints {
        let number = |n: i64| Some(dalembert_model::number::Rational::from_integer(n.into()));
        joint.limits.velocity = number(2);
        joint.limits.acceleration = number(10);
    }
    robot
}

fn exact(robot: &Robot) -> Program {
    let generated = support::from(robot, Function::InverseDynamics, Start::Auto);
    generated.functions[0].program.clone()
}

fn settings() -> PruneSettings {
    PruneSettings {
        samples: 64,
        guesses: 4,
        retries: 6,
        budget: BoxEffort {
            points: 1 << 14,
            ..BoxEffort::QUICK
        },
        ..PruneSettings::default()
    }
}

struct Case {
    robot: Robot,
    limits: InputBox,
    program: Program,
    scales: Vec<f64>,
    pruned: Pruned,
}

fn case(tolerance: f64) -> Case {
    let robot = robot();
    let limits = InputBox::of(&robot).unwrap();
    let program = exact(&robot);
    let whole = Stage {
        program: program.clone(),
        edits: Vec::new(),
    };
    let graph = whole.edited(Folding::Syntactic);
    let scales = magnitudes(&graph, &limits, &[1.0; 3], BoxEffort::QUICK);
    let allowances: Vec<f64> = scales.iter().map(|t| t * tolerance).collect();
    let pruned = prune(&program, &limits, &allowances, &settings());
    Case {
        robot,
        limits,
        program,
        scales,
        pruned,
    }
}

impl Case {
    fn certificate(&self, scalar: ScalarType) -> Certificate {
        Certificate::make(
            &self.robot,
            &self.program,
            &self.pruned.program,
            scalar,
            &self.limits,
            &self.scales,
        )
    }
}

#[test]
fn a_pruned_program_is_cheaper_certified_and_not_refuted() {
    let case = case(0.1);
    let (before, after) = (case.program.counts(), case.pruned.program.counts());
    assert!(after.operations() < before.operations(), "{after}");
    let certificate = case.certificate(ScalarType::F64);
    let falsification = falsify(&certificate, 2000, 3, 1).unwrap();
    assert_eq!(
        falsification.violation, None,
        "{:?}",
        falsification.observed
    );
    for (bound, seen) in certificate.bounds.iter().zip(&falsification.observed) {
        assert!(bound.model <= 0.1);
        assert!(bound.model <= 3.0 * seen, "{} {seen}", bound.model);
    }
}

#[test]
fn a_bound_made_too_small_is_caught_by_the_sampler() {
    let case = case(0.1);
    let honest = case.certificate(ScalarType::F64);
    let mut worst = 0;
    for (i, bound) in honest.bounds.iter().enumerate() {
        if bound.model > honest.bounds[worst].model {
            worst = i;
        }
    }
    let mut lie = honest.clone();
    lie.bounds[worst].model /= 4.0;
    let found = falsify(&lie, 2000, 3, 1).unwrap();
    assert_eq!(found.violation.map(|v| v.0), Some(worst));
}

/// A program that no edits lead to, of an arm with a lighter hand: it is bounded against the
/// exact one, closely.
#[test]
fn a_program_that_is_no_edit_is_bounded_against_the_exact_one() {
    let Case {
        robot,
        limits,
        program,
        scales,
        ..
    } = case(0.1);
    let mut lighter = robot.clone();
    let part = dalembert_model::number::Rational::new(19.into(), 20.into());
    lighter.joints[2].mass *= part;
    let other = exact(&lighter);
    let claim = |exact: &Program, emitted: &Program| {
        let scalar = ScalarType::F64;
        Certificate::make(&robot, exact, emitted, scalar, &limits, &scales)
    };
    let honest = claim(&program, &other);
    let falsification = falsify(&honest, 2000, 3, 1).unwrap();
    assert_eq!(falsification.violation, None);
    for (bound, seen) in honest.bounds.iter().zip(&falsification.observed) {
        assert!(
            *seen > 1e-3 && bound.model <= 1.5 * seen,
            "{bound:?} {seen}"
        );
    }
}

/// Putting any single omission back into the same program raises its cost,
/// by what the list says.
#[test]
fn every_omission_saves_something() {
    let case = case(0.1);
    let omissions = omissions(&case.pruned.stages);
    let edits = case.pruned.stages.iter().flat_map(|s| &s.edits);
    let (corrected, left_out): (Vec<_>, Vec<_>) = edits.partition(|edit| edit.corrects());
    assert!(!left_out.is_empty() && omissions.len() == left_out.len());
    assert!(
        !corrected.is_empty(),
        "constants make up for what is left out"
    );
    let stages = case.pruned.stages.iter();
    let edits = stages.flat_map(|stage| stage.edits.iter().map(move |edit| (stage, edit)));
    let edits = edits.filter(|(_, edit)| !edit.corrects());
    for (omission, (stage, edit)) in omissions.iter().zip(edits) {
        let counts = |stage: &Stage| stage.program(Folding::Syntactic).counts();
        let mut back = stage.clone();
        back.edits.retain(|own| own.place != edit.place);
        let (paid, more) = (counts(stage), counts(&back));
        let words = &omission.words;
        assert!(omission.operations + omission.sincos > 0, "{words}");
        assert_eq!(more.operations(), paid.operations() + omission.operations);
        assert_eq!(more.sincos, paid.sincos + omission.sincos);
    }
    let first = &omissions[0];
    assert_eq!(
        first.words.split(" -> ").count(),
        2,
        "{} names what is replaced and by what",
        first.words
    );
}

/// Two methods that share nothing but the intervals: both are bounds, and the
/// grid's is close to the truth.
#[test]
fn branch_and_bound_and_the_grid_bound_the_same() {
    let case = case(0.1);
    let graph = difference(&case.pruned.stages);
    let bound = |points, limits: &InputBox| {
        let budget = BoxEffort {
            boxes: 40_000,
            points,
        };
        magnitudes(&graph, limits, &case.scales, budget)
    };
    let seen = falsify(&case.certificate(ScalarType::F64), 2000, 3, 5).unwrap();
    // The whole circle, and a part of it.
    let mut part = case.limits.clone();
    for q in &mut part.position {
        *q = Interval::new(-0.5, 0.25).unwrap();
    }
    let (whole, boxes) = (bound(1 << 16, &case.limits), bound(0, &case.limits));
    for i in 0..3 {
        let truth = seen.observed[i] * case.scales[i];
        assert!(boxes[i] >= truth * 0.999 - 1e-9 && whole[i] >= truth * 0.999 - 1e-9);
    }
    let (grid, boxes) = (bound(1 << 16, &part), bound(0, &part));
    for i in 0..3 {
        assert!(grid[i] <= whole[i]);
        let (least, most) = (grid[i].min(boxes[i]), grid[i].max(boxes[i]));
        assert!(most <= 3.0 * least + 1e-12, "{} {}", grid[i], boxes[i]);
    }
}

/// Single precision against double: the bound holds and is within 30 of what
/// is seen.
#[test]
fn rounding_is_bounded_and_not_wildly() {
    let robot = robot();
    let limits = InputBox::of(&robot).unwrap();
    let program = exact(&robot);
    let scales = [20.0, 10.0, 5.0];
    let certificate = Certificate::make(
        &robot,
        &program,
        &program,
        ScalarType::F32,
        &limits,
        &scales,
    );
    let falsification = falsify(&certificate, 4000, 3, 2).unwrap();
    assert_eq!(falsification.violation, None);
    for (bound, seen) in certificate.bounds.iter().zip(&falsification.observed) {
        assert_eq!(bound.model, 0.0);
        let total = bound.total();
        assert!(total <= 30.0 * seen, "{total} {seen}");
    }
}

#[test]
fn steps_beyond_a_scalar_are_found() {
    let robot = robot();
    let mut limits = InputBox::of(&robot).unwrap();
    let program = exact(&robot);
    let mut steps = |velocity, scalar| {
        limits.velocity.fill(Interval::symmetric(velocity));
        overflows(&program, scalar, &[], &limits, 8).len()
    };
    assert_eq!(steps(1.0, ScalarType::F32), 0);
    assert!(steps(1e25, ScalarType::F32) > 0);
    assert_eq!(steps(1e25, ScalarType::F64), 0);
}
