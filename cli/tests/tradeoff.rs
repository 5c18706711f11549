//! Accuracy given up on purpose, as a user runs it: scenes with a tolerance,
//! `certify` and `tradeoff`.

use dalembert_codegen::workspace::certificate::format::text_hash;
use std::fs;
use std::path::{Path, PathBuf};

use crate::support::{robot, run, temporary};
use serde_json::Value;

/// Two joints that need little, so that a search is quick.
const SCENES: &str = r#"
[scene.pick]
outputs = ["inverse_dynamics"]
lock = { 1 = 0 }
box = { velocity = [1, 1, 1], acceleration = [1, 2, 2] }
tolerance = { value = 0.1, relative_to = "range" }
scalar = "f64"

[scene.exactly]
outputs = ["gravity"]
tolerance = { value = 1e-17, relative_to = "range" }
scalar = "f64"

[scene.any]
outputs = ["gravity"]
tolerance = { value = [1e-3, 1e-3, 1e-2], relative_to = "range" }
"#;

/// The planar arm of three joints with scenes, in a folder of its own.
fn arm(name: &str) -> (PathBuf, String) {
    let folder = temporary(name);
    let file = folder.join("arm.toml");
    let planar = fs::read_to_string(robot("planar3r")).unwrap();
    fs::write(&file, format!("{planar}{SCENES}")).unwrap();
    let name = file.to_str().unwrap().to_owned();
    (folder, name)
}

fn path(folder: &Path, name: &str) -> String {
    folder.join(name).to_str().unwrap().to_owned()
}

fn json(file: &str) -> Value {
    serde_json::from_str(&fs::read_to_string(file).unwrap()).unwrap()
}

/// The scene's code, its certificate beside it, and both again from a plan.
#[test]
fn a_scene_with_a_tolerance() {
    let (folder, arm) = arm("scene_tolerance");
    let output = path(&folder, "pick.rs");
    let generate = ["generate", &arm, "--scene", "pick", "-o", &output];
    let ran = run(&generate);
    assert_eq!(ran.code, 0, "{}", ran.err);
    for part in [
        "left out, and what putting it back costs",
        "certified",
        "pick.certificate.json",
    ] {
        assert!(ran.err.contains(part), "{part}: {}", ran.err);
    }
    let text = fs::read_to_string(&output).unwrap();
    for part in [
        "pub mod planar3r_pick {",
        "T of an output is a size that it attains in the box",
        "| output | T | E | left out | sin/cos | rounding |",
        "| joint | q | q̇ | q̈ |",
        "bring back:",
    ] {
        assert!(text.contains(part), "{part}\n{text}");
    }
    let file = path(&folder, "pick.certificate.json");
    let certificate = json(&file);
    assert_eq!(certificate["scene"], "pick");
    let total = certificate["total"].as_array().unwrap();
    assert_eq!(total.len(), 2);
    assert!(total.iter().all(|e| e.as_f64().unwrap() <= 0.1));
    assert!(certificate["model"][0].as_f64().unwrap() > 1e-6);

    let certify = ["certify", &file, "--robot", &arm, "--samples", "500"];
    let ran = run(&certify);
    assert_eq!(ran.code, 0, "{}", ran.err);
    assert!(
        ran.out.contains("in scene pick") && ran.out.contains("observed"),
        "{}",
        ran.out
    );
    let verified = run(&["verify", &arm, "--scene", "pick", "--json"]);
    assert_eq!(verified.code, 0, "{}", verified.err);
    let verified: Value = serde_json::from_str(&verified.out).unwrap();
    assert_eq!(verified["certificates"][0]["passed"], true);

    // The plan has the variant and its bounds: the same bytes, nothing searched.
    let ran = run(&[&generate[..], &["--save-plan"]].concat());
    assert_eq!(ran.code, 0, "{}", ran.err);
    let plan = fs::read_to_string(folder.join("arm.plan")).unwrap();
    assert!(
        plan.contains("\nedited\nedit ") && plan.contains("\nbound "),
        "{plan}"
    );
    let ran = run(&[&generate[..], &["--check"]].concat());
    assert_eq!(ran.code, 0, "{}", ran.err);
    // Bounds are found anew.
    let low = plan.replacen("\nbound ", "\nbound 1e-9 0 0\n# ", 1);
    fs::write(folder.join("arm.plan"), low).unwrap();
    let ran = run(&generate);
    assert_ne!(ran.code, 0, "{}", ran.err);
    assert!(ran.err.contains("what can be shown is"), "{}", ran.err);
}

