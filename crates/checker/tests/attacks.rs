//! Variants and claims that were made to be believed, each accepted once by some checker: none is
//! shown. The text, its claim and the robot of each are files.

use dalembert_checker::certify::{Demand, FunctionReport, ResultBound, certify};

use crate::support::{file, honest, in_scene};

/// Rust that is not compiled has another ending, so that no tool takes it for a source.
fn data(name: &str) -> String {
    let ending = if name.ends_with(".rs") { ".txt" } else { "" };
    file(&format!("crates/checker/tests/data/attacks/{name}{ending}"))
}

/// Splits each row of a table, but for comments, into so many cells.
fn rows<const N: usize>(table: &str) -> impl Iterator<Item = [&str; N]> {
    let rows = table.trim().lines().filter(|row| !row.starts_with('#'));
    rows.map(|row| {
        let mut words = row.splitn(N, ' ');
        std::array::from_fn(|_| words.next().unwrap())
    })
}

fn found(
    name: &str,
    [robot, scene]: [&str; 2],
    tolerance: Option<f64>,
) -> Result<Vec<ResultBound>, String> {
    // Two claims are made of the text of A.
    let text = data(&format!("{}.rs", if name == "B" { "A" } else { name }));
    let claim = data(&format!("{name}.claim.json"));
    let robot = data(&format!("{robot}.toml"));
    let mut demand = in_scene(scene);
    demand.tolerance = tolerance;
    let report = certify(&text, &claim, &robot, &demand);
    let line = report.map_err(|fault| fault.to_string())?.lines.remove(0);
    let shown = line.result.map_err(|fault| fault.to_string())?;
    Ok(shown.results)
}

/// A variant, its robot, its scene, and the refusal.
const ATTACKS: &str = "
# Multiples of 2⁶¹ − 1 in a constant of the exact program; of the text alone.
A r2 pick result 1 is not that of the robot
B r2 pick result 1 has a bound of
# Terms that vanish at known points of a known prime.
C r2l pick result 1 is not that of the robot
C2 r2l pick result 1 has a bound of
pt pt pick result 1 is not that of the robot
# The function at rest is another one.
still_bad r2_conf still result 1 is not that of the robot
# Inputs that are no values.
locked_bad r2_conf locked it reads a joint that is locked, or a rate
pend_bad pend_bad pick it reads an angle as a number
# A root of a joint without friction, which the identity takes to be zero.
rubbed rubbed free wrong friction width of joint 1
# Texts that are not of the grammar.
t1 r2l pick line 3: not of the grammar: `libm` expected
t5 r2l pick `libm` expected, not `0.0`
t6 r2l pick line 4: not of the grammar: `=` expected
# E of 1e-300 in the claim: none may say what the error is.
p2E r2a a unknown field
# Limits between which nothing is.
ra ru s the range of `qd` is empty
";

#[test]
fn variants_that_are_not_what_is_claimed() {
    for [name, robot, scene, words] in rows(ATTACKS) {
        let why = found(name, [robot, scene], None).unwrap_err();
        assert!(why.contains(words), "{name}: {why}");
    }
}

/// A file of exact functions, its robot, and the refusal.
const EXACT: &str = "
# (x + K) - K, where K is 2²⁰⁰ near rest; the same in f32, where each literal is 0.8 of the result.
a11_puma_gravity.rs puma560 rounding of `c` has a bound of
a13_f32.rs puma560 rounding of `c` has a bound of 8
# sin/sin, which is not a number at rest.
a1_home_nan.rs planar2r operation 28 has one value at all states
# 400 literals of 4090 digits.
a5_lit.rs planar2r is not a constant of at most 4000 digits
# A box without states.
f_box_reversed_far.rs planar2r it does not follow from the functions and the robot: `pub const BOX
# A guard that takes the place of <math.h>; a header for processors that compute in 80 bits.
nm.h planar2r the guard `#ifndef _MATH_H` is not NAME_H
p2t.h planar2r `#include <math.h>`
# Lines that move the cursor.
p2.rs planar2r not generated code
";

