//! The progress bar on a terminal.

use std::process::Command;

use crate::support::robot;

/// A bar appears after two seconds on a terminal, which `script` of util-linux provides.
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
