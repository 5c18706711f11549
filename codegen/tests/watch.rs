//! Watching a search and ending it early.

use std::sync::{Arc, Mutex};

use dalembert_codegen::workspace::{Observer, Part, Progress, price};
use dalembert_codegen::{Effort, Function, GeneratedCode, Watch};

use crate::support::{Case, daily_and_campaign};

type Until = Option<(Part, usize)>;

struct Clerk {
    until: Until,
    seen: Mutex<Vec<Progress>>,
}

impl Observer for Clerk {
    fn step(&self, progress: &Progress) {
        self.seen.lock().unwrap().push(*progress);
    }
    fn stop(&self) -> bool {
        let seen = self.seen.lock().unwrap();
        self.until.is_some_and(|(part, most)| {
            let steps = seen.iter().filter(|progress| progress.part == part);
            steps.count() >= most
        })
    }
}

fn watched(mut case: Case, effort: Effort, until: Until) -> (GeneratedCode, Vec<Progress>) {
    let seen = Mutex::default();
    let clerk = Arc::new(Clerk { until, seen });
    (case.request.effort, case.request.watch) = (effort, Watch::new(clerk.clone()));
    let generated = case.searched();
    let seen = clerk.seen.lock().unwrap().clone();
    (generated, seen)
}

fn two() -> Case {
    Case::in_scene("planar3r", "", "inverse_dynamics, gravity; scalar: f64")
}

/// A hash of the request, which build scripts take, must not see who watches, either.
#[test]
fn watching_changes_nothing() {
    let (generated, seen) = watched(two(), Effort::Quick, None);
    assert!(generated.text() == two().searched().text());
    for function in [Function::InverseDynamics, Function::Gravity] {
        let parts = seen.iter().filter(|progress| progress.function == function);
        let mut parts: Vec<Part> = parts.map(|progress| progress.part).collect();
        parts.dedup();
        assert!(parts.starts_with(&[Part::Formulations, Part::Search]));
        assert_eq!(parts.last(), Some(&Part::Proof));
    }
    let (plain, mut other) = (two().request, two().request);
    let (until, seen) = (None, Mutex::default());
    other.watch = Watch::new(Arc::new(Clerk { until, seen }));
    assert_eq!(format!("{other:?}"), format!("{plain:?}"));
}

#[test]
fn an_early_end_keeps_the_best_so_far() {
    for until in [Part::Formulations, Part::Search] {
        let (generated, seen) = watched(two(), Effort::Thorough, Some((until, 1)));
        let rounds = seen.iter().filter(|p| p.part == Part::Search).count();
        assert!(rounds <= 1, "{until:?}: {rounds} rounds");
        for function in &generated.functions {
            let passes = &function.passes;
            let began = passes.iter().find(|s| s.name == "fingerprints").unwrap();
            assert!(function.counts().operations() <= began.counts.operations());
        }
        // The function whose turn had not come got the quick search, unwatched.
        assert!(seen.iter().all(|p| p.function == Function::InverseDynamics));
    }
}

daily_and_campaign! {
    a_tolerance_is_watched: (Some((Part::Omissions, 8))), (None);
}

/// The fewer operations are left, the more often they are edited again: the whole takes a minute.
fn a_tolerance_is_watched(late: Until) {
    let hold = "outputs = [\"gravity\"]; tolerance = { value = 0.3, relative_to = \"range\" }";
    let case = || Case::in_scene("planar2r", hold, "gravity; scalar: f64");
    let rounds = |seen: &[Progress]| {
        // A better exact program begins anew, and restarts run side by side: of none a round
        // is left out.
        let rounds = seen.iter().filter(|p| p.part == Part::Omissions);
        let rounds: Vec<_> = rounds.map(|p| p.round).collect();
        let mut seen = vec![0; rounds.len() + 1];
        for &round in &rounds {
            assert!(round == 0 || seen[round] < seen[round - 1], "{rounds:?}");
            seen[round] += 1;
        }
        rounds.len()
    };
    let (generated, seen) = watched(case(), Effort::Thorough, late);
    let all = rounds(&seen);
    let bounds = seen.iter().filter(|p| p.part == Part::Bounds).count();
    assert!(bounds >= 1, "of the variant");
    let (ended, seen) = watched(case(), Effort::Thorough, Some((Part::Omissions, 1)));
    assert!(rounds(&seen) < all.min(8));
    let admitted = ended.functions[0].admitted.as_ref().unwrap();
    let bounds = &admitted.variants[0].bounds;
    assert!(!bounds.is_empty() && bounds.iter().all(|bound| bound.total() <= 0.3));
    let operations = |own: &GeneratedCode| own.functions[0].counts().operations();
    assert!(late.is_some() || operations(&ended) >= operations(&generated));
}

#[test]
fn an_early_end_is_no_worse_than_the_quick_search() {
    let pick = "lock = { 1 = 0 }; box = { velocity = [1, 1, 1], acceleration = [1, 2, 2] }; \
                tolerance = { value = 0.1, relative_to = \"range\" }";
    let case = || Case::in_scene("planar3r", pick, "inverse_dynamics; scalar: f64");
    let run = |effort, until| watched(case(), effort, until).0;
    let leaves_out = |own: &GeneratedCode| {
        let admitted = own.functions[0].admitted.as_ref();
        admitted.is_some_and(|admitted| admitted.is_other())
    };
    let quick = run(Effort::Quick, None);
    assert!(!quick.ended && leaves_out(&quick));
    for until in [Part::Formulations, Part::Search] {
        let ended = run(Effort::Thorough, Some((until, 1)));
        assert!(ended.ended && leaves_out(&ended), "{until:?}");
        for (ended, quick) in ended.functions.iter().zip(&quick.functions) {
            let [ours, theirs] = [ended, quick].map(|own| price(&own.program.counts()));
            assert!(ours <= theirs, "{until:?}: {ours}, quick: {theirs}");
        }
    }
}
