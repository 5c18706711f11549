//! Whatever is wrong with the input: exit code 2, a message, never a panic.

use std::fs;

use crate::support::{good, robot, run, temporary};

#[test]
fn broken_robot_files_name_the_line() {
    let folder = temporary("broken");
    let file = folder.join("arm.toml");
    let name = file.to_str().unwrap();
    let planar = fs::read_to_string(robot("planar2r")).unwrap();
    // From the first key on: the comments before it have words of their own.
    let planar = planar[planar.find("\nname").unwrap() + 1..].to_owned();
    let line = |word: &str| planar.lines().position(|l| l.starts_with(word)).unwrap() + 1;
    let mass = line("mass");
    for (source, expected) in [
        (
            planar.replacen("mass", "mas", 1),
            format!("arm.toml:{mass}:1"),
        ),
        (
            planar.replacen("mass = ", "mass = -", 1),
            format!("arm.toml:{mass}:"),
        ),
        (
            planar.replacen("mass = ", "mass = nan #", 1),
            format!("arm.toml:{mass}:"),
        ),
        (
            planar.replacen("revolute", "rotary", 1),
            "did you mean".into(),
        ),
        (planar.replacen('=', "", 1), "arm.toml:".into()),
        (String::new(), "arm.toml:1:1".into()),
        ("\u{0}".into(), "arm.toml:1".into()),
        (planar.replacen("planar2r", "fn", 1), "Rust".into()),
        (
            "[[joint]]\n".repeat(70),
            "more errors after this one".into(),
        ),
    ] {
        fs::write(&file, &source).unwrap();
        for subcommand in ["generate", "count", "verify", "explain"] {
            let ran = run(&[subcommand, name]);
            assert_eq!(ran.code, 2, "{subcommand}: {source:?}: {}", ran.err);
            assert!(ran.err.contains(&expected), "{subcommand}: {}", ran.err);
            assert!(ran.out.is_empty());
            assert!(!ran.err.contains("panicked"));
        }
    }
}

#[test]
fn bytes_that_are_no_text() {
    let folder = temporary("bytes");
    let file = folder.join("arm.toml");
    for bytes in [&b"\xff\xfe"[..], b"name = \"\xc3\"", &vec![b'a'; 2 << 20]] {
        fs::write(&file, bytes).unwrap();
        let ran = run(&["count", file.to_str().unwrap()]);
        assert_eq!(ran.code, 2, "{}", ran.err);
        assert!(ran.err.starts_with("error: "), "{}", ran.err);
    }
}

#[test]
fn files_that_cannot_be_read_or_written() {
    let folder = temporary("folders");
    let missing = folder.join("no.toml");
    let ran = run(&["generate", missing.to_str().unwrap()]);
    assert_eq!(ran.code, 2);
    ran.says(&["there is no file `"]);
    let ran = run(&["generate", "nowhere/no.toml"]);
    ran.says(&[
        "there is no file `nowhere/no.toml`",
        "nowhere/no.toml`\n",
        "= note: its full path is `/",
    ]);
    // In the words of macro and builder, with the file that was meant.
    let beside = robot("planar2r").replace("planar2r", "planar2");
    let ran = run(&["generate", &beside]);
    ran.says(&["planar2.toml`\n  = help: did you mean `", "planar2r.toml`?"]);
    assert_eq!(run(&["count", folder.to_str().unwrap()]).code, 2);

    let planar = robot("planar2r");
    let into = |target: &str| run(&["generate", &planar, "--outputs", "gravity", "-o", target]);
    for target in [
        folder.join("none/arm.rs"),
        folder.clone(),
        folder.join(".."),
    ] {
        let ran = into(target.to_str().unwrap());
        ran.ends(2, &["cannot be written"]);
    }
    assert_eq!(fs::read_dir(&folder).unwrap().count(), 0);
}

