//! Generated files without certificates.

use dalembert_checker::exact::{Report, check};

use crate::support::file;

fn robot() -> String {
    file("generated/robots/planar2r.toml")
}

fn generated() -> String {
    file("generated/robots/planar2r.rs")
}

fn report(source: &str) -> Report {
    check(source, &robot(), None).unwrap()
}

/// Returns the units of half an ulp that a function is shown to be within; none if it is not.
fn units(report: &Report, name: &str) -> Option<f64> {
    let line = report.lines.iter().find(|line| line.name == name)?;
    let found = line.result.as_ref().ok()?;
    found.is_shown().then(|| found.units())
}

#[test]
fn planar_arms() {
    for (name, scalar) in [
        ("planar2r", ""),
        ("planar2r", "_f32"),
        ("planar3r", ""),
        ("planar3r", "_f32"),
    ] {
        let source = file(&format!("generated/robots/{name}{scalar}.rs"));
        let robot = file(&format!("generated/robots/{name}.toml"));
        let report = check(&source, &robot, None).unwrap();
        assert!(report.is_shown() && report.is_unlimited, "{report:?}");
        assert_eq!(report.lines.len(), 6, "{report:?}");
        for line in &report.lines {
            let units = line.result.as_ref().unwrap().units();
            assert!(units < 500.0, "{report:?}");
        }
    }
}

/// One literal, operator or operand of each function changed: none of them is shown.
#[test]
fn functions_that_are_something_else() {
    let source = generated();
    for (name, from, to) in [
        ("inverse_dynamics", "c1 * 14.715", "c1 * 14.7150001"),
        (
            "inverse_dynamics",
            "let t7 = t6 * 0.3333333333333333;",
            "let t7 = t6 * 0.333333;",
        ),
        ("gravity", "let t3 = t1 - t2;", "let t3 = t1 + t2;"),
        ("gravity", "[t6, t4]", "[t4, t6]"),
        (
            "inertia",
            "[-t3, 0.3333333333333333],",
            "[-t3, 0.3333433333333333],",
        ),
        ("coriolis", "let t6 = qd[0] * t4;", "let t6 = qd[1] * t4;"),
        ("manipulator_equation", "c2", "s2"),
        ("dynamic_coefficients", "[-t4, -t4],", "[-t4, t4],"),
        ("dynamic_coefficients", "[t4, 0.0],", "[t4, 1e-9],"),
    ] {
        let start = source.find(&format!("pub fn {name}(")).unwrap();
        let end = start + source[start..].find("\n}\n").unwrap();
        let body = source[start..end].replacen("libm", "LIBM", 2);
        assert!(body.contains(from), "{name}: {from}");
        let body = body.replace(from, to).replace("LIBM", "libm");
        let changed = format!("{}{body}{}", &source[..start], &source[end..]);
        let report = report(&changed);
        assert_eq!(units(&report, name), None, "{from}: {report:?}");
        let shown = report
            .lines
            .iter()
            .filter(|line| units(&report, &line.name).is_some());
        assert!(
            !report.is_shown() && shown.count() >= 5,
            "{from}: {report:?}"
        );
    }
}

#[test]
fn another_robot_and_functions_that_are_not_known() {
    let source = generated();
    let heavier = robot().replacen("mass = 1", "mass = 1.000001", 1);
    let other = check(&source, &heavier, None).unwrap();
    assert_eq!(units(&other, "gravity"), None, "{other:?}");
    let renamed = source.replace("pub fn gravity(", "pub fn gravity_of_mars(");
    let report = report(&renamed);
    assert!(!report.is_shown());
    assert!(
        format!("{report:?}").contains("`gravity_of_mars` is not checked"),
        "{report:?}"
    );
    assert!(check("", &robot(), None).is_ok_and(|report| !report.is_shown()));
    let first = "pub const N";
    let imported = source.replacen(first, &format!("use evil as libm;\n\n{first}"), 1);
    assert_ne!(imported, source);
    assert!(check(&imported, &robot(), None).is_err());
}

/// Products and sums that are rounded once.
#[test]
fn fused_operations() {
    let source = generated();
    let start = source.find("pub fn gravity(").unwrap();
    let end = start + source[start..].find("}\n").unwrap();
    let body = "pub fn gravity(q: &[f64; 2]) -> [f64; 2] {
    let (s1, c1) = libm::sincos(q[0]);
    let (s2, c2) = libm::sincos(q[1]);
    let t2 = s1 * s2;
    let t3 = c2.mul_add(c1, -t2);
    let t4 = t3 * 4.905;
    let t6 = c1.mul_add(14.715, t4);
    [t6, t4]
";
    let with = |body: &str| format!("{}{body}{}", &source[..start], &source[end..]);
    let fused = report(&with(body));
    let units_fused = units(&fused, "gravity").unwrap();
    assert!(units_fused <= units(&report(&source), "gravity").unwrap() + 1.0);
    let negated = body.replace("c2.mul_add", "(-c2).mul_add");
    assert_eq!(units(&report(&with(&negated)), "gravity"), None);
    let twice = negated.replace("(c1, -t2)", "(-c1, -t2)");
    // Nothing that is printed has both signs.
    assert_eq!(units(&report(&with(&twice)), "gravity"), None);
}

