//! How the command meets whoever types: warnings denied, colours, completions, a bar.

use std::fs;
use std::process::Command;

use crate::support::{Ran, arm, good, robot, run};

/// Returns the planar arm with a body that cannot be, of which its reader warns.
fn doubtful(folder: &str) -> (std::path::PathBuf, String) {
    let (folder, name) = arm(folder, "planar2r", "");
    let text = fs::read_to_string(&name).unwrap();
    let odd = text.replacen("inertia = [0, 0.08333333333333333,", "inertia = [0, 9,", 1);
    assert_ne!(odd, text);
    fs::write(&name, odd).unwrap();
    (folder, name)
}

#[test]
fn denied_warnings_leave_nothing_behind() {
    let (folder, arm) = doubtful("denied");
    let code = folder.join("arm.rs");
    let generate = [
        "generate",
        &arm,
        "--outputs",
        "gravity",
        "-o",
        code.to_str().unwrap(),
    ];
    let ran = run(&[&generate[..], &["--deny-warnings"]].concat());
    ran.ends(1, &["warning", "--deny-warnings takes them for errors"]);
    assert!(!code.exists());
    good(&generate);
    let before = fs::read(&code).unwrap();
    // The position is one of a warning that comes later.
    let planar = robot("planar2r");
    let far = run(&["--deny-warnings", "show", &planar, "--at", "90,0"]);
    far.ends(1, &["warning: --at", "--deny-warnings"]);
    good(&["--deny-warnings", "show", &planar]);
    assert_eq!(fs::read(&code).unwrap(), before);
}

#[test]
fn colours_are_for_terminals() {
    let coloured = |key: &str, value: &str| -> Ran {
        let mut command = Command::new(env!("CARGO_BIN_EXE_dalembert"));
        for key in ["NO_COLOR", "CLICOLOR_FORCE", "CLICOLOR"] {
            command.env_remove(key);
        }
        let output = command
            .args(["generate", "none.toml"])
            .env(key, value)
            .output()
            .unwrap();
        let [out, err] = [output.stdout, output.stderr].map(|b| String::from_utf8(b).unwrap());
        let code = output.status.code().unwrap();
        Ran { code, out, err }
    };
    coloured("CLICOLOR_FORCE", "1").ends(2, &["\x1b[1;31merror\x1b[0m: "]);
    let plain = coloured("NO_COLOR", "1");
    assert!(plain.err.starts_with("error: ") && !plain.err.contains('\x1b'));
    // A pipe is no terminal.
    assert_eq!(coloured("TERM", "xterm").err, plain.err);
}

#[test]
fn shells_complete_commands_and_options() {
    for (shell, part) in [
        ("bash", "--deny-warnings"),
        ("zsh", "#compdef dalembert"),
        ("fish", "complete -c dalembert"),
    ] {
        let script = good(&["completions", shell]).out;
        assert!(
            script.contains(part) && script.contains("tradeoff"),
            "{shell}"
        );
    }
    assert_eq!(run(&["completions", "sh"]).code, 2);
}

/// A bar is shown on a terminal, which `script` of util-linux lends, once two seconds are over.
#[cfg(target_os = "linux")]
#[test]
fn a_bar_after_two_seconds() {
    use std::io::Read;
    use std::process::Stdio;

    let shows = |arguments: &str| {
        let line = format!("{} {arguments}", env!("CARGO_BIN_EXE_dalembert"));
        let mut child = Command::new("script")
            .args(["-qec", &line, "/dev/null"])
            .env("TERM", "xterm")
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .spawn()
            .expect("`script` of util-linux");
        let mut out = child.stdout.take().unwrap();
        let (mut seen, mut part) = (Vec::new(), [0; 4096]);
        let shown = loop {
            let read = out.read(&mut part).unwrap_or(0);
            seen.extend_from_slice(&part[..read]);
            let shown = String::from_utf8_lossy(&seen).contains('\u{2591}');
            if shown || read == 0 {
                break shown;
            }
        };
        let _ = child.kill();
        child.wait().unwrap();
        shown
    };
    let searched = format!("count {} --plan off --effort thorough", robot("panda"));
    assert!(shows(&searched));
    assert!(!shows(&format!("show {}", robot("planar2r"))));
}