/// By hand: a bound made smaller, a scale made larger, a box made smaller, an
/// edit forgotten, another function's text.
#[test]
fn certificates_made_better_by_hand_are_caught() {
    let (folder, arm) = arm("certificates");
    let good = path(&folder, "good.json");
    let generate = ["generate", &arm, "--scene", "pick", "--certificate", &good];
    assert_eq!(run(&generate).code, 0);
    let honest = json(&good);
    let with = |key: &str, value: Value| {
        let mut lie = honest.clone();
        lie[key] = value;
        if key != "total" {
            // What follows from the parts must.
            let at = |part: &str, i: usize| lie[part][i].as_f64().unwrap_or(0.0);
            let sum = |i| at("model", i) + at("sincos", i) + at("rounding", i);
            lie["total"] = (0..2).map(|i| sum(i) * (1.0 + 1e-15)).collect();
        }
        let file = path(&folder, "lie.json");
        fs::write(&file, lie.to_string()).unwrap();
        run(&["certify", &file, "--robot", &arm])
    };
    let half = |key: &str, factor: f64| {
        let numbers = honest[key].as_array().unwrap().iter();
        numbers
            .map(|x| x.as_f64().unwrap() * factor)
            .collect::<Vec<f64>>()
    };
    for (key, value, why) in [
        ("model", half("model", 0.5).into(), "what can be shown is"),
        (
            "rounding",
            half("rounding", 0.5).into(),
            "what can be shown is",
        ),
        (
            "scale",
            half("scale", 2.0).into(),
            "is larger than what it is said to be",
        ),
        ("acceleration", honest["velocity"].clone(), "box is smaller"),
        ("scene_hash", "0".into(), "another scene"),
        ("input", "0".into(), "another robot"),
        ("robot", "another".into(), "another robot"),
        // A larger claim is true, but not within the scene's tolerance.
        ("model", half("model", 100.0).into(), "is allowed"),
        // Another function than the one that is proved.
        ("function", "coriolis".into(), "not that of the function"),
    ] {
        let ran = with(key, value);
        assert_eq!(ran.code, 1, "{key}: {}", ran.err);
        assert!(ran.err.contains(why), "{key}: {}", ran.err);
    }
    // A text without its hash is no certificate at all.
    let ran = with("text", "".into());
    assert_eq!(ran.code, 2, "{}", ran.err);
    assert!(ran.err.contains("`text_hash` is not"), "{}", ran.err);
    let mut forgotten = honest["stages"].clone();
    forgotten[0]["edits"] = Value::Array(Vec::new());
    let ran = with("stages", forgotten);
    assert!(
        ran.code == 1 && ran.err.contains("not the one that follows"),
        "{}",
        ran.err
    );
    // The function alone, under its own head: what the certificate is about.
    let text = honest["text"].as_str().unwrap();
    for (was, is) in [
        ("(q: ", "(qd: "),
        ("f64; 3]", "f32; 3]"),
        ("#[must_use]", "#[cfg(any())]"),
        ("#[must_use]", "fn more() {}\n#[must_use]"),
        ("\n}\n", "\n}\nfn more() {}\n"),
    ] {
        let lie = text.replacen(was, is, 1);
        assert_ne!(lie, text, "{was}");
        let mut other = honest.clone();
        other["text_hash"] = text_hash(&lie).into();
        other["text"] = lie.into();
        let file = path(&folder, "lie.json");
        fs::write(&file, other.to_string()).unwrap();
        let ran = run(&["certify", &file, "--robot", &arm]);
        assert_eq!(ran.code, 1, "{was}: {}", ran.err);
        assert!(ran.err.contains("the printed text"), "{was}: {}", ran.err);
    }
    // Not what a certificate looks like.
    for (key, value, why) in [
        ("model", Value::from(vec!["a"]), "invalid type"),
        (
            "relative_to",
            "actuators".into(),
            "`actuators` is not known",
        ),
        ("scale", Value::Null, "invalid type: null"),
        // What follows from the rest, or is the same of all.
        ("total", half("total", 0.5).into(), "`total` is not what"),
        (
            "assumptions",
            Vec::<Value>::new().into(),
            "`assumptions` is not",
        ),
        ("method", "trust me".into(), "`method` is not"),
        ("proved_by", "me".into(), "unknown field `proved_by`"),
        ("scene", "pck".into(), "did you mean `pick`?"),
        ("certificate", 7.into(), "version"),
    ] {
        let ran = with(key, value);
        assert_eq!(ran.code, 2, "{key}: {}", ran.err);
        assert!(ran.err.contains(why), "{key}: {}", ran.err);
    }
    for (text, why) in [
        ("", "EOF"),
        ("[]", "no certificate"),
        ("{}", "missing field `certificate`"),
        (
            "{\"certificate\": 2, \"certificate\": 2}",
            "duplicate field",
        ),
    ] {
        let file = path(&folder, "none.json");
        fs::write(&file, text).unwrap();
        let ran = run(&["certify", &file, "--robot", &arm]);
        assert!(
            ran.code == 2 && ran.err.contains(why),
            "{text}: {}",
            ran.err
        );
    }
}

