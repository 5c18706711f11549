//! False claims, made to be believed: each was accepted once, and is refused by
//! name now. What is false in each stands beside it; `attacks_on_the_proof` has
//! those that aim at primes and points, tests/README.md what an attacker can and
//! cannot do.

use std::path::PathBuf;

use crate::support::{Ran, run};

fn data(name: &str) -> String {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/data/attacks");
    folder.join(name).to_str().unwrap().to_owned()
}

fn certify(certificate: &str, robot: &str, more: &[&str]) -> Ran {
    let robot = data(robot);
    run(&[&["certify", certificate, "--robot", &robot], more].concat())
}

/// Asserts that it is refused, and why.
fn refused(ran: &Ran, why: &str) {
    assert_eq!(ran.code, 1, "{}{}", ran.out, ran.err);
    let said = ran.out.contains(why) || ran.err.contains(why);
    assert!(said, "expected {why}: {}{}", ran.out, ran.err);
}

#[test]
fn another_function_in_a_program_at_rest() {
    // gravity returns [0, 0]: the proved program was coriolis at rest.
    let ran = certify(&data("still_bad.json"), "r2_conf.toml", &[]);
    refused(&ran, "E is refuted at a state");
}

#[test]
fn inputs_that_are_no_values() {
    // 1000 sin q2 of a joint that is locked; -q1 of a joint that turns.
    let ran = certify(&data("locked_bad.json"), "r2_conf.toml", &[]);
    refused(&ran, "joint 2, which is locked");
    let ran = certify(&data("pend_bad.json"), "pend.toml", &[]);
    refused(&ran, "the angle of a joint as a number");
}

#[test]
fn texts_that_are_not_printed_of_the_program() {
    for (name, line) in [
        ("t1.json", "crate::evil::sincos(q[0])"),
        ("t5.json", "0.0 * libm::cos(q[1])"),
        ("t6.json", "#[inline(never)]"),
    ] {
        let ran = certify(&data(name), "r2l.toml", &[]);
        refused(&ran, "not of the grammar");
        assert!(ran.err.contains(line), "{name}: {}", ran.err);
    }
}

#[test]
fn a_tolerance_that_is_not_the_scenes() {
    // E = 7.9e-2 in a scene with a tolerance of 1e-3.
    let (file, scene) = (data("scara_a4_too_loose.json"), ["--scene", "a4"]);
    let ran = certify(&file, "scara.toml", &scene);
    refused(&ran, "above the tolerance");
}
