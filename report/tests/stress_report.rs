//! The matrix and the sweeps on whole robots.

use dalembert_model::read;
use dalembert_model::robot::Robot;
use dalembert_report::stress::report::{Options, Verdict, run};
use dalembert_report::stress::sweep;

fn robot(name: &str) -> Robot {
    let folder = env!("CARGO_MANIFEST_DIR");
    let file = format!("{folder}/../generated/robots/{name}.toml");
    let source = std::fs::read_to_string(file).unwrap();
    read::parse(&source, &read::Options::default())
        .unwrap()
        .robot
}

fn few() -> Options {
    Options {
        states: 10,
        ..Options::default()
    }
}

#[test]
fn planar_arm_passes_and_says_what_is_singular() {
    let rows = run(&robot("planar2r"), &few(), |_| ()).unwrap();
    assert!(rows.iter().all(|row| row.verdict != Verdict::Fail));
    let singular = |name: &str| {
        let of = rows.iter().filter(|row| row.category == name);
        of.map(|row| row.condition.singular).collect::<Vec<_>>()
    };
    assert_eq!(singular("massless last link"), [true; 4]);
    assert_eq!(singular("normal"), [false; 4]);
}

#[test]
#[ignore = "minutes: for releases"]
fn every_robot_passes() {
    for name in ["puma560", "stanford", "ur10", "panda", "planar3r"] {
        let rows = run(&robot(name), &Options::default(), |_| ()).unwrap();
        for row in &rows {
            let bad = row.verdict == Verdict::Fail;
            if bad {
                println!("{name} {row:?}");
            }
        }
        assert!(
            rows.iter().all(|row| row.verdict != Verdict::Fail),
            "{name}"
        );
    }
}

#[test]
fn curves_are_flat() {
    let curves = sweep::run(&robot("planar2r"), &few()).unwrap();
    assert_eq!(curves.len(), 12);
    for curve in curves {
        assert!(curve.points.len() > 3);
        for (value, error) in &curve.points {
            assert!(*error <= 100.0, "{:?} {value}: {error} u", curve.axis);
        }
    }
}
