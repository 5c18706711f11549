//! Variants and claims that were made to be believed, each accepted once by some checker: none is
//! shown. The text, its claim and the robot of each are files.

use dalembert_checker::certify::{Bounded, certify};

use crate::support::{file, honest};

fn data(name: &str) -> String {
    file(&format!("crates/checker/tests/data/attacks/{name}"))
}

fn found(
    name: &str,
    [robot, scene]: [&str; 2],
    tolerance: Option<f64>,
) -> Result<Vec<Bounded>, String> {
    // Two claims are made of the text of A.
    let text = data(&format!("{}.rs", if name == "B" { "A" } else { name }));
    let claim = data(&format!("{name}.claim.json"));
    let robot = data(&format!("{robot}.toml"));
    let report = certify(&text, &claim, &robot, Some(scene), tolerance);
    let line = report.map_err(|fault| fault.to_string())?.lines.remove(0);
    let shown = line.result.map_err(|fault| fault.to_string())?;
    Ok(shown.results)
}

/// A variant, its robot, its scene, and the refusal.
const ATTACKS: &str = "
# Multiples of 2⁶¹ − 1 in a constant of the exact program; of the text alone.
A r2 pick result 1 is not that of the robot
B r2 pick E of result 1 is refuted at a state
# Terms that vanish at known points of a known prime.
C r2l pick result 1 is not that of the robot
C2 r2l pick E of result 1 is refuted at a state
pt pt pick result 1 is not that of the robot
# The function at rest is another one.
still_bad r2_conf still result 1 is not that of the robot
# Inputs that are no values.
locked_bad r2_conf locked it reads a joint that is locked, or a rate
pend_bad pend_bad pick it reads an angle as a number
# A root of a joint without friction, which the identity takes to be zero.
rubbed rubbed free another width of friction of joint 1
# Texts that are not of the grammar.
t1 r2l pick line 3: not of the grammar: `libm` expected
t5 r2l pick `libm` expected, not `0.0`
t6 r2l pick line 4: not of the grammar: `=` expected
# T that nothing reaches, and limits between which nothing is.
forged user s the largest that is reached
ra ru s the range of `qd` is empty
";

#[test]
fn variants_that_are_not_what_is_claimed() {
    let rows = ATTACKS.trim().lines().filter(|row| !row.starts_with('#'));
    for row in rows {
        let mut words = row.splitn(4, ' ');
        let [name, robot, scene, words] = std::array::from_fn(|_| words.next().unwrap());
        let why = found(name, [robot, scene], None).unwrap_err();
        assert!(why.contains(words), "{name}: {why}");
    }
}

#[test]
fn a_tolerance_that_is_not_the_scenes() {
    let (name, scene) = ("scara_a4_too_loose", ["scara", "a4"]);
    let results = found(name, scene, Some(0.1)).unwrap();
    let held = results.iter().filter(|own| own.holds()).count();
    assert_eq!(held, 3, "{results:?}");
    let why = found(name, scene, None).unwrap_err();
    assert!(
        why.contains("result 1 has a bound of 7.9e-2 T, over 1.0e-3: approximation"),
        "{why}"
    );
}

/// An arm whose results are all zero is a true claim: T is zero, and so is the error.
#[test]
fn nothing_of_nothing() {
    let results = found("nothing", ["zero", "s"], None).unwrap();
    assert!(results[0].scale == 0.0 && results[0].bound() == 0.0);
}

/// The multiples of 2⁶¹ − 1 are what is refused: without them the variants are shown.
#[test]
fn variants_without_the_planted_number() {
    let [text, claim, robot] = honest();
    let report = certify(&text, &claim, &robot, Some("pick"), None).unwrap();
    assert!(report.is_shown(), "{report:?}");
}

#[test]
fn variants_that_are_checked_in() {
    let robot = file("generated/robots/puma560.toml");
    for (name, tolerance) in [("actuator-1e-3", 1e-3), ("range-1e-2", 1e-2)] {
        let own = format!("generated/variants/puma560-{name}");
        let [text, claim] = [".rs", ".claim.json"].map(|end| file(&format!("{own}{end}")));
        let report = certify(&text, &claim, &robot, None, Some(tolerance)).unwrap();
        let results = &report.lines[0].result.as_ref().unwrap().results;
        assert!(
            results.len() == 6 && results.iter().all(Bounded::holds),
            "{results:?}"
        );
    }
}
