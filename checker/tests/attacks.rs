//! The false claims that the project's own checker once accepted: none is shown here.

use dalembert_checker::{Fault, audit};

use crate::support::{claim, file};

fn data(name: &str) -> String {
    format!("cli/tests/data/attacks/{name}")
}

/// Returns what the audit says of a false claim: a fault's words, or nothing if it is only not
/// shown.
fn refused(certificate: &str, robot: &str, scene: Option<&str>) -> String {
    let mut claim = claim(&data(certificate));
    claim.scene = scene.map(String::from).or(claim.scene);
    match audit(&claim, &file(&data(robot)), None) {
        Ok(verdict) => {
            assert!(!verdict.is_shown(), "{certificate}: {verdict:?}");
            String::new()
        }
        Err(fault) => fault.to_string(),
    }
}

#[test]
fn programs_aimed_at_primes_and_points() {
    for certificate in ["C.json", "C2.json"] {
        assert_eq!(refused(certificate, "r2l.toml", None), "");
    }
    assert_eq!(refused("pt.certificate.json", "pt.toml", None), "");
}

#[test]
fn another_function_than_the_claims() {
    assert_eq!(refused("still_bad.json", "r2_conf.toml", None), "");
}

#[test]
fn inputs_that_are_no_values() {
    assert!(refused("locked_bad.json", "r2_conf.toml", None).contains("joint 2, which is locked"));
    assert!(
        refused("pend_bad.json", "pend.toml", None).contains("the angle of a joint as a number")
    );
}

#[test]
fn texts_that_are_not_of_the_grammar() {
    let lines = [
        "`libm` expected, not `crate`",
        "`libm` expected, not `0.0`",
        "`=` expected, not `t1`",
    ];
    for (certificate, line) in ["t1.json", "t5.json", "t6.json"].into_iter().zip(lines) {
        let words = refused(certificate, "r2l.toml", None);
        assert!(
            words.starts_with("text, line") && words.contains(line),
            "{certificate}: {words}"
        );
    }
}

#[test]
fn a_tolerance_that_is_not_the_scenes() {
    assert_eq!(
        refused("scara_a4_too_loose.json", "scara.toml", Some("a4")),
        ""
    );
}

/// Robots of attacks on other parts: they are read as they stand, or refused by key.
#[test]
fn robots_of_attacks() {
    let mut claim = claim("checker/tests/data/planar2r-pick.json");
    claim.scene = None;
    // It has no limits of velocity, so that no box has all its states.
    let fault = audit(&claim, &file(&data("pe.toml")), None).unwrap_err();
    assert!(fault.to_string().contains("the box lacks"), "{fault}");
    let fault = audit(&claim, &file(&data("h.toml")), None).unwrap_err();
    assert!(
        matches!(fault, Fault::Robot(ref key, _) if key == "alpha"),
        "{fault}"
    );
    claim.scene = Some("d".into());
    let fault = audit(&claim, &file(&data("indefinite.toml")), None).unwrap_err();
    assert!(
        fault.to_string().contains("relative_to") || fault.to_string().contains("box"),
        "{fault}"
    );
}

const TRI: &str = "checker/tests/data/attacks/tri.toml";

/// A certificate that names no scene is held to no tolerance, and E of two to nothing.
#[test]
fn certificates_that_nothing_holds() {
    let path = "checker/tests/data/attacks/zero.json";
    let mut claim = claim(path);
    let fault = audit(&claim, &file(TRI), None).unwrap_err().to_string();
    assert!(fault.contains("it names no scene"), "{fault}");
    claim.scene = Some("act".into());
    let fault = audit(&claim, &file(TRI), None).unwrap_err().to_string();
    assert!(fault.contains("below one"), "{fault}");
}

/// Thirty-nine scales that nothing reaches are refused soon.
#[test]
fn work_for_witnesses() {
    let claim = claim("checker/tests/data/attacks/dos.json");
    let begin = std::time::Instant::now();
    let refused = audit(&claim, &file(TRI), Some(1e-2));
    assert!(!refused.is_ok_and(|verdict| verdict.is_shown()));
    let seconds = begin.elapsed().as_secs_f64();
    // Five of a processor; it was 152, and other tests take their share.
    assert!(seconds < 120.0, "{seconds}");
}
