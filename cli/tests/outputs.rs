//! What a run writes: looked at before its work, never over something else,
//! all of it or nothing.

use std::fs;
use std::path::{Path, PathBuf};

use crate::support::{self, Ran, good, run};

const SCENE: &str = r#"
[scene.hold]
outputs = ["gravity"]
tolerance = { value = 0.3, relative_to = "range" }
scalar = "f64"
"#;

/// Returns a folder with a robot file.
fn arm(name: &str) -> (PathBuf, String) {
    support::arm(name, "planar2r", SCENE)
}

fn hold(arm: &str, arguments: &[&str]) -> Ran {
    run(&[&["generate", arm, "--scene", "hold"][..], arguments].concat())
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let names = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let mut names: Vec<String> = names.collect();
    names.sort();
    names
}

/// Asserts that it is refused with these words before anything was searched for: there is no
/// report, and the folder is as it was.
fn refused(ran: &Ran, words: &str, folder: &Path, before: &[String]) {
    assert_eq!(ran.code, 2, "{words}: {}", ran.err);
    assert!(ran.err.contains(words), "{words}: {}", ran.err);
    assert!(!ran.err.contains("joints, input"), "{words}: {}", ran.err);
    assert!(ran.out.is_empty());
    assert_eq!(names(folder), before, "{words}");
}

#[test]
fn folders_and_missing_ones_are_no_targets() {
    let (folder, arm) = arm("targets");
    fs::create_dir_all(folder.join("out")).unwrap();
    fs::create_dir_all(folder.join("code.certificate.json")).unwrap();
    let before = names(&folder);
    let path = |name: &str| folder.join(name).to_str().unwrap().to_owned();
    for (arguments, words) in [
        (vec!["-o", &*path("out")], "it is a folder"),
        (vec!["-o", &*path("new/")], "it is a folder"),
        (vec!["-o", &*path("none/code.rs")], "there is no folder"),
        // The certificate beside the code.
        (
            vec!["-o", &*path("code.rs")],
            "code.certificate.json` cannot be written",
        ),
        (
            vec!["-o", &*path("a.rs"), "--certificate", &*path("out")],
            "it is a folder",
        ),
        (
            vec!["-o", &*path("a.rs"), "--certificate", &*path("none/a.json")],
            "there is no folder",
        ),
    ] {
        refused(&hold(&arm, &arguments), words, &folder, &before);
    }
    // Where nothing is to be certified.
    let gravity = ["generate", &arm, "--outputs", "gravity"];
    let ran = run(&[&gravity[..], &["--certificate", &path("a.json")]].concat());
    refused(&ran, "nothing to certify", &folder, &before);
}

#[test]
fn nothing_is_written_over_an_input_or_another_output() {
    let (folder, arm) = arm("distinct");
    fs::write(folder.join("arm.plan"), "").unwrap();
    let gravity = |arguments: &[&str]| {
        let generate = ["generate", &arm, "--outputs", "gravity", "--plan=off"];
        run(&[&generate[..], arguments].concat())
    };
    let path = |name: &str| folder.join(name).to_str().unwrap().to_owned();
    #[cfg(unix)]
    std::os::unix::fs::symlink("arm.toml", folder.join("link.toml")).unwrap();
    #[cfg(not(unix))]
    fs::write(folder.join("link.toml"), "").unwrap();
    let before = names(&folder);
    let source = fs::read_to_string(&arm).unwrap();
    let over = "--output would be written over the robot file";
    refused(&gravity(&["-o", &arm]), over, &folder, &before);
    let dotted = path("../distinct/arm.toml");
    refused(&gravity(&["-o", &dotted]), over, &folder, &before);
    if cfg!(unix) {
        refused(
            &gravity(&["-o", &path("link.toml")]),
            over,
            &folder,
            &before,
        );
    }
    let over = "over the plan beside the robot file";
    refused(&gravity(&["-o", &path("arm.plan")]), over, &folder, &before);
    fs::remove_file(folder.join("arm.plan")).unwrap();
    let before = names(&folder);
    // There is none, but the next run would read it.
    refused(&gravity(&["-o", &path("arm.plan")]), over, &folder, &before);
    let plan = path("arm.plan");
    let generate = ["generate", &arm, "--outputs", "gravity"];
    let same = run(&[&generate[..], &["-o", &plan, "--save-plan"]].concat());
    let words = "--output and --save-plan would be the same file";
    refused(&same, words, &folder, &before);
    let certificate = hold(&arm, &["--certificate", &arm]);
    let words = "--certificate would be written over the robot file";
    refused(&certificate, words, &folder, &before);
    let code = path("same.rs");
    let same = hold(&arm, &["-o", &code, "--certificate", &code]);
    let words = "--output and --certificate would be the same file";
    refused(&same, words, &folder, &before);
    assert_eq!(fs::read_to_string(&arm).unwrap(), source);
}

