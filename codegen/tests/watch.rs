//! Watching a search and ending it early.

use std::sync::Arc;
use std::sync::Mutex;

use dalembert_codegen::workspace::{Observer, Part, Progress, price};
use dalembert_codegen::{Effort, Function, Generated, Request, ScalarType, Watch, generate};

use crate::support;

/// Writes down what it is told, and wants an end at a part.
struct Clerk {
    until: Option<Part>,
    seen: Mutex<Vec<Progress>>,
}

impl Observer for Clerk {
    fn step(&self, progress: &Progress) {
        self.seen.lock().unwrap().push(*progress);
    }
    fn stop(&self) -> bool {
        let seen = self.seen.lock().unwrap();
        seen.iter()
            .any(|progress| Some(progress.part) == self.until)
    }
}

fn watched(effort: Effort, until: Option<Part>) -> (Generated, Vec<Progress>) {
    let clerk = Arc::new(Clerk {
        until,
        seen: Mutex::default(),
    });
    let request = Request {
        scalars: vec![ScalarType::F64],
        effort,
        watch: Watch::by(clerk.clone()),
        ..Request::of(&[Function::InverseDynamics, Function::Gravity])
    };
    let generated = generate(&support::robot("planar3r"), &request).unwrap();
    let seen = clerk.seen.lock().unwrap().clone();
    (generated, seen)
}

#[test]
fn watching_changes_nothing() {
    let (generated, seen) = watched(Effort::Quick, None);
    let alone = Request {
        scalars: vec![ScalarType::F64],
        ..Request::of(&[Function::InverseDynamics, Function::Gravity])
    };
    let alone = generate(&support::robot("planar3r"), &alone).unwrap();
    assert!(generated.text() == alone.text());
    for function in [Function::InverseDynamics, Function::Gravity] {
        let parts = seen.iter().filter(|progress| progress.function == function);
        let mut parts: Vec<Part> = parts.map(|progress| progress.part).collect();
        parts.dedup();
        assert!(parts.starts_with(&[Part::Formulations, Part::Search]));
        assert_eq!(parts.last(), Some(&Part::Proof));
    }
}

/// What an early end leaves is proved like everything else (or `generate`
/// fails), and no dearer than what the search began with.
#[test]
fn an_early_end_keeps_the_best_so_far() {
    for until in [Part::Formulations, Part::Search] {
        let (generated, seen) = watched(Effort::Thorough, Some(until));
        let rounds = seen.iter().filter(|p| p.part == Part::Search).count();
        assert!(rounds <= 1, "{until}: {rounds} rounds");
        for function in &generated.functions {
            let passes = &function.passes;
            let began = passes.iter().find(|s| s.name == "fingerprints").unwrap();
            assert!(function.counts().operations() <= began.counts.operations());
        }
        // The function whose turn had not come got the quick search, unwatched.
        assert!(seen.iter().all(|p| p.function == Function::InverseDynamics));
    }
}

const SCENE: &str = r#"
[scene.hold]
outputs = ["gravity"]
tolerance = { value = 0.3, relative_to = "range" }
scalar = "f64"
"#;

/// With a tolerance, its search and its bounds are told too; an end keeps a
/// variant that is certified (or `generate` fails).
#[test]
fn a_tolerance_is_watched() {
    let reading = support::reading_with("planar2r", SCENE);
    let run = |effort, until| {
        let clerk = Arc::new(Clerk {
            until,
            seen: Mutex::default(),
        });
        let request = Request {
            effort,
            watch: Watch::by(clerk.clone()),
            ..Request::default()
        };
        let request = request.in_scene(&reading.scenes[0]);
        let generated = generate(&reading.robot, &request).unwrap();
        let seen = clerk.seen.lock().unwrap().clone();
        (generated, seen)
    };
    let rounds = |seen: &[Progress]| {
        let rounds = seen.iter().filter(|p| p.part == Part::Omissions);
        // A better exact program begins anew, and restarts run side by side: of none a round
        // is left out.
        let rounds: Vec<_> = rounds.map(|p| p.round).collect();
        let mut seen = vec![0; rounds.len() + 1];
        for &round in &rounds {
            assert!(round == 0 || seen[round] < seen[round - 1], "{rounds:?}");
            seen[round] += 1;
        }
        rounds.len()
    };
    let (generated, seen) = run(Effort::Thorough, None);
    let all = rounds(&seen);
    let bounds = seen.iter().filter(|p| p.part == Part::Bounds);
    assert!(
        bounds.count() >= 4,
        "of the exact program and of the variant"
    );
    let (ended, seen) = run(Effort::Thorough, Some(Part::Omissions));
    assert!(rounds(&seen) < all);
    let admitted = ended.functions[0].admitted.as_ref().unwrap();
    let bounds = admitted.certificates.iter().flat_map(|c| &c.bounds);
    assert!(bounds.clone().count() > 0 && bounds.clone().all(|bound| bound.total() <= 0.3));
    assert!(
        ended.functions[0].counts().operations() >= generated.functions[0].counts().operations()
    );
}

/// Whenever the end is asked for, it is no worse than not to have begun: no
/// function is dearer than by the quick search, which leaves something out.
#[test]
fn an_early_end_is_no_worse_than_the_quick_search() {
    let reading = support::reading_with("planar3r", PICK);
    let run = |effort, until| {
        let seen = Mutex::default();
        let watch = Watch::by(Arc::new(Clerk { until, seen }));
        let request = Request {
            effort,
            watch,
            ..Request::default()
        };
        let request = request.in_scene(&reading.scenes[0]);
        generate(&reading.robot, &request).unwrap()
    };
    let quick = run(Effort::Quick, None);
    assert!(!quick.ended);
    let left_out = quick.functions[0].admitted.as_ref().unwrap();
    assert!(!left_out.stages.is_empty());
    for until in [Part::Formulations, Part::Search] {
        let ended = run(Effort::Thorough, Some(until));
        assert!(ended.ended);
        let admitted = ended.functions[0].admitted.as_ref().unwrap();
        assert!(!admitted.stages.is_empty(), "{until}");
        for (ended, quick) in ended.functions.iter().zip(&quick.functions) {
            let (ours, theirs) = (ended.counts(), quick.counts());
            assert!(
                price(&ended.program.counts()) <= price(&quick.program.counts()),
                "{until}: {ours}, quick: {theirs}"
            );
        }
    }
}

const PICK: &str = r#"
[scene.pick]
outputs = ["inverse_dynamics"]
lock = { 1 = 0 }
box = { velocity = [1, 1, 1], acceleration = [1, 2, 2] }
tolerance = { value = 0.1, relative_to = "range" }
scalar = "f64"
"#;

/// A hash of the request, which build scripts take, must not see who watches.
#[test]
fn a_request_prints_the_same_with_an_observer() {
    let clerk = Arc::new(Clerk {
        until: None,
        seen: Mutex::default(),
    });
    let watch = Watch::by(clerk);
    let request = Request {
        watch,
        ..Request::default()
    };
    assert_eq!(format!("{request:?}"), format!("{:?}", Request::default()));
}
