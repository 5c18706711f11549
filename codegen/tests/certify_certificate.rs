//! Certificates of what is left out, and of sines by polynomials: they hold, are tight enough, and
//! the sampler catches them when they lie.

use dalembert_codegen::workspace::{
    BoundEffort, BoxEffort, Certificate, Folding, InputBox, Interval, Library, Literal, Node,
    PruneSettings, Pruned, Sensitivity, Sines, Stage, difference, falsify, magnitudes, omissions,
    prune, scale, stated, within, write_function,
};
use dalembert_codegen::{Function, Program, ScalarType};
use dalembert_model::number::Rational;
use dalembert_model::robot::Robot;

use crate::support::{self, Case, largest};

pub struct Exact {
    pub robot: Robot,
    pub limits: InputBox,
    pub program: Program,
    pub scales: Vec<f64>,
}

impl Exact {
    pub fn new(
        robot: Robot,
        function: Function,
        scales: impl Fn(&Robot, &Program) -> Vec<f64>,
    ) -> Exact {
        let program = support::one(&robot, function).program;
        Exact {
            limits: InputBox::of(&robot).unwrap(),
            scales: scales(&robot, &program),
            program,
            robot,
        }
    }

    pub fn certificate(&self, emitted: &Program, scalar: ScalarType) -> Certificate {
        let (exact, limits) = (&self.program, &self.limits);
        Certificate::make(exact, emitted, scalar, limits, &self.scales)
    }

    pub fn pruned(&self, tolerance: f64, settings: &PruneSettings) -> Pruned {
        let allowances: Vec<f64> = self.scales.iter().map(|t| t * tolerance).collect();
        prune(&self.program, &self.limits, &allowances, settings)
    }

    fn sines(&self, scalar: ScalarType, tolerance: f64) -> Sines {
        let allowances: Vec<f64> = self.scales.iter().map(|t| t * tolerance).collect();
        let (program, limits) = (&self.program, &self.limits);
        let sensitivity = Sensitivity::new(program, limits, BoundEffort::QUICK);
        let sines = within(program, scalar, &limits.position, &allowances, &sensitivity);
        sines.unwrap()
    }

    fn with_sines(&self, scalar: ScalarType, sines: &Sines) -> Certificate {
        let sensitivity = Sensitivity::new(&self.program, &self.limits, BoundEffort::CERTIFY);
        let libm = self.certificate(&self.program, scalar);
        libm.with_sines(sines, &sensitivity)
    }
}

#[track_caller]
pub fn tried(certificate: &Certificate, samples: usize, climbs: usize, seed: u64) -> Vec<f64> {
    let found = falsify(certificate, samples, climbs, seed).unwrap();
    assert_eq!(found.violation, None, "{:?}", found.observed);
    found.observed
}

pub fn certified(own: &Certificate) -> f64 {
    let bounds: Vec<f64> = own.bounds.iter().map(|bound| bound.total()).collect();
    largest(&bounds)
}

fn torques(scales: impl Fn(&Robot, &Program) -> Vec<f64>) -> Exact {
    let mut robot = support::robot("planar3r");
    for joint in &mut robot.joints {
        let number = |n: i64| Some(Rational::from_integer(n.into()));
        joint.limits.velocity = number(2);
        joint.limits.acceleration = number(10);
    }
    Exact::new(robot, Function::InverseDynamics, scales)
}

fn ranged() -> Exact {
    torques(|robot, program| {
        let graph = Stage::unedited(program.clone()).edited(Folding::Syntactic);
        let limits = InputBox::of(robot).unwrap();
        magnitudes(&graph, &limits, &[1.0; 3], BoxEffort::QUICK)
    })
}

fn edited() -> (Exact, Pruned) {
    let exact = ranged();
    let settings = PruneSettings {
        samples: 64,
        guesses: 4,
        retries: 6,
        budget: BoxEffort {
            points: 1 << 14,
            ..BoxEffort::QUICK
        },
        ..PruneSettings::default()
    };
    let pruned = exact.pruned(0.1, &settings);
    (exact, pruned)
}

fn planar() -> Exact {
    torques(|_, _| vec![20.0, 10.0, 5.0])
}

