//! No certificate is violated, and none is much too large: pruned variants of
//! four robots, run at corners, random states and where a climb ends. The
//! whole campaign is in `src/certificate/README.md`; this is its smaller dose.

use dalembert_codegen::workspace::{
    BoundEffort, BoxEffort, Certificate, ErrorBudget, PruneSettings, Setup, falsify,
};
use dalembert_codegen::{Function, Request, ScalarType, generate};
use dalembert_model::scene::{Scale, Scene};

use crate::support;

const SAMPLES: usize = 20_000;
const CLIMBS: usize = 6;

/// Between a glance and a certificate.
const FINENESS: BoundEffort = BoundEffort {
    budget: BoxEffort::QUICK,
    boxes: 512,
    ..BoundEffort::QUICK
};

/// Returns the largest E and the largest error that was seen.
fn falsified(certificate: &Certificate) -> (f64, f64) {
    let falsification = falsify(certificate, SAMPLES, CLIMBS, 11).unwrap();
    assert_eq!(
        falsification.violation, None,
        "{:?}",
        falsification.observed
    );
    assert!(falsification.states > SAMPLES);
    let certified = certificate.bounds.iter().map(|bound| bound.total());
    let certified = certified.fold(0.0, f64::max);
    (
        certified,
        falsification.observed.into_iter().fold(0.0, f64::max),
    )
}

/// Certifies a robot in the scene of its file, at another tolerance; without guesses nothing is
/// left out.
fn campaign(name: &str, tolerance: f64, scalars: &[ScalarType], guesses: usize) {
    let reading = support::reading(name);
    let bare = reading.scenes.first().map(Scene::without_tolerance);
    let request = Request {
        scalars: vec![ScalarType::F64],
        scene: bare.clone(),
        ..Request::new(&[Function::InverseDynamics])
    };
    let exact = generate(&reading.robot, &request)
        .unwrap()
        .functions
        .remove(0)
        .program;
    let setup = Setup::in_scene(&reading.robot, bare.as_ref()).unwrap();
    let frame = ErrorBudget::new(&setup, &exact, Scale::Range).unwrap();
    let settings = PruneSettings {
        samples: 24,
        guesses,
        retries: 0,
        stages: 1,
        budget: FINENESS.budget,
        ..PruneSettings::default()
    };
    let tolerances = vec![tolerance; frame.scales.len()];
    let admitted = frame
        .choose(&tolerances, scalars, &settings, FINENESS)
        .unwrap();
    let is_pruned = admitted.is_other();
    assert_eq!(is_pruned, guesses > 0);
    for certificate in &admitted.certificates {
        let (certified, observed) = falsified(certificate);
        assert!(certified <= tolerance, "{certified}");
        assert!(
            !is_pruned || certified <= 3.0 * observed,
            "{certified} {observed}"
        );
        if certificate.scalar == ScalarType::F32 {
            let (certified, observed) = falsified(&certificate.of_rounding());
            assert!(certified <= 12.0 * observed, "{certified} {observed}");
        }
    }
}

#[test]
fn puma_at_a_tenth() {
    campaign("puma560", 1e-1, support::dose(&ScalarType::ALL, 1), 5);
}

#[test]
#[cfg_attr(debug_assertions, ignore = "half a minute without optimisation")]
fn stanford_at_a_hundredth() {
    campaign("stanford", 1e-2, &ScalarType::ALL, 5);
}

#[test]
#[cfg_attr(debug_assertions, ignore = "half a minute without optimisation")]
fn ur10_at_a_tenth() {
    campaign("ur10", 1e-1, &[ScalarType::F64], 3);
}

/// A search over seven joints takes longer than a test may: rounding alone.
#[test]
#[cfg_attr(debug_assertions, ignore = "half a minute without optimisation")]
fn panda_at_a_billionth() {
    campaign("panda", 1e-9, &[ScalarType::F64], 0);
}
