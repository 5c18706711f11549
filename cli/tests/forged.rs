//! Certificates that somebody made better by hand.

use std::fs;

use dalembert_codegen::workspace::certificate::format::text_hash;
use serde_json::Value;

use crate::support::planar::{arm, json, path};
use crate::support::run;

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
