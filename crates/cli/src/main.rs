//! The `dalembert` program.
#![forbid(unsafe_code)]

use std::process::ExitCode;

fn main() -> ExitCode {
    ExitCode::from(dalembert_cli::run(std::env::args_os()))
}