#[test]
fn an_energy_is_within_the_tolerance() {
    let near = "tolerance = { value = [1e-2, 5e-2], relative_to = \"range\" }; \
        box = { velocity = [1, 3], acceleration = [3, 3] }";
    let case = Case::in_scene("planar2r", near, "kinetic_energy; scalar: f64, f32");
    let generated = case.generated();
    let admitted = generated.functions[0].admitted.as_ref().unwrap();
    for certificate in &admitted.certificates {
        let bound = certificate.bounds[0].total();
        assert!(bound <= 1e-2 && bound > 0.0, "{bound}");
    }
}

#[test]
fn a_bound_made_too_small_is_caught_by_the_sampler() {
    let (exact, pruned) = edited();
    let (before, after) = (exact.program.counts(), pruned.program.counts());
    assert!(after.operations() < before.operations(), "{after}");
    let honest = exact.certificate(&pruned.program, ScalarType::F64);
    let seen = tried(&honest, 2000, 3, 1);
    for (bound, seen) in honest.bounds.iter().zip(seen) {
        assert!(bound.model <= 0.1 && bound.model <= 3.0 * seen, "{seen}");
    }
    let mut lie = honest.clone();
    let models = lie
        .bounds
        .iter_mut()
        .map(|bound| &mut bound.model)
        .enumerate();
    let (worst, model) = models.max_by(|(_, a), (_, b)| a.total_cmp(b)).unwrap();
    *model /= 4.0;
    let found = falsify(&lie, 2000, 3, 1).unwrap();
    assert_eq!(found.violation.map(|own| own.0), Some(worst));
}

#[test]
fn a_program_that_is_no_edit_is_bounded_against_the_exact_one() {
    let exact = ranged();
    let mut lighter = exact.robot.clone();
    lighter.joints[2].mass *= Rational::new(19.into(), 20.into());
    let other = support::one(&lighter, Function::InverseDynamics).program;
    let honest = exact.certificate(&other, ScalarType::F64);
    let seen = tried(&honest, 2000, 3, 1);
    for (bound, seen) in honest.bounds.iter().zip(seen) {
        let is_close = seen > 1e-3 && bound.model <= 1.5 * seen;
        assert!(is_close, "{bound:?} {seen}");
    }
}

#[test]
fn every_omission_saves_something() {
    let (_, pruned) = edited();
    let omissions = omissions(&pruned.stages);
    let stages = pruned.stages.iter();
    let edits = stages.flat_map(|stage| stage.edits.iter().map(move |edit| (stage, edit)));
    let (corrected, left_out): (Vec<_>, Vec<_>) = edits.partition(|(_, edit)| edit.corrects());
    assert!(!left_out.is_empty() && omissions.len() == left_out.len());
    assert!(
        !corrected.is_empty(),
        "constants make up for what is left out"
    );
    for (omission, (stage, edit)) in omissions.iter().zip(left_out) {
        let counts = |stage: &Stage| stage.program(Folding::Syntactic).counts();
        let mut back = stage.clone();
        back.edits.retain(|own| own.place != edit.place);
        let (paid, more) = (counts(stage), counts(&back));
        let words = &omission.words;
        assert!(omission.operations + omission.sincos > 0, "{words}");
        assert_eq!(more.operations(), paid.operations() + omission.operations);
        assert_eq!(more.sincos, paid.sincos + omission.sincos);
    }
    let words = &omissions[0].words;
    assert_eq!(words.split(" -> ").count(), 2, "{words}");
}

/// The two methods share nothing but the intervals; the grid's bound is close to the truth.
#[test]
fn branch_and_bound_and_the_grid_bound_the_same() {
    let (exact, pruned) = edited();
    let graph = difference(&pruned.stages);
    let bound = |points, limits: &InputBox| {
        let budget = BoxEffort {
            boxes: 40_000,
            points,
        };
        magnitudes(&graph, limits, &exact.scales, budget)
    };
    let honest = exact.certificate(&pruned.program, ScalarType::F64);
    let seen = tried(&honest, 2000, 3, 5);
    let mut part = exact.limits.clone();
    part.position.fill(Interval::new(-0.5, 0.25).unwrap());
    let [whole, boxes] = [1 << 16, 0].map(|points| bound(points, &exact.limits));
    for i in 0..3 {
        let truth = seen[i] * exact.scales[i] * 0.999 - 1e-9;
        assert!(boxes[i] >= truth && whole[i] >= truth);
    }
    let [grid, boxes] = [1 << 16, 0].map(|points| bound(points, &part));
    for i in 0..3 {
        assert!(grid[i] <= whole[i]);
        let (least, most) = (grid[i].min(boxes[i]), grid[i].max(boxes[i]));
        assert!(most <= 3.0 * least + 1e-12, "{} {}", grid[i], boxes[i]);
    }
}

