//! True certificates are shown.

use dalembert_checker::audit;

use crate::support::{audited, claim, file};

const SCARA: &str = "cli/tests/data/attacks/scara.toml";

/// Returns how many outputs are shown to be within their E.
fn held(certificate: &str, robot: &str) -> usize {
    let verdict = audited(certificate, robot).unwrap();
    assert!(verdict.is_shown(), "{certificate}: {verdict:?}");
    verdict
        .outputs
        .iter()
        .filter(|output| output.holds())
        .count()
}

fn held_of(name: &str, robot: &str) -> usize {
    held(&format!("checker/tests/data/{name}.json"), robot)
}

#[test]
fn those_that_are_checked_in() {
    for name in ["actuator-1e-3", "range-1e-2"] {
        let certificate = format!("generated/certificates/puma560-{name}.json");
        assert_eq!(
            held(&certificate, "generated/robots/puma560.toml"),
            6,
            "{name}"
        );
    }
}

/// A joint that slides, and sines by polynomials, in both scalars.
#[test]
fn the_stanford_arms() {
    let robot = "generated/robots/stanford.toml";
    assert_eq!(held_of("stanford-swing", robot), 6);
    assert_eq!(held_of("stanford-swing-f32", robot), 6);
}

/// Seven joints, modified convention.
#[test]
fn the_pandas() {
    assert_eq!(held_of("panda-swing", "generated/robots/panda.toml"), 7);
}

/// Three parallel axes and sines by polynomials.
#[test]
fn the_ur10s() {
    assert_eq!(held_of("ur10-swing", "generated/robots/ur10.toml"), 6);
}

/// Of outputs that nothing was left out of, E is a bound of rounding that is tighter.
#[test]
fn other_functions_and_scenes() {
    assert_eq!(held_of("scara-a1", SCARA), 3);
    assert_eq!(held_of("scara-lockp", SCARA), 2);
    assert_eq!(held_of("scara-narrow", SCARA), 3);
    assert!(held_of("scara-allfn-gravity", SCARA) >= 3);
    assert!(held_of("scara-allfn-inertia", SCARA) >= 8);
    assert!(held_of("scara-allfn-coriolis", SCARA) >= 3);
    held_of("scara-a3-f32-together", SCARA);
    held_of("planar2r-pick", "cli/tests/data/attacks/r2_conf.toml");
}

/// What is seen at states is never above the bound, and not far below either.
#[test]
fn bounds_are_near_what_is_seen() {
    let verdict = audited("checker/tests/data/scara-lockp.json", SCARA).unwrap();
    for output in &verdict.outputs {
        assert!(output.found.seen.off <= output.found.bound());
        assert!(
            output.found.bound() <= 3.0 * output.found.seen.off,
            "{output:?}"
        );
    }
}

/// Returns the bound of the planar arm's second load of gravity by polynomials for sines and
/// cosines, with a number added.
fn with_polynomials(added: &str) -> f64 {
    let block = |angle: &str| {
        let lines = [
            format!("let x1 = {angle} * {angle};"),
            "let x2 = x1 * 0.024872349639519818;".into(),
            "let x3 = x2 - 0.44221922089084154;".into(),
            "let x4 = x1 * x3;".into(),
            "let x5 = x4 + 0.9694748258918657;".into(),
            "let x6 = x1 * 0.16666666666666666;".into(),
            "let x7 = 1.0 - x6;".into(),
            format!("let x8 = {angle} * x7;"),
        ];
        lines.join("\n")
    };
    let (first, second) = (block("q[0]"), block("q[1]"));
    let mut claim = claim("checker/tests/data/planar2r-pick.json");
    claim.function = "gravity".into();
    claim.scene = None;
    claim.total = vec![Some(0.0); 2];
    claim.position[1] = [-0.5, 0.5];
    claim.text = format!(
        "pub fn gravity(q: &[f64; 2]) -> [f64; 2] {{
    let (s1, c1) = {{\n{first}\n(x8, x5)\n}};
    let (s2, c2) = {{\n{second}\n(x8, x5)\n}};
    let t1 = c1 * c2;
    let t2 = s1 * s2;
    let t3 = t1 - t2;
    let t4 = t3 * 4.905;
    let t5 = t4 + {added};
    let t6 = c1 * 14.715;
    let t7 = t4 + t6;
    [t7, t5]\n}}"
    );
    let robot = file("cli/tests/data/attacks/r2_conf.toml");
    let robot = robot.replacen(
        "limits = { position = [\"-pi\", \"pi\"]",
        "limits = { position = [-1, 1]",
        1,
    );
    let robot = robot.replacen(
        "limits = { position = [\"-pi\", \"pi\"]",
        "limits = { position = [-0.5, 0.5]",
        1,
    );
    claim.position[0] = [-1.0, 1.0];
    audit(&claim, &robot, Some(1e-3)).unwrap().outputs[1]
        .found
        .bound()
}

/// However many sines are polynomials, their errors count in either direction.
#[test]
fn errors_of_many_sines() {
    let none = with_polynomials("0.0");
    assert!((0.3..0.32).contains(&none), "{none}");
    for added in ["0.1", "-0.1"] {
        let bound = with_polynomials(added);
        assert!((bound - none - 0.1).abs() < 1e-3, "{added}: {bound} {none}");
    }
}