/// Arguments, and words of what is said.
const WRONG: &str = "
generate PUMA --outputs graviti | `gravity`
count PUMA --outputs M | did you mean `inertia`?
count PUMA --outputs gravity,C | did you mean `coriolis`?
count PUMA --outputs= | expected a word, such as `inverse_dynamics`
certify PUMA | expected a certificate (.json) or a generated file (.rs, .h, .cuh), found a robot
certify PUMA --robot PUMA | `dalembert certify FILE --robot /
verify URDF | `dalembert import FILE` makes one of a URDF
count PUMA --formulation lagrange | did you mean `lagrange_euler`
count PUMA --scalar f65 | unknown scalar `f65`
count PUMA --effort quik | did you mean `quick`
generate PUMA --scalar f64,f32 | each scalar has a file of its own
generat PUMA | 'generate'
generate | <ROBOT>
generate PUMA --sincos-error -1 | an error above 0 and below 1
tradeoff PUMA --tolerances -1 | a number above zero, not -1
tradeoff PUMA --tolerances -1e-3,0.1 | a number above zero, not -0.001
tradeoff PUMA --tolerances 1% | a number above zero, such as 1e-3
generate PUMA --states -1 | 1..=10000
verify PUMA --states 0 | 1..=10000
generate PUMA --save-plan --plan off | cannot be used with
tradeoff PUMA --samples -1 | a whole number, 0 or more
 | Usage
";

/// Devices, which have no length to look at before they are read.
#[cfg(unix)]
const ENDLESS: &str = "
certify /dev/zero --robot PUMA | longer than 32 MiB
certify /dev/null --robot /dev/zero | longer than 32 MiB
count /dev/zero | a robot file has at most
";

fn refused(table: &str) {
    let puma = robot("puma560");
    for row in table.lines().filter(|row| !row.is_empty()) {
        let (arguments, words) = row.split_once(" | ").unwrap();
        let arguments = arguments.split_whitespace();
        let arguments = arguments.map(|word| match word {
            "PUMA" => &puma,
            "URDF" => concat!(env!("CARGO_MANIFEST_DIR"), "/../gallery/urdf/gen3.urdf"),
            word => word,
        });
        run(&arguments.collect::<Vec<_>>()).ends(2, &[words]);
    }
}

#[test]
fn wrong_words_on_the_command_line() {
    refused(WRONG);
}

/// A plan of other numbers gives way to a search, with a warning that says how to renew it;
/// a pipe in its place is not waited for.
#[test]
fn plans_that_cannot_be_used() {
    let folder = temporary("stale_plan");
    let file = folder.join("arm.toml");
    let name = file.to_str().unwrap();
    let planar = fs::read_to_string(robot("planar2r")).unwrap();
    fs::write(&file, planar.replacen("shoulder", "first", 1)).unwrap();
    let plan = folder.join("arm.plan");
    let kept = robot("planar2r").replace(".toml", ".plan");
    fs::copy(kept, &plan).unwrap();
    let gravity = ["count", name, "--outputs", "gravity"];
    let ran = good(&gravity);
    let renewal = format!("`dalembert generate {name} --effort thorough --save-plan` renews it");
    ran.says(&["warning: ", &renewal]);
    let without = run(&[&gravity[..], &["--plan=off"]].concat());
    assert_eq!((without.code, &without.out), (0, &ran.out));
    assert!(!without.err.contains("warning: "), "{}", without.err);
    let output = folder.join("arm.rs");
    let output = output.to_str().unwrap();
    let generate = ["generate", name, "--outputs", "gravity", "-o", output];
    let ran = good(&generate);
    ran.says(&[&renewal]);
    #[cfg(unix)]
    {
        fs::remove_file(&plan).unwrap();
        let made = std::process::Command::new("mkfifo").arg(&plan).status();
        assert!(made.is_ok_and(|status| status.success()));
        let ran = run(&gravity);
        ran.ends(2, &["a plan is a file"]);
    }
}

#[cfg(unix)]
#[test]
fn inputs_without_end() {
    refused(ENDLESS);
}

#[test]
fn what_no_scalar_can_hold_is_said() {
    let folder = temporary("range");
    let file = folder.join("arm.toml");
    let planar = fs::read_to_string(robot("planar2r")).unwrap();
    let heavy = planar.replacen("mass = ", "mass = 1e200 #", 1);
    fs::write(&file, heavy).unwrap();
    let name = file.to_str().unwrap();
    let ran = run(&["generate", name, "--scalar", "f32"]);
    assert_eq!(ran.code, 2);
    ran.says(&["f32 cannot hold"]);
    assert_eq!(run(&["generate", name]).code, 0);
    // Counting needs no scalar.
    assert_eq!(run(&["count", name]).code, 0);
}

#[test]
fn help_and_version_are_no_failures() {
    let help = good(&["--help"]);
    for subcommand in ["generate", "count", "verify", "explain"] {
        assert!(help.out.contains(subcommand));
    }
    assert!(run(&["--version"]).out.contains(env!("CARGO_PKG_VERSION")));
}
