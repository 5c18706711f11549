//! How the command meets whoever types: colours, completions, a bar.

use std::process::Command;

use crate::support::{Ran, good, robot};

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