/// A file that the command did not write stays, unless it is told to write over it.
#[test]
fn files_of_others_stay() {
    let (folder, arm) = arm("of_others");
    let path = |name: &str| folder.join(name).to_str().unwrap().to_owned();
    fs::write(folder.join("main.rs"), "fn main() {}\n").unwrap();
    fs::write(folder.join("empty.rs"), "").unwrap();
    fs::write(folder.join("code.certificate.json"), "{}").unwrap();
    let before = names(&folder);
    let words = "dalembert did not write it";
    refused(
        &hold(&arm, &["-o", &path("main.rs")]),
        words,
        &folder,
        &before,
    );
    refused(
        &hold(&arm, &["-o", &path("code.rs")]),
        words,
        &folder,
        &before,
    );
    fs::write(folder.join("main.svg"), "<svg/>").unwrap();
    let before = names(&folder);
    let show = ["show", &arm, "-o", &path("main.svg")];
    refused(&run(&show), words, &folder, &before);
    let text = fs::read_to_string(folder.join("main.rs")).unwrap();
    assert_eq!(text, "fn main() {}\n");
    for name in ["empty.rs", "empty.rs"] {
        let ran = hold(&arm, &["-o", &path(name)]);
        assert_eq!(ran.code, 0, "{}", ran.err);
    }
    let ran = hold(&arm, &["-o", &path("main.rs"), "--force"]);
    assert_eq!(ran.code, 0, "{}", ran.err);
    for _ in 0..2 {
        good(&["show", &arm, "-o", &path("arm.svg")]);
    }
}

/// A link keeps leading to the file where it leads; the certificate is beside the link. A
/// link to nowhere is refused.
#[cfg(unix)]
#[test]
fn links_are_followed() {
    use std::os::unix::fs::symlink;
    let (folder, arm) = arm("links");
    fs::create_dir_all(folder.join("far")).unwrap();
    fs::write(folder.join("far/old.rs"), "// By dalembert, old.").unwrap();
    symlink("far/old.rs", folder.join("there.rs")).unwrap();
    let ran = hold(&arm, &["-o", folder.join("there.rs").to_str().unwrap()]);
    assert_eq!(ran.code, 0, "{}", ran.err);
    let there = fs::read_link(folder.join("there.rs")).unwrap();
    assert_eq!(there, Path::new("far/old.rs"));
    let text = fs::read_to_string(folder.join("far/old.rs")).unwrap();
    assert!(text.contains("scene: hold"), "{text}");
    assert_eq!(names(&folder.join("far")), ["old.rs"]);
    assert!(names(&folder).contains(&"there.certificate.json".to_owned()));
    symlink("circle.rs", folder.join("circle.rs")).unwrap();
    symlink("nothing.rs", folder.join("nowhere.rs")).unwrap();
    let before = names(&folder);
    for link in ["circle.rs", "nowhere.rs"] {
        let ran = hold(&arm, &["-o", folder.join(link).to_str().unwrap()]);
        refused(&ran, "cannot be written", &folder, &before);
    }
}

