//! `dalembert-checker CERTIFICATE.json ROBOT.toml [--scene NAME] [--text FILE.rs]`
#![forbid(unsafe_code)]

use std::io::Write;
use std::process::ExitCode;

use dalembert_checker::command;

fn main() -> ExitCode {
    let arguments = std::env::args_os().skip(1);
    let code = command::run(arguments, &mut std::io::stdout().lock());
    // Who closed the other end wants no more.
    ExitCode::from(code.unwrap_or_else(|why| {
        let _ = writeln!(std::io::stderr(), "{why}");
        2
    }))
}