/// The first torque of an arm that stands upright needs nothing against gravity:
/// T is zero, which the code meets, since zero is what it returns.
#[test]
fn an_output_that_is_zero_is_exact() {
    let folder = temporary("upright");
    let file = path(&folder, "arm.toml");
    let puma = fs::read_to_string(robot("puma560")).unwrap();
    let scene = r#"
[scene.hold]
outputs = ["gravity"]
tolerance = { value = 0.1, relative_to = "range" }
"#;
    fs::write(&file, format!("{puma}{scene}")).unwrap();
    let certificate = path(&folder, "hold.json");
    let generate = ["generate", &file, "--scene", "hold", "--certificate"];
    let ran = run(&[&generate[..], &[&certificate]].concat());
    assert_eq!(ran.code, 0, "{}", ran.err);
    let claimed = json(&certificate);
    assert_eq!(
        (&claimed["scale"][0], &claimed["total"][0]),
        (&0.0.into(), &0.0.into())
    );
    // Nor does it keep the others from giving way.
    assert!(claimed["model"][1].as_f64().unwrap() > 1e-6);
    let ran = run(&["certify", &certificate, "--robot", &file]);
    assert_eq!(ran.code, 0, "{}", ran.err);
}

#[test]
fn what_cannot_be_met_or_certified_is_said() {
    let (folder, arm) = arm("refused");
    let ran = run(&["generate", &arm, "--scene", "exactly"]);
    assert_eq!(ran.code, 2);
    assert!(
        ran.err
            .contains("no variant in f64 can be certified to keep c_1 within 1.0e-17"),
        "{}",
        ran.err
    );
    assert!(ran.out.is_empty());

    // Nobody chose a scalar: the narrow one is exact enough.
    let ran = run(&["generate", &arm, "--scene", "any"]);
    assert_eq!(ran.code, 0, "{}", ran.err);
    assert!(
        ran.out.contains("3 joints, in `f32`") && !ran.out.contains("f64"),
        "{}",
        ran.out
    );

    let file = path(&folder, "none.json");
    let ran = run(&[
        "generate",
        &arm,
        "--outputs",
        "gravity",
        "--certificate",
        &file,
    ]);
    assert!(
        ran.code == 2 && ran.err.contains("nothing to certify"),
        "{}",
        ran.err
    );
}

