//! The strict reader of given states.

use dalembert_cli::states::file::{FileError, read};
use dalembert_codegen::workspace::Quantity;

#[test]
fn unknown_keys_are_errors_with_the_likely_word() {
    let zero = r#""q": [0, 0], "qd": [0, 0], "qdd": [0, 0]"#;
    let file = |keys: &str| format!(r#"{{"robot": 1, "states": [{{{zero}, {keys}}}]}}"#);
    for (keys, meant) in [
        (
            r#""torque": [1, 2]"#,
            "= help: torques that q, qd and qdd give are `tau`",
        ),
        (r#""Tau": [1, 2]"#, "did you mean `tau`?"),
        (r#""d": [1, 0, 0, 1]"#, "did you mean `D`?"),
        (r#""M": [1, 0, 0, 1]"#, "did you mean `D`?"),
        (r#""tua": [1, 2]"#, "did you mean `tau`?"),
        (r#""ddq": [1, 2]"#, "did you mean `qdd`?"),
        (r#""wind": [1, 2]"#, "help: a state has `q`"),
        (
            r#""regressor": [1, 2]"#,
            "`regressor` has 2 numbers, not 40",
        ),
        (
            r#""forward_dynamics": [1, 2]"#,
            "`torque` is missing, which `forward_dynamics` depends on",
        ),
        (r#""\u001b[31m": [1, 2]"#, "`\u{fffd}[31m` is no key"),
        (r#""condition": "good""#, "`condition` is a number"),
    ] {
        let FileError::Content(error) = read(file(keys).as_bytes(), 2).unwrap_err() else {
            panic!("{keys}");
        };
        let error = error.to_string();
        assert!(
            error.starts_with("state 1: ") && error.contains(meant),
            "{keys}: {error}"
        );
    }
    let good = read(file(r#""condition": 7.5, "tau": [1, 2]"#).as_bytes(), 2).unwrap();
    assert_eq!(good[0].known[&Quantity::Torque], [1.0, 2.0]);
    // What a quantity does not depend on may be left out, no more than that.
    let still = r#"{"states": [{"q": [0, 0], "c": [1, 2]}]}"#;
    assert_eq!(read(still.as_bytes(), 2).unwrap()[0].state.qdd, [0.0, 0.0]);
    let error = read(still.replace('c', "tau").as_bytes(), 2).unwrap_err();
    assert!(
        error
            .to_string()
            .contains("`qd` is missing, which `tau` depends on")
    );
    let error = read(br#"{"samples": []}"#, 2).unwrap_err();
    assert!(error.to_string().contains("is `samples` meant?"));
}
