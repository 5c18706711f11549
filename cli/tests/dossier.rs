//! `dalembert certify --dossier` as a user runs it.

use std::fs;

use crate::support::{arm, good, robot, run};

/// Returns the list of boxes that have a cross, and of those that have none.
fn boxes(text: &str) -> [Vec<&str>; 2] {
    ["- [x] ", "- [ ] "].map(|mark| text.lines().filter_map(|l| l.strip_prefix(mark)).collect())
}

#[test]
fn what_is_found_is_filled_in() {
    let limits = "limits = { position = [-3, 3], velocity = 2, acceleration = 5 }";
    let (folder, file) = arm("dossier", "planar2r", "");
    let text = fs::read_to_string(&file).unwrap();
    let text = text.replace("limits = { position = [\"-pi\", \"pi\"] }", limits);
    fs::write(&file, text).unwrap();
    let header = folder.join("arm.h");
    let generate = |outputs: &str| {
        let arguments = [
            "generate",
            &file,
            "--outputs",
            outputs,
            "--language",
            "c",
            "--sincos",
        ];
        good(
            &[
                &arguments[..],
                &["polynomial", "-o", header.to_str().unwrap()],
            ]
            .concat(),
        );
    };
    let dossier = folder.join("arm.md");
    let certify = |more: &[&str]| {
        let arguments = ["certify", header.to_str().unwrap(), "--robot", &file];
        let to = ["--dossier", dossier.to_str().unwrap()];
        run(&[&arguments[..], &to, more].concat())
    };
    generate("gravity,forward_dynamics,regressor");
    let ran = certify(&[]);
    assert_eq!(ran.code, 1, "{}", ran.err);
    let text = fs::read_to_string(&dossier).unwrap();
    assert!(text.starts_with("# Dossier of `arm.h`\n"), "{text}");
    assert!(
        text.contains("| 2 elbow | -3 to 3 | -2 to 2 | -5 to 5 |"),
        "{text}"
    );
    let [filled, open] = boxes(&text);
    for said in [
        "The input hash in the file's documentation is that of the robot file.",
        "Every joint has limits of position and rates.",
        "No function has a branch or a loop.",
        "No function calls another: `core` alone, in C without `math.h`.",
    ] {
        assert!(filled.contains(&said), "{said}: {text}");
    }
    let of = |list: &[&str], name: &str| list.iter().filter(|l| l.contains(name)).count();
    assert_eq!(
        (
            of(&filled, "`planar2r_f32` `gravity` is within"),
            of(&open, "`planar2r` `gravity`")
        ),
        (1, 1)
    );
    // Nobody says of what is tried, or not checked, that it is shown; the generator's proof is quoted.
    for said in [
        "`forward_dynamics` solves its equation of motion to ",
        "`regressor` is not checked",
    ] {
        assert_eq!((of(&filled, said), of(&open, said)), (0, 2), "{text}");
    }
    assert_eq!(
        of(&open, "a wrong program passes with probability below"),
        2
    );
    assert!(
        open.iter()
            .any(|item| item.starts_with("The robot file is the arm"))
    );
    // What was filled in by hand is not lost.
    let ran = certify(&[]);
    assert_eq!(ran.code, 2);
    ran.says(&["what was filled in would be lost"]);
    // A file of another robot, with calls.
    let other = fs::read_to_string(&file)
        .unwrap()
        .replacen("mass = 1\n", "mass = 2\n", 1);
    fs::write(&file, other).unwrap();
    let certified = certify(&["--force"]);
    assert_eq!(certified.code, 1);
    let text = fs::read_to_string(&dossier).unwrap();
    let [filled, open] = boxes(&text);
    assert_eq!(
        (of(&filled, "input hash"), of(&open, "input hash")),
        (0, 1),
        "{text}"
    );
    assert_eq!(of(&filled, "`gravity` is within"), 0, "{text}");
}

#[test]
fn dossiers_that_cannot_be() {
    let [rust, toml] =
        ["rs", "toml"].map(|kind| robot("planar2r").replace(".toml", &format!(".{kind}")));
    let ran = run(&["certify", &rust, "--robot", &toml, "--dossier", &toml]);
    assert_eq!(ran.code, 2);
    assert!(
        ran.err
            .contains("the dossier would be written over the robot file"),
        "{}",
        ran.err
    );
    let certificate = format!(
        "{}/../checker/tests/data/planar2r-pick.json",
        env!("CARGO_MANIFEST_DIR")
    );
    let ran = run(&[
        "certify",
        &certificate,
        "--robot",
        &toml,
        "--dossier",
        "never.md",
    ]);
    assert_eq!(ran.code, 2);
    ran.says(&["--dossier is of a generated file"]);
    let ran = run(&[
        "certify",
        &rust,
        "--robot",
        &toml,
        "--dossier",
        "nowhere/a.md",
    ]);
    assert_eq!(ran.code, 2);
    assert!(ran.out.is_empty(), "{}", ran.out);
}