/// Every mistake in a scene ends with its line, whichever subcommand reads it.
#[test]
fn bad_scenes_name_the_line() {
    let folder = temporary("bad_scenes");
    let file = folder.join("arm.toml");
    let planar = fs::read_to_string(robot("planar3r")).unwrap();
    let name = file.to_str().unwrap();
    let good = r#"tolerance = { value = 0.1, relative_to = "range" }"#;
    for (scene, words) in [
        (
            "box = { position = [[1, 1], [0, 1], [0, 1]] }",
            "the range is empty",
        ),
        ("box = { velocity = [1, -1, 1] }", "the range is empty"),
        (
            "box = { velocity = [1, 1] }",
            "2 entries, but the robot has 3 joints",
        ),
        ("joints = [4]", "there is no joint `4`"),
        ("lock = { elbw = 0 }", "did you mean `elbow`?"),
        ("lock = { 2 = 4 }", "locked outside its limits"),
        (
            r#"tolerance = { value = 0, relative_to = "range" }"#,
            "above zero",
        ),
        (
            r#"tolerance = { value = -1e-3, relative_to = "range" }"#,
            "above zero",
        ),
        (
            r#"tolerance = { value = [1, 1], relative_to = "range" }"#,
            "2 tolerances",
        ),
        ("tolerance = { value = 1e-3 }", "has no `relative_to`"),
        (good, "needs the range of the velocity of joint 1"),
        (
            r#"tolerance = { value = 0.1, relative_to = "actuator" }"#,
            "needs the torque limit of joint 1",
        ),
    ] {
        let source = format!("{planar}\n[scene.bad]\n{scene}\n");
        fs::write(&file, &source).unwrap();
        let line = source.lines().count();
        for subcommand in ["generate", "tradeoff"] {
            let ran = run(&[subcommand, name, "--scene", "bad"]);
            assert_eq!(ran.code, 2, "{scene}: {}", ran.err);
            assert!(ran.err.contains(words), "{scene}: {}", ran.err);
            assert!(
                ran.err.contains(&format!("arm.toml:{line}:")),
                "{scene}: {}",
                ran.err
            );
        }
    }
}

#[test]
fn a_tradeoff_with_table_chart_and_certificates() {
    let (folder, arm) = arm("tradeoff");
    let output = path(&folder, "out");
    let arguments = [
        "tradeoff",
        &arm,
        "--scene",
        "pick",
        "--tolerances",
        "1e-9,0.1,0.2",
        "--samples",
        "300",
        "-o",
        &output,
    ];
    let ran = run(&arguments);
    assert_eq!(ran.code, 0, "{}", ran.err);
    let csv = fs::read_to_string(path(&folder, "out/tradeoff.csv")).unwrap();
    let rows: Vec<Vec<&str>> = csv.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!(rows[0][..3], ["tolerance", "scalar", "sincos_by"]);
    let column = |name: &str| rows[0].iter().position(|head| *head == name).unwrap();
    let (mul, add) = (column("mul"), column("add"));
    let operations =
        |row: &[&str]| row[mul].parse::<usize>().unwrap() + row[add].parse::<usize>().unwrap();
    let mut last = usize::MAX;
    for row in rows[1..].iter().filter(|row| row[1] == "f64") {
        let number = |name: &str| row[column(name)].parse::<f64>().unwrap();
        assert!(number("observed") <= number("certified"), "{row:?}");
        let tolerance = number("tolerance");
        assert!(
            tolerance == 0.0 || number("certified") <= tolerance,
            "{row:?}"
        );
        assert!(operations(row) <= last, "{csv}");
        last = operations(row);
    }
    assert!(
        last < operations(&rows[1]),
        "nothing was given up for 0.2: {csv}"
    );
    let svg = fs::read_to_string(path(&folder, "out/tradeoff.svg")).unwrap();
    assert!(svg.starts_with("<svg ") && svg.ends_with("</svg>\n"));
    for part in [
        "@media screen and (prefers-color-scheme:dark)",
        "f64, libm",
        "f32, libm",
        "relative to the largest torques",
    ] {
        assert!(svg.contains(part), "{part}");
    }
    let certificate = path(&folder, "out/certificates/2e-1-f64.json");
    let certify = ["certify", &certificate, "--robot", &arm];
    let again = run(&[&certify[..], &["--tolerance", "2e-1"]].concat());
    assert_eq!(again.code, 0, "{}", again.err);
    let again = run(&[&certify[..], &["--tolerance", "1e-6"]].concat());
    assert_eq!(again.code, 1, "{}", again.err);
    assert!(again.err.contains("is allowed"), "{}", again.err);

    // A line a rung where there is no terminal; nothing of the work is left.
    for line in ["tolerance 2e-1: ", "tolerance 1e-9: ", "tolerance 0e0: "] {
        assert!(ran.err.contains(line), "{line}: {}", ran.err);
    }
    assert!(!folder.join("out/rungs").exists());

    // The same bytes on every run.
    assert_eq!(run(&arguments).code, 0);
    assert_eq!(
        fs::read_to_string(path(&folder, "out/tradeoff.csv")).unwrap(),
        csv
    );
    assert_eq!(
        fs::read_to_string(path(&folder, "out/tradeoff.svg")).unwrap(),
        svg
    );
}

