//! Rounding, bounded by a tool of others: `certify --gappa` writes the scripts;
//! where Gappa is installed, it finds no more than a few times our bound, and no
//! error that was seen is above its.

use std::fs;
use std::process::Command;

use crate::support::{robot, run, temporary};
use dalembert_codegen::workspace::certificate::format;

/// Exact but for rounding, in a box.
const SCENE: &str = r#"
[scene.box]
outputs = ["inverse_dynamics"]
scalar = "f64"
box = { velocity = [2, 2], acceleration = [10, 10] }
tolerance = { value = 1e-13, relative_to = "range" }
"#;

#[test]
fn scripts_of_a_planar_arm() {
    let folder = temporary("gappa");
    let path = |name: &str| folder.join(name).to_str().unwrap().to_owned();
    let (file, claim, scripts) = (path("arm.toml"), path("arm.json"), path("scripts"));
    let planar = fs::read_to_string(robot("planar2r")).unwrap();
    fs::write(&file, format!("{planar}{SCENE}")).unwrap();
    let generate = ["generate", &file, "--scene", "box", "--sincos", "libm"];
    let ran = run(&[&generate[..], &["--certificate", &claim]].concat());
    assert_eq!(ran.code, 0, "{}", ran.err);
    let ran = run(&["certify", &claim, "--robot", &file, "--gappa", &scripts]);
    assert_eq!(ran.code, 0, "{}", ran.err);
    let claims = format::read(&fs::read_to_string(&claim).unwrap()).unwrap();
    let claim = &claims[0];
    for output in 0..2 {
        let script = format!("{scripts}/inverse_dynamics_f64_{}.g", output + 1);
        let text = fs::read_to_string(&script).unwrap();
        for part in [
            "@rnd = float<ieee_64, ne>;",
            "t1 rnd= ",
            "\nT1 = ",
            "|s2 - S2| <= 1",
            "in ? }",
        ] {
            assert!(text.contains(part), "{part}\n{text}");
        }
        let Ok(gappa) = Command::new("gappa").arg(&script).output() else {
            println!("gappa is not installed: the script is written, not run");
            continue;
        };
        let said = String::from_utf8_lossy(&gappa.stderr).into_owned()
            + &String::from_utf8_lossy(&gappa.stdout);
        assert!(gappa.status.success(), "{said}");
        // … in [-1b-40 {-9.1e-13, -2^(-40)}, 1b-40 {9.1e-13, 2^(-40)}]
        let found = said.rsplit('{').next().unwrap().split(',').next().unwrap();
        let found: f64 = found.trim().parse().unwrap_or_else(|_| panic!("{said}"));
        let bound = claim.bounds[output];
        let ours = (bound.sincos + bound.rounding) * claim.scales[output];
        println!("output {}: ours {ours:e}, gappa's {found:e}", output + 1);
        // Two sound bounds of the same error by different means.
        assert!(
            ours <= 8.0 * found && found <= 8.0 * ours,
            "{ours:e} {found:e}"
        );
    }
}
