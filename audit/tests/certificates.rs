//! True certificates are shown.

use crate::support::audited;

const SCARA: &str = "cli/tests/data/attacks/scara.toml";

/// How many outputs are shown to be within their E.
fn held(certificate: &str, robot: &str) -> usize {
    let verdict = audited(certificate, robot).unwrap();
    assert!(verdict.is_shown(), "{certificate}: {verdict}");
    verdict.outputs.iter().filter(|output| output.holds()).count()
}

fn held_of(name: &str, robot: &str) -> usize {
    held(&format!("audit/tests/data/{name}.json"), robot)
}

#[test]
fn those_that_are_checked_in() {
    for name in ["actuator-1e-3", "range-1e-2"] {
        let certificate = format!("generated/certificates/puma560-{name}.json");
        assert_eq!(held(&certificate, "generated/robots/puma560.toml"), 6, "{name}");
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
    let verdict = audited("audit/tests/data/scara-lockp.json", SCARA).unwrap();
    for output in &verdict.outputs {
        assert!(output.seen <= output.bound());
        assert!(output.bound() <= 3.0 * output.seen, "{output:?}");
    }
}