/// A run that ends after two rungs leaves them, the next one goes on from there
/// to the same bytes; what is damaged or of another run is refused.
#[test]
fn a_tradeoff_goes_on_where_it_was() {
    let (folder, arm) = arm("resumed");
    let output = path(&folder, "out");
    let rung = |tolerance: &str| folder.join(format!("out/rungs/{tolerance}.json"));
    let with = |more: &[&str]| {
        let arguments = ["tradeoff", &arm, "--scene", "pick", "-o", &output];
        let arguments = [&arguments[..], &["--tolerances", "0.1,0.2"], more].concat();
        run(&arguments)
    };
    let whole = with(&["--samples", "100"]);
    assert_eq!(whole.code, 0, "{}", whole.err);
    let csv = fs::read_to_string(path(&folder, "out/tradeoff.csv")).unwrap();
    fs::remove_dir_all(&output).unwrap();

    // A folder in the place of the last rung ends the run there.
    fs::create_dir_all(rung("0e0").with_extension("unfinished")).unwrap();
    let ended = with(&["--samples", "100"]);
    assert_eq!(ended.code, 2, "{}", ended.err);
    assert!(
        ended.err.contains("0e0.json` cannot be written"),
        "{}",
        ended.err
    );
    fs::remove_dir(rung("0e0").with_extension("unfinished")).unwrap();
    let kept = fs::read_to_string(rung("2e-1")).unwrap();
    assert!(rung("1e-1").exists() && !rung("0e0").exists());

    let refused = |words: &str, more: &[&str]| {
        let ran = with(more);
        assert_eq!(ran.code, 2, "{words}: {}", ran.err);
        assert!(ran.err.contains(words), "{words}: {}", ran.err);
        assert!(
            ran.err.contains("2e-1.json") && ran.err.contains("delete it"),
            "{}",
            ran.err
        );
    };
    let other = "is of another robot, scene, plan, version or options";
    refused(other, &["--samples", "99"]);
    fs::write(rung("2e-1"), &kept[..kept.len() / 2]).unwrap();
    refused("is damaged", &["--samples", "100"]);
    fs::write(
        rung("2e-1"),
        kept.replacen("\"fruitful\":true", "\"fruitful\":false", 1),
    )
    .unwrap();
    refused("its hash is not that", &["--samples", "100"]);
    fs::write(rung("2e-1"), &kept).unwrap();

    let resumed = with(&["--samples", "100"]);
    assert_eq!(resumed.code, 0, "{}", resumed.err);
    for line in [
        "tolerance 2e-1, kept by an earlier run: ",
        "tolerance 1e-1, kept by an earlier run: ",
        "tolerance 0e0: ",
    ] {
        assert!(resumed.err.contains(line), "{line}: {}", resumed.err);
    }
    assert_eq!(resumed.out, whole.out);
    let again = fs::read_to_string(path(&folder, "out/tradeoff.csv")).unwrap();
    assert_eq!(again, csv);
    assert!(!folder.join("out/rungs").exists());
}