/// A pipe stays one, with the code in it and no certificate beside it.
#[cfg(unix)]
#[test]
fn pipes_are_written_into() {
    use std::os::unix::fs::FileTypeExt;
    let (folder, arm) = arm("pipes");
    let pipe = folder.join("pipe.rs");
    let made = std::process::Command::new("mkfifo").arg(&pipe).status();
    assert!(made.unwrap().success());
    let before = names(&folder);
    let name = pipe.to_str().unwrap();
    let reader = std::thread::spawn({
        let pipe = pipe.clone();
        move || fs::read_to_string(pipe).unwrap()
    });
    let ran = hold(&arm, &["-o", name]);
    assert_eq!(ran.code, 0, "{}", ran.err);
    assert!(reader.join().unwrap().contains("scene: hold"));
    assert!(fs::symlink_metadata(&pipe).unwrap().file_type().is_fifo());
    assert_eq!(names(&folder), before);
}

/// Like no name at all, also where it has been sent to a file: what is in that
/// stays.
#[cfg(unix)]
#[test]
fn standard_output_by_its_name() {
    let (folder, arm) = arm("standard");
    let before = names(&folder);
    let plain = hold(&arm, &[]);
    let named = hold(&arm, &["-o", "/dev/stdout"]);
    assert_eq!(named.code, 0, "{}", named.err);
    assert!(named.out == plain.out && !plain.out.is_empty());
    assert_eq!(names(&folder), before);

    let log = folder.join("log");
    fs::write(&log, "before\n").unwrap();
    let open = fs::OpenOptions::new().append(true).open(&log).unwrap();
    let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_dalembert"));
    let command = command.args(["generate", &arm, "--scene", "hold", "-o", "/dev/stdout"]);
    assert!(command.stdout(open).output().unwrap().status.success());
    let text = fs::read_to_string(&log).unwrap();
    assert_eq!(text, format!("before\n{}", plain.out));
}

/// A folder is made when there is something to put into it.
#[test]
fn folders_are_made_at_the_end() {
    let (folder, arm) = arm("folders");
    let before = names(&folder);
    let path = |name: &str| folder.join(name).to_str().unwrap().to_owned();
    let tradeoff = |output: &str| run(&["tradeoff", &arm, "-o", output]);
    // The robot has no limits: said after the folder was looked at.
    let ran = tradeoff(&path("new/deep"));
    refused(&ran, "joints 1, 2 have no limit", &folder, &before);
    let ran = tradeoff(&path("arm.toml/deep"));
    refused(&ran, "arm.toml` is no folder", &folder, &before);
    let ran = tradeoff(&arm);
    refused(&ran, "is no folder", &folder, &before);
    fs::create_dir_all(folder.join("full/tradeoff.csv")).unwrap();
    let before = names(&folder);
    refused(&tradeoff(&path("full")), "it is a folder", &folder, &before);
}

/// A macro that was expanded without a plan watches the robot file alone: a
/// first plan gives that a new time, the next does not, and neither a new text.
#[test]
fn a_first_plan_is_noticed() {
    let (folder, arm) = arm("first_plan");
    let plan = folder.join("arm.plan");
    let source = fs::read_to_string(&arm).unwrap();
    let past = std::time::SystemTime::UNIX_EPOCH + std::time::Duration::from_secs(1_000_000_000);
    for first in [true, false] {
        let file = fs::File::options().append(true).open(&arm).unwrap();
        file.set_modified(past).unwrap();
        let ran = good(&gravity_of(&arm));
        assert!(plan.is_file(), "{}", ran.err);
        let now = fs::metadata(&arm).unwrap().modified().unwrap();
        assert_eq!(now != past, first);
        assert_eq!(fs::read_to_string(&arm).unwrap(), source);
    }
}

fn gravity_of(arm: &str) -> [&str; 6] {
    [
        "generate",
        arm,
        "--outputs",
        "gravity",
        "--scalar=f64",
        "--save-plan",
    ]
}

