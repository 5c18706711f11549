//! The matrix on whole robots.

use dalembert_model::read;
use dalembert_model::robot::Robot;
use dalembert_report::stress::category::NORMWISE;
use dalembert_report::stress::report::{Options, Verdict, run};
use dalembert_report::stress::singular;

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

/// Two equal rods: with a unit diagonal D has the condition (1 + r)/(1 − r), r being
/// D_12/√(D_11 D_22), which is largest where the arm is stretched out.
#[test]
fn the_search_finds_where_two_rods_are_nearest_to_singular() {
    let divided = singular::run(&robot("planar2r"), &few()).unwrap();
    let r = (5.0 / 6.0) / (8.0f64 / 9.0).sqrt();
    let expected = (1.0 + r) / (1.0 - r);
    let nearest = &divided.nearest;
    assert!(
        (nearest.condition.scaled / expected - 1.0).abs() < 1e-9,
        "{nearest:?}"
    );
    assert!(nearest.q[1].abs() < 1e-4, "{nearest:?}");
    // Five functions, in two scalars, by two codes.
    assert_eq!(divided.rows.len(), 24);
    for row in &divided.rows {
        assert_eq!(row.verdict, Verdict::Pass, "{row:?}");
        assert!(row.error > 0.0 && row.error <= row.normwise, "{row:?}");
        let again = row.error * row.condition.scaled.max(1.0);
        assert!((again / row.normwise - 1.0).abs() < 1e-12, "{row:?}");
    }
}

/// Adds point masses at the ends of two links, of these masses.
fn points(masses: [&str; 2]) -> Robot {
    let joint = |mass: &str| {
        format!(
            "[[joint]]\nkind = \"revolute\"\na = 1\nmass = {mass}\ncom = [0, 0, 0]\n\
             inertia = [0, 0, 0, 0, 0, 0]\nlimits = {{ position = [\"-pi\", \"pi\"] }}\n"
        )
    };
    let head = "name = \"points\"\nconvention = \"standard\"\ngravity = [0, -9.81, 0]\n";
    let source = head.to_owned() + &masses.map(joint).concat();
    read::parse(&source, &read::Options::default())
        .unwrap_or_else(|errors| panic!("{errors}"))
        .robot
}

/// Stretched out, both joints move the second mass alike, and of the first, a ten-thousandth
/// of it, little is left. Digits are lost as the condition says, and no more.
#[test]
fn what_is_lost_next_to_singular_is_the_condition() {
    let divided = singular::run(&points(["1e-4", "1"]), &few()).unwrap();
    assert!(
        divided.nearest.condition.scaled > 1e5,
        "{:?}",
        divided.nearest
    );
    for row in &divided.rows {
        assert_eq!(row.verdict, Verdict::Pass, "{row:?}");
    }
    let lost = divided
        .rows
        .iter()
        .map(|row| row.normwise)
        .fold(0.0, f64::max);
    assert!(lost > NORMWISE, "{lost} u: nothing was near singular");
}

/// Where D has no inverse in any state, that is said and nothing measured.
#[test]
fn what_never_has_an_inverse_is_refused() {
    let divided = singular::run(&points(["1", "0"]), &few()).unwrap();
    let refused = divided.refused.map(|error| error.to_string());
    assert!(divided.rows.is_empty());
    assert!(refused.is_some_and(|said| said.contains("D is singular in every state")));
}