/// Where nothing is run nothing was observed, not even zero.
#[test]
fn nothing_is_observed_at_no_states() {
    let (folder, arm) = arm("unobserved");
    let output = path(&folder, "out");
    let ran = run(&[
        "tradeoff",
        &arm,
        "--scene",
        "any",
        "--tolerances",
        "0.1",
        "--samples",
        "0",
        "-o",
        &output,
    ]);
    assert_eq!(ran.code, 0, "{}", ran.err);
    let csv = fs::read_to_string(path(&folder, "out/tradeoff.csv")).unwrap();
    let rows: Vec<Vec<&str>> = csv.lines().map(|line| line.split(',').collect()).collect();
    for (column, head) in rows[0].iter().enumerate() {
        if head.contains("observed") {
            assert!(rows[1..].iter().all(|row| row[column].is_empty()), "{csv}");
        }
    }
    for line in ran.out.lines().skip(1) {
        assert!(line.split_whitespace().any(|cell| cell == "–"), "{line}");
    }
    let svg = fs::read_to_string(path(&folder, "out/tradeoff.svg")).unwrap();
    assert!(!svg.contains("observed"), "{svg}");
}

/// The variants compile, run, and are compared with the exact one. What comes
/// out depends on the machine: only that it is there is tested.
#[test]
fn variants_are_measured() {
    let folder = temporary("measured");
    let output = path(&folder, "out");
    let ran = run(&[
        "tradeoff",
        &robot("planar2r"),
        "--function",
        "gravity",
        "--relative-to",
        "range",
        "--tolerances",
        "0.1",
        "--samples",
        "50",
        "--measure",
        "-o",
        &output,
    ]);
    assert_eq!(ran.code, 0, "{}", ran.err);
    let csv = fs::read_to_string(path(&folder, "out/tradeoff.csv")).unwrap();
    let rows: Vec<Vec<&str>> = csv.lines().map(|line| line.split(',').collect()).collect();
    let column = |name: &str| rows[0].iter().position(|head| *head == name).unwrap();
    let (time, ratio) = (column("ns"), column("time"));
    assert_eq!(rows[1][..3], ["0e0", "f64", "libm"]);
    assert_eq!(rows[1][ratio], "1.000");
    assert!(rows.iter().any(|row| row[2] == "polynomials"), "{csv}");
    for row in &rows[1..] {
        for cell in [row[time], row[ratio]] {
            let number: f64 = cell.parse().unwrap();
            assert!(number.is_finite() && number > 0.0, "{csv}");
        }
    }
    let head: Vec<&str> = ran.out.lines().next().unwrap().split_whitespace().collect();
    assert!(head.ends_with(&["ns", "time", "front"]), "{}", ran.out);
}

#[test]
fn tradeoff_says_what_it_lacks() {
    let (_, arm) = arm("tradeoff_lacks");
    for (arguments, words) in [
        (vec![], "joint 1 has no limit `velocity`"),
        (
            vec!["--function", "gravity"],
            "joint 1 has no limit `torque`",
        ),
        (vec!["--scene", "pik"], "did you mean `pick`?"),
        (
            vec!["--scene", "pick", "--tolerances", "0"],
            "a number above zero, not 0",
        ),
        (
            vec!["--scene", "pick", "--tolerances", "nan"],
            "a number above zero, not NaN",
        ),
        (vec!["--scene", "pick", "--relative-to", "rang"], "'range'"),
    ] {
        let ran = run(&[&["tradeoff", &arm][..], &arguments].concat());
        assert_eq!(ran.code, 2, "{arguments:?}: {}", ran.err);
        assert!(ran.err.contains(words), "{arguments:?}: {}", ran.err);
    }
}