/// Long functions hand values from part to part.
#[test]
fn functions_in_parts() {
    let source = generated();
    let plain = "    let t1 = c2 * c1;\n    let t2 = s1 * s2;\n    let t3 = t1 - t2;\n";
    assert!(source.contains(plain));
    let with = |part: &str| report(&source.replacen(plain, part, 1));
    let part = "    let (t3,) = {\n        let t1 = c2 * c1;\n        let t2 = s1 * s2;\n        let t3 = t1 - t2;\n        (t3,)\n    };\n";
    assert!(units(&with(part), "gravity").is_some());
    for wrong in [
        part.replace("        (t3,)", "        (t2,)"),
        part.replace("let (t3,) =", "let (t2,) ="),
        part.replace("t3,)", "c1,)"),
    ] {
        assert_eq!(units(&with(&wrong), "gravity"), None, "{wrong}");
    }
    // What a part does not hand on is not there.
    let lost =
        source
            .replacen(plain, part, 1)
            .replacen("let t4 = t3 * 4.905;", "let t4 = t2 * 4.905;", 1);
    assert_eq!(units(&report(&lost), "gravity"), None);
}

/// Energies and momenta of the planar arm, by hand.
#[test]
fn functions_that_follow_from_loads() {
    let head = "// Generated by hand.\n\npub mod planar2r {\n";
    let sines = "    let (s2, c2) = libm::sincos(q[1]);\n";
    // D = [[5/3 + c2, 1/3 + c2/2], [·, 1/3]], and the slope of D by q2.
    let inertia = "    let t1 = c2 + 1.6666666666666667;\n    let t2 = c2 * 0.5;\n    let t3 = t2 + 0.3333333333333333;\n";
    let momentum = "    let t4 = t1 * qd[0];\n    let t5 = t3 * qd[1];\n    let t6 = t4 + t5;\n    let t7 = t3 * qd[0];\n    let t8 = qd[1] * 0.3333333333333333;\n    let t9 = t7 + t8;\n";
    let arguments = "(q: &[f64; 2], qd: &[f64; 2])";
    let kinetic = format!(
        "pub fn kinetic_energy{arguments} -> f64 {{\n    let c2 = libm::cos(q[1]);\n{inertia}{momentum}    let t10 = t6 * qd[0];\n    let t11 = t9 * qd[1];\n    let t12 = t10 + t11;\n    let t13 = t12 * 0.5;\n    t13\n}}\n"
    );
    let slope = "    let t10 = s2 * qd[0];\n    let t11 = qd[0] + qd[1];\n    let t12 = t10 * t11;\n    let t13 = t12 * 0.5;\n";
    let momenta = format!(
        "pub struct Momentum {{\n    pub p: [f64; 2],\n    pub ct_qd: [f64; 2],\n}}\npub fn momentum{arguments} -> Momentum {{\n{sines}{inertia}{momentum}{slope}    Momentum {{\n        p: [t6, t9],\n        ct_qd: [0.0, -t13],\n    }}\n}}\n"
    );
    // C = −s2/2·[[q̇2, q̇1 + q̇2], [−q̇1, 0]]
    let matrix = format!(
        "pub fn coriolis_matrix{arguments} -> [[f64; 2]; 2] {{\n    let s2 = libm::sin(q[1]);\n    let t1 = s2 * 0.5;\n    let t2 = t1 * qd[1];\n    let t3 = qd[0] + qd[1];\n    let t4 = t1 * t3;\n    let t5 = t1 * qd[0];\n    [\n        [-t2, -t4],\n        [t5, 0.0],\n    ]\n}}\n"
    );
    let whole = format!("{head}{kinetic}{momenta}{matrix}}}\n");
    let found = report(&whole);
    assert!(found.is_shown() && found.lines.len() == 3, "{found:?}");
    for (from, to) in [
        ("t12 * 0.5;\n    t13", "t12 * 0.6;\n    t13"),
        ("[0.0, -t13]", "[0.0, t13]"),
        ("[-t2, -t4]", "[t2, -t4]"),
    ] {
        assert!(whole.contains(from));
        assert!(!report(&whole.replace(from, to)).is_shown(), "{from}");
    }
}
