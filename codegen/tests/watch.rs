//! Watching a search and ending it early.

use std::sync::{Arc, Mutex};

use dalembert_codegen::workspace::{Observer, Part, Progress, price};
use dalembert_codegen::{Effort, Function, GeneratedCode, Watch};

use crate::support::{Case, daily_and_campaign, variants};

type Until = Option<(Part, usize)>;

struct Clerk {
    until: Until,
    log: Mutex<Vec<Progress>>,
}

impl Observer for Clerk {
    fn step(&self, progress: &Progress) {
        self.log.lock().unwrap().push(*progress);
    }
    fn stop(&self) -> bool {
        let log = self.log.lock().unwrap();
        self.until.is_some_and(|(part, most)| {
            let steps = log.iter().filter(|progress| progress.part == part);
            steps.count() >= most
        })
    }
}

fn watched(mut case: Case, effort: Effort, until: Until) -> (GeneratedCode, Vec<Progress>) {
    let log = Mutex::default();
    let clerk = Arc::new(Clerk { until, log });
    (case.request.effort, case.request.watch) = (effort, Watch::new(clerk.clone()));
    let generated = case.searched();
    let reports = clerk.log.lock().unwrap().clone();
    (generated, reports)
}

fn two() -> Case {
    Case::in_scene("planar3r", "", "inverse_dynamics, gravity; scalar: f64")
}

/// A hash of the request, which build scripts take, must not see who watches, either.
#[test]
fn watching_changes_nothing() {
    let (generated, reports) = watched(two(), Effort::Quick, None);
    assert!(generated.text() == two().searched().text());
    for function in [Function::InverseDynamics, Function::Gravity] {
        let is_its = |progress: &&Progress| progress.function == function;
        let steps = reports.iter().filter(is_its);
        let mut parts: Vec<Part> = steps.map(|progress| progress.part).collect();
        parts.dedup();
        assert!(parts.starts_with(&[Part::Formulations, Part::Search]));
        assert_eq!(parts.last(), Some(&Part::Proof));
    }
    let (plain, mut other) = (two().request, two().request);
    let (until, log) = (None, Mutex::default());
    other.watch = Watch::new(Arc::new(Clerk { until, log }));
    assert_eq!(format!("{other:?}"), format!("{plain:?}"));
}

#[test]
fn an_early_end_keeps_the_best_so_far() {
    for until in [Part::Formulations, Part::Search] {
        let (generated, reports) = watched(two(), Effort::Thorough, Some((until, 1)));
        let rounds = reports.iter().filter(|p| p.part == Part::Search).count();
        assert!(rounds <= 1, "{until:?}: {rounds} rounds");
        for function in &generated.functions {
            let passes = &function.passes;
            let began = passes.iter().find(|s| s.name == "fingerprints").unwrap();
            assert!(function.counts().operations() <= began.counts.operations());
        }
        // The function whose turn had not come got the quick search, unwatched.
        let mut functions = reports.iter().map(|progress| progress.function);
        assert!(functions.all(|function| function == Function::InverseDynamics));
    }
}

daily_and_campaign! {
    a_tolerance_is_watched: (Some((Part::Omissions, 8))), (None);
}

/// The fewer operations are left, the more often they are edited again: the whole takes a minute.
fn a_tolerance_is_watched(late: Until) {
    let hold = "outputs = [\"gravity\"]; tolerance = { value = 0.3, relative_to = \"range\" }";
    let case = || Case::in_scene("planar2r", hold, "gravity; scalar: f64");
    let rounds = |reports: &[Progress]| {
        // A better program begins anew, and restarts run side by side: none leaves a round out.
        let omissions = reports.iter().filter(|p| p.part == Part::Omissions);
        let rounds: Vec<_> = omissions.map(|p| p.round).collect();
        let mut counts = vec![0; rounds.len() + 1];
        for &round in &rounds {
            let is_next = round == 0 || counts[round] < counts[round - 1];
            assert!(is_next, "{rounds:?}");
            counts[round] += 1;
        }
        rounds.len()
    };
    let (generated, reports) = watched(case(), Effort::Thorough, late);
    let round_count = rounds(&reports);
    let bounds = reports.iter().filter(|p| p.part == Part::Bounds).count();
    assert!(bounds >= 1, "of the variant");
    let (ended, early_reports) = watched(case(), Effort::Thorough, Some((Part::Omissions, 1)));
    assert!(rounds(&early_reports) < round_count.min(8));
    let bounds = &variants(&ended)[0].bounds;
    assert!(!bounds.is_empty() && bounds.iter().all(|bound| bound.total() <= 0.3));
    let operations = |code: &GeneratedCode| code.functions[0].counts().operations();
    assert!(late.is_some() || operations(&ended) >= operations(&generated));
}

#[test]
fn an_early_end_is_no_worse_than_the_quick_search() {
    let pick = "lock = { 1 = 0 }; box = { velocity = [1, 1, 1], acceleration = [1, 2, 2] }; \
                tolerance = { value = 0.1, relative_to = \"range\" }";
    let case = || Case::in_scene("planar3r", pick, "inverse_dynamics; scalar: f64");
    let run = |effort, until| watched(case(), effort, until).0;
    let leaves_out = |code: &GeneratedCode| {
        let admitted = code.functions[0].admitted.as_ref();
        admitted.is_some_and(|admitted| admitted.is_other())
    };
    let quick = run(Effort::Quick, None);
    assert!(!quick.ended && leaves_out(&quick));
    for until in [Part::Formulations, Part::Search] {
        let ended = run(Effort::Thorough, Some((until, 1)));
        assert!(ended.ended && leaves_out(&ended), "{until:?}");
        for (ended, quick) in ended.functions.iter().zip(&quick.functions) {
            let [ours, theirs] = [ended, quick].map(|function| price(&function.program.counts()));
            assert!(ours <= theirs, "{until:?}: {ours}, quick: {theirs}");
        }
    }
}
