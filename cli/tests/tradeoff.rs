//! The sweep of tolerances, as a user runs it.

use std::fs;

use crate::support::planar::{arm, path};
use crate::support::{good, run};

#[test]
fn a_tradeoff_with_table_chart_and_certificates() {
    let (folder, arm) = arm("tradeoff");
    let output = path(&folder, "out");
    let arguments = [
        "tradeoff",
        &arm,
        "--scene",
        "pick",
        "--tolerances",
        "1e-9,0.1,0.2",
        "--samples",
        "300",
        "-o",
        &output,
    ];
    let ran = good(&arguments);
    let csv = fs::read_to_string(path(&folder, "out/tradeoff.csv")).unwrap();
    let rows: Vec<Vec<&str>> = csv.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!(rows[0][..3], ["tolerance", "scalar", "sincos_by"]);
    let column = |name: &str| rows[0].iter().position(|head| *head == name).unwrap();
    let (mul, add) = (column("mul"), column("add"));
    let operations =
        |row: &[&str]| row[mul].parse::<usize>().unwrap() + row[add].parse::<usize>().unwrap();
    let mut last = usize::MAX;
    for row in rows[1..].iter().filter(|row| row[1] == "f64") {
        let number = |name: &str| row[column(name)].parse::<f64>().unwrap();
        assert!(number("observed") <= number("certified"), "{row:?}");
        let tolerance = number("tolerance");
        assert!(
            tolerance == 0.0 || number("certified") <= tolerance,
            "{row:?}"
        );
        assert!(operations(row) <= last, "{csv}");
        last = operations(row);
    }
    assert!(
        last < operations(&rows[1]),
        "nothing was given up for 0.2: {csv}"
    );
    let svg = fs::read_to_string(path(&folder, "out/tradeoff.svg")).unwrap();
    assert!(svg.starts_with("<svg ") && svg.ends_with("</svg>\n"));
    for part in [
        "@media screen and (prefers-color-scheme:dark)",
        "f64, libm",
        "f32, libm",
        "relative to the largest torques",
    ] {
        assert!(svg.contains(part), "{part}");
    }
    let certificate = path(&folder, "out/certificates/2e-1-f64.json");
    let certify = ["certify", &certificate, "--robot", &arm];
    good(&[&certify[..], &["--tolerance", "2e-1"]].concat());
    let again = run(&[&certify[..], &["--tolerance", "1e-6"]].concat());
    assert_eq!(again.code, 1, "{}", again.err);
    assert!(again.out.contains("above the tolerance"), "{}", again.out);

    // A line for each tolerance where there is no terminal.
    for line in ["tolerance 2e-1: ", "tolerance 1e-9: ", "tolerance 0e0: "] {
        assert!(ran.err.contains(line), "{line}: {}", ran.err);
    }

    // The same bytes on every run.
    assert_eq!(run(&arguments).code, 0);
    assert_eq!(
        fs::read_to_string(path(&folder, "out/tradeoff.csv")).unwrap(),
        csv
    );
    assert_eq!(
        fs::read_to_string(path(&folder, "out/tradeoff.svg")).unwrap(),
        svg
    );
}

/// Where nothing is run nothing was observed, not even zero.
#[test]
fn nothing_is_observed_at_no_states() {
    let (folder, arm) = arm("unobserved");
    let output = path(&folder, "out");
    let ran = good(&[
        "tradeoff",
        &arm,
        "--scene",
        "any",
        "--tolerances",
        "0.1",
        "--samples",
        "0",
        "-o",
        &output,
    ]);
    let csv = fs::read_to_string(path(&folder, "out/tradeoff.csv")).unwrap();
    let rows: Vec<Vec<&str>> = csv.lines().map(|line| line.split(',').collect()).collect();
    for (column, head) in rows[0].iter().enumerate() {
        if head.contains("observed") {
            assert!(rows[1..].iter().all(|row| row[column].is_empty()), "{csv}");
        }
    }
    for line in ran.out.lines().skip(1) {
        assert!(line.split_whitespace().any(|cell| cell == "–"), "{line}");
    }
    let svg = fs::read_to_string(path(&folder, "out/tradeoff.svg")).unwrap();
    assert!(!svg.contains("observed"), "{svg}");
}

#[test]
fn tradeoff_says_what_it_lacks() {
    let (_, arm) = arm("tradeoff_lacks");
    for (arguments, words) in [
        (
            vec![],
            "joints 1, 2, 3 have no limit `velocity`; joints 1, 2, 3 have no limit `acceleration`",
        ),
        (
            vec!["--function", "gravity"],
            "joint 1 has no limit `torque`",
        ),
        (vec!["--scene", "pik"], "did you mean `pick`?"),
        (
            vec!["--scene", "pick", "--tolerances", "0"],
            "a number above zero, not 0",
        ),
        (
            vec!["--scene", "pick", "--tolerances", "nan"],
            "a number above zero, not NaN",
        ),
        (vec!["--scene", "pick", "--relative-to", "rang"], "'range'"),
    ] {
        let ran = run(&[&["tradeoff", &arm][..], &arguments].concat());
        assert_eq!(ran.code, 2, "{arguments:?}: {}", ran.err);
        assert!(ran.err.contains(words), "{arguments:?}: {}", ran.err);
    }
}
