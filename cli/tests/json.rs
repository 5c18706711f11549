//! `--json`: every subcommand has it, and says there what it says to people.

use std::fs;

use crate::support::{good, robot, run, temporary};
use serde_json::Value;

/// Runs with `--json` and reads what comes out.
fn json(arguments: &[&str]) -> Value {
    let ran = good(&[arguments, &["--json"]].concat());
    serde_json::from_str(&ran.out).unwrap_or_else(|e| panic!("{arguments:?}: {e}\n{}", ran.out))
}

#[test]
fn every_subcommand_has_it() {
    let help = run(&["--help"]).out;
    let commands = help.split("Commands:\n").nth(1).unwrap();
    let commands = commands.split("\n\n").next().unwrap();
    let mut names = Vec::new();
    for line in commands.lines() {
        let name = line.split_whitespace().next().unwrap();
        // A shell's script has a form of its own.
        let reports = !["help", "completions"].contains(&name);
        if line.starts_with("  ") && !line.starts_with("   ") && reports {
            let help = run(&[name, "--help"]).out;
            assert!(help.contains("--json"), "{name} has no --json");
            names.push(name.to_owned());
        }
    }
    assert!(names.len() >= 10, "{names:?}");
}

#[test]
fn import_says_what_it_took_for_others() {
    let folder = temporary("json_import");
    let file = folder.join("ur5.toml");
    let file = file.to_str().unwrap();
    let urdf = format!(
        "{}/../import/tests/data/ur5.urdf",
        env!("CARGO_MANIFEST_DIR")
    );
    let said = json(&["import", &urdf, "--tip", "tool0", "-o", file]);
    assert_eq!(said["robot"], "ur5");
    assert_eq!(said["joints"].as_array().unwrap().len(), 6);
    let taken = said["taken_for_others"].as_array().unwrap();
    assert!(
        taken
            .iter()
            .any(|snap| snap["from"] == "1.57079632679" && snap["to"] == "pi/2")
    );
    assert!(taken.iter().all(|snap| snap["line"].as_u64().unwrap() > 0));
    let change = &said["change"];
    assert!(change["of_efforts"].as_f64().unwrap() < 1e-9);
    assert_eq!(change["joints"].as_array().unwrap().len(), 6);
    // The file is as without it, and reads as the robot that was said.
    let plain = run(&["import", &urdf, "--tip", "tool0"]);
    assert_eq!(fs::read_to_string(file).unwrap(), plain.out);
    let counted = json(&["count", file, "--outputs", "gravity"]);
    assert_eq!(counted["input"], said["input"]);
    // Two documents on one stream are none.
    let both = run(&["import", &urdf, "--json"]);
    assert_eq!(both.code, 2, "{}", both.err);
    assert!(both.err.contains("--output"), "{}", both.err);
}

/// A warning in the document is a warning: denied, it leaves no file, but is still in the document.
#[test]
fn import_writes_nothing_for_denied_warnings() {
    let folder = temporary("json_denied");
    let file = folder.join("arm.toml");
    let file = file.to_str().unwrap();
    let gallery = |name: &str| format!("{}/../gallery/urdf/{name}", env!("CARGO_MANIFEST_DIR"));
    let urdf = gallery("gen3_lite.urdf");
    for (all, output) in [(None, file), (Some("--all"), folder.to_str().unwrap())] {
        let mut arguments = vec!["import", &urdf, "--deny-warnings", "--json", "-o", output];
        arguments.extend(all);
        let denied = run(&arguments);
        denied.ends(1, &["--deny-warnings takes them for errors"]);
        let document: Value = serde_json::from_str(&denied.out).unwrap();
        let arm = all.map_or(&document, |_| &document["arms"][0]);
        let mut notes = arm["notes"].as_array().unwrap().iter();
        assert!(
            notes.any(|note| note["severity"] == "warning"),
            "{document}"
        );
        assert_eq!(fs::read_dir(&folder).unwrap().count(), 0);
    }
    good(&["import", &urdf, "--json", "-o", file]);
    let quiet = gallery("m1013.urdf");
    good(&["import", &quiet, "--deny-warnings", "--json", "-o", file]);
}

