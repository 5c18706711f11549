//! Certificates that somebody made better by hand.

use std::fs;

use serde_json::Value;

use crate::support::{arm, good, run};

const SCENE: &str = r#"
[scene.pick]
outputs = ["inverse_dynamics"]
lock = { 1 = 0 }
box = { velocity = [1, 1, 1], acceleration = [1, 2, 2] }
tolerance = { value = 0.1, relative_to = "range" }
scalar = "f64"
"#;

const ROUGH: &str = r#"
[scene.rough]
outputs = ["inverse_dynamics"]
box = { position = [[-3, 3], [0.2, 2.8]], velocity = [2, 3], acceleration = [10, 20] }
tolerance = { value = 1e-4, relative_to = "range" }
scalar = "f64"
"#;

/// By hand: a bound made smaller, a scale made larger, a box made smaller, another
/// function's name or text.
#[test]
fn certificates_made_better_by_hand_are_caught() {
    let (folder, arm) = arm("certificates", "planar3r", SCENE);
    let path = |name: &str| folder.join(name).to_str().unwrap().to_owned();
    good(&["generate", &arm, "--scene", "pick", "-o", &path("pick.rs")]);
    let honest = fs::read_to_string(path("pick.certificate.json")).unwrap();
    let honest: Value = serde_json::from_str(&honest).unwrap();
    let checked = |lie: &str| {
        let file = path("lie.json");
        fs::write(&file, lie).unwrap();
        run(&["certify", &file, "--robot", &arm])
    };
    assert_eq!(checked(&honest.to_string()).code, 0);
    let with = |key: &str, value: Value| {
        let mut lie = honest.clone();
        lie[key] = value;
        checked(&lie.to_string())
    };
    let half = |key: &str, factor: f64| {
        let numbers = honest[key].as_array().unwrap().iter();
        numbers
            .map(|x| x.as_f64().unwrap() * factor)
            .collect::<Vec<f64>>()
    };
    // A state is found at which the text errs more.
    let ran = with("total", half("total", 0.5).into());
    assert_eq!(ran.code, 1, "{}{}", ran.out, ran.err);
    ran.prints(&["E is refuted at a state"]);
    for (key, value, why) in [
        (
            "scale",
            half("scale", 2.0).into(),
            "the largest that is reached",
        ),
        (
            "acceleration",
            honest["velocity"].clone(),
            "the box lacks states",
        ),
        (
            "position",
            half_ranges(&honest["position"]),
            "the box lacks states",
        ),
        // Another function than the text's.
        (
            "function",
            "coriolis".into(),
            "not of the grammar or the claim",
        ),
        ("scalar", "f32".into(), "not of the grammar or the claim"),
        ("relative_to", "actuator".into(), "is not that of the scene"),
        ("rows", vec![3, 2].into(), "`rows` are not those"),
        ("text", "".into(), "not of the grammar or the claim"),
    ] {
        let ran = with(key, value);
        assert_eq!(ran.code, 1, "{key}: {}", ran.err);
        assert!(ran.err.contains(why), "{key}: {}", ran.err);
    }
    // The function alone, under its own head: what the certificate is about.
    let text = honest["text"].as_str().unwrap();
    for (was, is) in [
        ("(q: ", "(qd: "),
        ("f64; 3]", "f32; 3]"),
        ("#[must_use]", "#[cfg(any())]"),
        ("#[must_use]", "fn more() {}\n#[must_use]"),
        ("\n}\n", "\n}\nfn more() {}\n"),
        (" * ", " / "),
    ] {
        let lie = text.replacen(was, is, 1);
        assert_ne!(lie, text, "{was}");
        let ran = with("text", lie.into());
        assert_eq!(ran.code, 1, "{was}: {}", ran.err);
        assert!(ran.err.contains("not of the grammar"), "{was}: {}", ran.err);
    }
    // Not what a certificate looks like.
    for (key, value, why) in [
        ("total", Value::from(vec!["a"]), "invalid type"),
        ("scale", Value::Null, "invalid type: null"),
        ("scene", "pck".into(), "there is no such scene"),
    ] {
        let ran = with(key, value);
        assert_eq!(ran.code, 2, "{key}: {}", ran.err);
        assert!(ran.err.contains(why), "{key}: {}", ran.err);
    }
    let ran = with("certificate", 7.into());
    assert!(ran.code == 1 && ran.err.contains("format 2"), "{}", ran.err);
    for (text, why) in [
        ("", "EOF"),
        ("[]", "1 to 16 in a file"),
        ("{}", "missing field `certificate`"),
        (
            "{\"certificate\": 2, \"certificate\": 2}",
            "duplicate field",
        ),
    ] {
        let ran = checked(text);
        assert!(
            ran.code == 2 && ran.err.contains(why),
            "{text}: {}",
            ran.err
        );
    }
}

/// Returns the same ranges, half as long.
fn half_ranges(ranges: &Value) -> Value {
    let half = |range: &Value| [0, 1].map(|end| range[end].as_f64().unwrap() * 0.5);
    let each = ranges.as_array().unwrap().iter().map(half);
    each.map(|range| Value::from(range.to_vec())).collect()
}

/// The certificate of a scene carries its polynomials, and `certify` proves
/// them from the text.
#[test]
fn certified_again_from_the_text() {
    let (folder, arm) = arm("sines", "planar2r", ROUGH);
    let arm = arm.as_str();
    let code = folder.join("arm.rs");
    good(&[
        "generate",
        arm,
        "--scene",
        "rough",
        "-o",
        code.to_str().unwrap(),
    ]);
    let mut files = fs::read_dir(&folder).unwrap().map(|f| f.unwrap().path());
    let kept = files
        .find(|f| f.extension().is_some_and(|e| e == "json"))
        .unwrap();
    let check = |name: &str, text: &str| {
        let path = folder.join(name);
        fs::write(&path, text).unwrap();
        run(&["certify", path.to_str().unwrap(), "--robot", arm])
    };
    let honest = fs::read_to_string(&kept).unwrap();
    assert!(honest.contains("\"polynomials\""));
    let ran = check("honest.json", &honest);
    assert_eq!(ran.code, 0, "{}", ran.err);

    // A coefficient of a polynomial, twice as large.
    let start = honest.find("let x").unwrap();
    let start = start + honest[start..].find("* 0.").unwrap() + "* ".len();
    let end = start + honest[start..].find(';').unwrap();
    let coefficient: f64 = honest[start..end].parse().unwrap();
    let moved = format!(
        "{}{:?}{}",
        &honest[..start],
        coefficient * 2.0,
        &honest[end..]
    );
    let ran = check("lie.json", &moved);
    assert_eq!(ran.code, 1, "{}", ran.out);
    assert!(
        ran.out.contains("refuted") || ran.out.contains("not shown"),
        "{}",
        ran.out
    );
}