#[test]
fn exact_functions_that_are_not_what_is_claimed() {
    for [name, robot, words] in rows(EXACT) {
        let (base, _) = name.split_once('.').unwrap();
        let claim = data(&format!("{base}.claim.json"));
        let robot = file(&format!("generated/robots/{robot}.toml"));
        let why = match certify(&data(name), &claim, &robot, &Demand::default()) {
            Err(fault) => fault.to_string(),
            Ok(report) => {
                assert!(!report.passes(false), "{name}");
                let text = |line: FunctionReport| Some(line.result.err()?.to_string());
                let faults: Vec<String> = report.lines.into_iter().filter_map(text).collect();
                faults.join("; ")
            }
        };
        assert!(why.contains(words), "{name}: {why}");
    }
}

#[test]
fn a_tolerance_that_is_not_the_scenes() {
    let (name, scene) = ("scara_a4_too_loose", ["scara", "a4"]);
    let results = found(name, scene, Some(0.1)).unwrap();
    assert!(results.iter().all(ResultBound::is_shown), "{results:?}");
    let why = found(name, scene, None).unwrap_err();
    let words = "result 1 has a bound of 8.2e-2 T, over 1.0e-3: approximation";
    assert!(why.contains(words), "{why}");
}

/// An arm whose results are all zero is a true claim: T is zero, and so is the error.
#[test]
fn nothing_of_nothing() {
    let results = found("nothing", ["zero", "s"], None).unwrap();
    assert!(results[0].scale == 0.0 && results[0].bound.total() == 0.0);
}

/// The multiples of 2⁶¹ − 1 are what is refused: without them the variants are shown.
#[test]
fn variants_without_the_planted_number() {
    let [text, claim, robot] = honest();
    let report = certify(&text, &claim, &robot, &in_scene("pick")).unwrap();
    assert!(report.passes(true), "{report:?}");
}

#[test]
fn variants_that_are_checked_in() {
    let robot = file("generated/robots/puma560.toml");
    for (name, tolerance) in [("actuator-1e-3", 1e-3), ("range-1e-2", 1e-2)] {
        let stem = format!("generated/variants/puma560-{name}");
        let [text, claim] = [".rs", ".claim.json"].map(|end| file(&format!("{stem}{end}")));
        let demand = Demand {
            tolerance: Some(tolerance),
            ..Demand::default()
        };
        let report = certify(&text, &claim, &robot, &demand).unwrap();
        let results = &report.lines[0].result.as_ref().unwrap().results;
        let are_shown = results.iter().all(ResultBound::is_shown);
        assert!(results.len() == 6 && are_shown, "{results:?}");
    }
}

/// Axes and bodies are those of the robot file, wherever the rows of a claim have their origins.
#[test]
fn rows_are_measured_by_the_robot_file() {
    let cases = [
        ("axis_slid_far.h", "place of joint 2"),
        ("point_mass.h", "rounding of `load`"),
        ("bearing_moved.rs", "result 4 is not that of the robot"),
    ];
    for (name, words) in cases {
        let claim = format!("{}.claim.json", name.split_once('.').unwrap().0);
        let (text, claim) = (data(name), data(&claim));
        let report = certify(&text, &claim, &data("placed.toml"), &Demand::default());
        let passes = report.as_ref().is_ok_and(|report| report.passes(false));
        assert!(!passes, "{name}");
        assert!(format!("{report:?}").contains(words), "{name}: {report:?}");
    }
}

/// More bodies than the robot has links are refused before any is looked at.
#[test]
fn bodies_that_are_too_many_are_refused_at_once() {
    let claim = data("point_mass.claim.json");
    let list = format!("\"bodies\": [{}", "1, ".repeat(100_000));
    let many = claim.replacen("\"bodies\": [", &list, 1);
    assert_ne!(many, claim);
    let (text, robot) = (data("point_mass.h"), data("placed.toml"));
    let report = certify(&text, &many, &robot, &Demand::default());
    let why = report.unwrap_err().to_string();
    assert!(why.contains("more bodies than links"), "{why}");
}
