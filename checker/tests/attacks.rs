//! The false claims that the project's own checker once accepted: none is shown here.

use dalembert_checker::exact::{Report, check};
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

/// Returns what is found of a generated file, of the attacks in this crate's own folder.
fn found(source: &str, robot: &str) -> Result<Report, Fault> {
    check(source, &file(robot), None)
}

fn own(name: &str) -> String {
    file(&format!("checker/tests/data/attacks/{name}"))
}

const PEND: &str = "checker/tests/data/attacks/pend.toml";
const TRI: &str = "checker/tests/data/attacks/tri.toml";

/// Asserts that a line of the report is not shown for a reason that has these words.
#[track_caller]
fn lost(report: &Report, name: &str, words: &str) {
    let mut lines = report.lines.iter().filter(|line| line.name == name);
    let lost = lines.any(|line| {
        line.result
            .as_ref()
            .is_err_and(|f| f.to_string().contains(words))
    });
    assert!(lost && !report.is_shown(), "{name}: {words}: {report:?}");
}

/// Sines of constants, which libm has otherwise than the checker, and of what is far.
#[test]
fn sines_of_something_else() {
    for name in ["ulp.rs", "far32.rs"] {
        let report = found(&own(name), PEND).unwrap();
        lost(
            &report,
            "forward_dynamics",
            "not of the grammar: `q` expected",
        );
    }
    // In limits that reach so far, the checker's sine is none.
    let far = file(PEND).replacen("[\"-pi\", \"pi\"]", "[-3, 1001]", 1);
    let fault = check(&own("ulp.rs"), &far, None).unwrap_err().to_string();
    assert!(fault.contains("angles up to 1000 rad"), "{fault}");
}

/// A torque that is zero, and a row of D, beside larger entries.
#[test]
fn entries_of_zero_in_single_precision() {
    let mut source = file("generated/robots/ur10_f32.rs");
    for (from, to) in [
        ("-t179, t127]", "-t179, 0.0]"),
        ("-t128, -t39]", "-t128, 0.0]"),
        (
            "[t80, t109, t109, t109, 0.0, 0.0003]",
            "[0.0, 0.0, 0.0, 0.0, 0.0, 0.0]",
        ),
    ] {
        assert!(source.contains(from), "{from}");
        source = source.replacen(from, to, 1);
    }
    let report = found(&source, "generated/robots/ur10.toml").unwrap();
    let lost = ["inverse_dynamics", "coriolis", "inertia"];
    for line in &report.lines {
        let is_shown = line.result.as_ref().is_ok_and(|found| found.is_shown());
        assert_eq!(is_shown, !lost.contains(&line.name.as_str()), "{line:?}");
    }
}

/// Armature, friction and gravity that are others by less than the rounding of f32 may cost.
#[test]
fn parameters_that_are_others_in_single_precision() {
    let source = file("generated/robots/planar2r_f32.rs");
    let robot = file("generated/robots/planar2r.toml");
    let inertia = [
        "inertia",
        "inverse_dynamics",
        "manipulator_equation",
        "dynamic_coefficients",
    ];
    let friction = ["inverse_dynamics"];
    let gravity = [
        "gravity",
        "inverse_dynamics",
        "manipulator_equation",
        "dynamic_coefficients",
    ];
    for (from, to, names) in [
        ("mass = 1", "armature = 0.0005\nmass = 1", &inertia[..]),
        ("mass = 1", "viscous = 0.003\nmass = 1", &friction),
        ("-9.81", "-9.82", &gravity),
    ] {
        let robot = robot.replacen(from, to, 1);
        let report = check(&source, &robot, None).unwrap();
        for line in &report.lines {
            let is_shown = line.result.as_ref().is_ok_and(|found| found.is_shown());
            let is_other = names.contains(&line.name.as_str());
            assert_eq!(is_shown, !is_other, "{to}: {line:?}");
        }
    }
}

/// For a compiler a comment begins in the line of a slash, a star and a slash.
#[test]
fn a_comment_that_a_compiler_sees_elsewhere() {
    let guard = "#define TWO_H\n#ifdef __FAST_MATH__\n\
                 #error \"-ffast-math changes what is computed: compile without it\"\n#endif\n";
    let header = own("hide.h").replacen("#define TWO_H\n", guard, 1);
    lost(
        &found(&header, PEND).unwrap(),
        "gravity",
        "not of the grammar",
    );
    // Without these lines it is read, and shown.
    let whole = header.replace("\n/*/\n", "\n");
    assert!(found(&whole, PEND).unwrap().is_shown());
    // Without the guard against another arithmetic none is.
    assert!(found(&own("hide.h"), PEND).is_err());
}

/// An `impl` is nothing that is generated, whatever it calls; a number of joints follows from the
/// robot.
#[test]
fn items_beside_functions() {
    let report = found(&own("trait1.rs"), PEND).unwrap();
    let name = "impl dalembert";
    lost(
        &report,
        name,
        "does not follow from the functions and the robot: `impl dalembert",
    );
    let report = found(&own("n1.rs"), PEND).unwrap();
    lost(&report, "pub const N", "pub const N: usize = 1;");
}

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
