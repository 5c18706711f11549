//! Programs and parameters that are aimed at fixed primes and points: the checker refuses
//! certificates, and a run in 256 bits what the field of the search and the proof cannot see.

use std::fs;

use crate::support::{Ran, good, run, temporary};

fn attack(name: &str) -> String {
    format!("{}/tests/data/attacks/{name}", env!("CARGO_MANIFEST_DIR"))
}

fn certify(certificate: &str, robot: &str) -> Ran {
    run(&["certify", &attack(certificate), "--robot", &attack(robot)])
}

fn is_refused(ran: &Ran, why: &str) {
    assert_eq!(ran.code, 1, "{}{}", ran.out, ran.err);
    ran.says(&[why]);
}

/// Asserts that the certificate is not shown: a state refutes its E.
fn is_refuted(certificate: &str, robot: &str) {
    let ran = certify(certificate, robot);
    assert_eq!(ran.code, 1, "{}{}", ran.out, ran.err);
    ran.prints(&["E is refuted at a state"]);
}

/// 230 N·m more than the formula: a multiple of 2⁶¹ − 1.
#[test]
fn a_term_that_a_known_prime_divides() {
    is_refuted("A.json", "r2.toml");
    is_refuted("B.json", "r2.toml");
}

/// K·(q̇₁ − v₀)(q̇₁ − v₁)(q̇₁ − v₂) vanishes at points that are known.
#[test]
fn a_term_that_vanishes_at_known_points() {
    is_refuted("C.json", "r2l.toml");
    is_refuted("C2.json", "r2l.toml");
}

/// The search takes the last mass for zero; what it finds is refused, and
/// whoever asked is told which number it is.
#[test]
fn a_mass_that_the_search_takes_for_zero() {
    for robot in ["pe.toml", "pt.toml"] {
        let ran = run(&["generate", &attack(robot)]);
        assert_eq!(ran.code, 2, "{}", ran.err);
        assert!(ran.err.contains("2305843009213693951/1000000000000000000"));
        assert!(ran.out.is_empty());
    }
    is_refuted("pt.certificate.json", "pt.toml");
}

/// Two masses that are none by themselves, but their sum is: search and proof lose it in the same
/// field, and the run in 256 bits finds it.
#[test]
fn masses_whose_sum_the_search_takes_for_zero() {
    let folder = temporary("sum");
    let file = folder.join("arm.toml");
    let text = fs::read_to_string(attack("pe.toml")).unwrap();
    // m₁/2 + m₂ is what gravity multiplies by cos q₁.
    let text = text.replacen("mass = 1\n", "mass = 2\n", 1);
    let text = text.replacen("2.305843009213693951", "1.305843009213693951", 1);
    fs::write(&file, text).unwrap();
    let ran = run(&["generate", file.to_str().unwrap(), "--outputs", "gravity"]);
    is_refused(&ran, "gave a wrong result when it was run: c_1 is");
}

/// Angles whose digits are the same but for where the numerator ends. The text
/// is run against the runtime too.
#[test]
fn angles_whose_digits_are_alike() {
    good(&["verify", &attack("h.toml")]);
}