#[test]
fn a_certificate_with_polynomials_holds_and_is_not_refuted() {
    let exact = planar();
    for (scalar, tolerance) in [(ScalarType::F64, 1e-5), (ScalarType::F32, 1e-3)] {
        let certificate = exact.with_sines(scalar, &exact.sines(scalar, tolerance));
        tried(&certificate, 4000, 3, 1);
        for bound in &certificate.bounds {
            assert!(bound.sincos <= tolerance && bound.sincos > bound.rounding);
        }
        // All of the tolerance is not too much by far for the worst output.
        let mut bounds = certificate.bounds.iter();
        assert!(bounds.any(|bound| bound.sincos > tolerance / 100.0));
        assert!(certificate.text.contains("let x1 = ") && !certificate.text.contains("libm"));
    }
}

#[test]
fn operations_follow_from_the_tolerance() {
    let puma = support::robot("puma560");
    let actuator = |robot: &Robot, program: &Program| scale::actuator(robot, program).unwrap();
    let exact = Exact::new(puma, Function::InverseDynamics, actuator);
    let operations = |tolerance| {
        let sines = exact.sines(ScalarType::F64, tolerance);
        let operations = sines.iter().map(|own| own.kernel.operations());
        operations.sum::<usize>()
    };
    let all: Vec<usize> = [1e-2, 1e-4, 1e-6, 1e-12].map(operations).to_vec();
    assert!(all.is_sorted() && all[0] < all[3], "{all:?}");
    assert!(all[2] <= 88, "{all:?}");
}

#[test]
fn polynomials_that_are_not_as_exact_as_claimed_are_caught() {
    let exact = planar();
    let sines = exact.sines(ScalarType::F64, 1e-5);
    let honest = exact.with_sines(ScalarType::F64, &sines);
    for index in 0..sines[0].kernel.dag.nodes.len() {
        let mut changed = sines.clone();
        let Node::Constant(Literal(value)) = &mut changed[0].kernel.dag.nodes[index] else {
            continue;
        };
        *value *= 1.0 + 1e-2;
        let code = exact.program.code(honest.scalar, Library::Libm, &changed);
        let mut lie = honest.clone();
        lie.text = write_function(&exact.program, &code, Library::Libm, &[]);
        lie.sines = changed;
        let found = falsify(&lie, 2000, 2, 3).unwrap();
        assert!(found.violation.is_some(), "{index}: {:?}", found.observed);
    }
    let mut lie = honest;
    for bound in &mut lie.bounds {
        bound.sincos /= 50.0;
    }
    assert!(falsify(&lie, 4000, 3, 5).unwrap().violation.is_some());
}

/// The sines are good far beyond the turn that the bounds are over.
#[test]
fn a_joint_without_limits_turns_on() {
    let turning = "outputs = [\"gravity\"]; tolerance = { value = 1e-5, relative_to = \"range\" }";
    let mut case = Case::in_scene("planar2r", turning, "gravity; scalar: f64, f32");
    case.reading.robot.joints[0].limits.position = None;
    let generated = case.generated();
    let admitted = generated.functions[0].admitted.as_ref().unwrap();
    assert_eq!(admitted.certificates.len(), 2);
    for certificate in &admitted.certificates {
        let held = certificate.positions(case.robot(), 0).unwrap();
        assert!(held.high() >= stated(certificate.scalar), "{held:?}");
        let mut turning = certificate.clone();
        turning.limits.position[0] = held;
        tried(&turning, 4000, 2, 7);
    }
}