/// A robot file with friction: roots have a column of their own, what cannot be is
/// refused with the way around, and what is wrong with the keys by its line.
#[test]
fn friction_is_counted_or_refused() {
    let (folder, arm) = arm("coulomb");
    let robot = fs::read_to_string(&arm).unwrap();
    let with = |keys: &str| {
        let text = robot.replacen("mass =", &format!("{keys}\nmass ="), 1);
        fs::write(&arm, text).unwrap();
    };
    with("coulomb = 2.5\ncoulomb_width = 0.01");
    let counted = good(&["count", &arm, "--outputs", "inverse_dynamics,gravity"]);
    let lines: Vec<&str> = counted.out.lines().collect();
    let words = |line: &str| {
        line.split_whitespace()
            .map(str::to_owned)
            .collect::<Vec<_>>()
    };
    assert_eq!(
        words(lines[2])[..6],
        ["function", "mul", "add", "div", "sqrt", "sincos"]
    );
    assert_eq!(words(lines[3])[3..6], ["1", "1", "2"], "{}", counted.out);
    assert_eq!(words(lines[4])[3..6], ["0", "0", "2"], "{}", counted.out);
    let before = names(&folder);
    let refusals = [
        (
            &["--outputs", "regressor"][..],
            "torques with Coulomb friction are not linear in its parameters",
        ),
        (
            &["--outputs", "inverse_dynamics", "--scene", "rough"][..],
            "`inverse_dynamics`: it has Coulomb friction in it",
        ),
    ];
    let tolerance = "tolerance = { value = 0.1, relative_to = \"actuator\" }";
    let limits = "limits = { velocity = 2, acceleration = 9, torque = 90, ";
    let text = fs::read_to_string(&arm).unwrap();
    let text = text.replace("limits = {", limits);
    fs::write(&arm, format!("{text}\n[scene.rough]\n{tolerance}\n")).unwrap();
    for (arguments, words) in refusals {
        let ran = run(&[&["generate", &arm][..], arguments].concat());
        refused(&ran, words, &folder, &before);
    }
    for (keys, words) in [
        (
            "coulomb = 2.5",
            "Coulomb friction without a `coulomb_width`",
        ),
        ("coulomb = -1\ncoulomb_width = 1", "coulomb is negative"),
    ] {
        with(keys);
        let ran = run(&["generate", &arm]);
        refused(&ran, words, &folder, &before);
        ran.says(&["arm.toml:"]);
    }
}

/// The ending of `-o` chooses the language; one that no language has, or another one, is refused.
#[test]
fn endings_choose_the_language() {
    let (folder, arm) = arm("endings");
    let path = |name: &str| folder.join(name).to_str().unwrap().to_owned();
    let generate = |name: &str, more: &[&str]| {
        let fixed = ["generate", &arm, "--outputs", "gravity", "-o", &path(name)];
        run(&[&fixed[..], more].concat())
    };
    for (name, part) in [
        ("a.rs", "//! Dynamics of the robot `planar2r`"),
        ("a.h", "#ifndef PLANAR2R_H"),
        ("a.H", "#ifndef PLANAR2R_H"),
        ("a.cuh", "__device__"),
        ("plain", "//! Dynamics of the robot `planar2r`"),
    ] {
        let ran = generate(name, &[]);
        assert_eq!(ran.code, 0, "{}", ran.err);
        let text = fs::read_to_string(folder.join(name)).unwrap();
        assert!(text.contains(part), "{name}: {text}");
    }
    assert_eq!(generate("a.inc", &["--language", "c"]).code, 0);
    let before = names(&folder);
    for (name, more) in [
        ("b.png", &[][..]),
        ("b.py", &[]),
        ("b.rs", &["--language", "c"]),
        ("b.h", &["--language", "rust"]),
    ] {
        let ran = generate(name, more);
        ran.ends(2, &["does not end as a file of", ".h (c)"]);
    }
    run(&["show", &arm, "-o", &path("s.png")]).ends(2, &["would hold a .svg file", "s.svg"]);
    assert_eq!(names(&folder), before);
}

/// `-` is standard output, for which a report and a file cannot both be meant.
#[test]
fn a_hyphen_is_standard_output() {
    let (folder, arm) = arm("hyphen");
    let before = names(&folder);
    for command in [
        &["generate", &arm, "--outputs", "gravity"][..],
        &["show", &arm],
    ] {
        let [plain, hyphen] = [&[][..], &["-o", "-"]].map(|more| good(&[command, more].concat()));
        assert_eq!(plain.out, hyphen.out);
        let both = run(&[command, &["-o", "-", "--json"]].concat());
        both.ends(2, &["the report goes to standard output"]);
    }
    run(&["tradeoff", &arm, "-o", "-"]).ends(2, &["a folder is needed"]);
    assert_eq!(names(&folder), before);
}