#[test]
fn show_says_where_everything_is() {
    let planar = robot("planar2r");
    let said = json(&["show", &planar, "--at", "0,pi/2"]);
    // Stretched to (1, 0), then up: the hand at (1, 1), turned by 90 degrees.
    let expected = [
        [0.0, -1.0, 0.0, 1.0],
        [1.0, 0.0, 0.0, 1.0],
        [0.0, 0.0, 1.0, 0.0],
    ];
    for (row, expected) in expected.iter().enumerate() {
        for (column, expected) in expected.iter().enumerate() {
            let found = said["hand"][row][column].as_f64().unwrap();
            assert!((found - expected).abs() < 1e-15, "{}", said["hand"]);
        }
    }
    assert_eq!(said["links"][1]["pose"], said["hand"]);
    assert_eq!(said["links"][0]["joint"], "shoulder");
    let file = temporary("json_show").join("arm.svg");
    json(&["show", &planar, "-o", file.to_str().unwrap()]);
    assert_eq!(
        fs::read_to_string(file).unwrap(),
        run(&["show", &planar]).out
    );
}

#[test]
fn new_says_what_it_made() {
    let folder = temporary("json_new").join("my_arm");
    let said = json(&["new", folder.to_str().unwrap()]);
    assert_eq!(
        (&said["crate"], &said["robot"]),
        (&"my_arm".into(), &"planar".into())
    );
    let files = said["files"].as_array().unwrap();
    assert_eq!(files.len(), 4);
    for file in files {
        assert!(folder.join(file.as_str().unwrap()).is_file(), "{file}");
    }
}

#[test]
fn generate_and_certify_say_what_is_bounded() {
    let folder = temporary("json_generate");
    let at = |name: &str| folder.join(name).to_str().unwrap().to_owned();
    let scene = "\n[scene.hold]\noutputs = [\"gravity\"]\n\
                 tolerance = { value = 1e-2, relative_to = \"range\" }\n";
    let text = fs::read_to_string(robot("planar2r")).unwrap();
    fs::write(at("arm.toml"), text + scene).unwrap();

    let exact = json(&[
        "generate",
        &at("arm.toml"),
        "--outputs",
        "gravity",
        "-o",
        &at("arm.rs"),
    ]);
    let gravity = &exact["functions"]["gravity"];
    assert_eq!(gravity["counts"]["mul"], 4);
    assert_eq!(gravity["proof"]["failure_exponent"], -36);
    assert!(gravity["errors_in_u"]["f64"]["normwise"].as_f64().unwrap() < 100.0);
    assert_eq!(gravity["tolerance"], Value::Null);
    assert!(
        fs::read_to_string(at("arm.rs"))
            .unwrap()
            .contains("pub fn gravity")
    );
    // So does what renews it.
    let renewed = json(&["renew", &at("arm.rs"), "--check"]);
    assert_eq!(renewed["files"][0]["became"], "up to date");

    let pick = [
        "generate",
        &at("arm.toml"),
        "--scene",
        "hold",
        "--scalar",
        "f64",
        "-o",
    ];
    let admitted = json(&[&pick[..], &[&at("hold.rs")]].concat());
    let claimed = &admitted["functions"]["gravity"]["tolerance"]["certificates"][0]["bounds"];
    let certificate = at("hold.certificate.json");
    let checked = json(&["certify", &certificate, "--robot", &at("arm.toml")]);
    assert_eq!(checked["passed"], true);
    let outputs = checked["certificates"][0]["outputs"].as_array().unwrap();
    assert_eq!(outputs.len(), claimed.as_array().unwrap().len());
    for (output, claimed) in outputs.iter().zip(claimed.as_array().unwrap()) {
        let number = |key: &str| output[key].as_f64().unwrap();
        let e = claimed["E"].as_f64().unwrap();
        assert!((number("E") - e).abs() <= 1e-12 * e, "{output}");
        assert!(e > 0.0 && e <= 1e-2 && number("seen") <= e, "{output}");
        assert!(number("bound") <= number("tolerance"), "{output}");
    }
}

#[test]
fn tradeoff_lists_its_variants() {
    let said = json(&[
        "tradeoff",
        &robot("planar2r"),
        "--function",
        "gravity",
        "--relative-to",
        "range",
        "--tolerances",
        "1e-3",
        "--samples",
        "20",
    ]);
    assert_eq!(said["relative_to"], "range");
    let variants = said["variants"].as_array().unwrap();
    assert!(variants.len() > 2, "{said:#}");
    for variant in variants {
        let [tolerance, certified] =
            ["tolerance", "certified"].map(|key| variant[key].as_f64().unwrap());
        // Of the exact program, what rounding costs.
        assert!(certified <= tolerance.max(1e-5), "{variant}");
        assert!(variant["counts"]["mul"].as_u64().unwrap() <= 4);
    }
    assert!(variants.iter().any(|variant| variant["front"] == true));
}
