//! The `dalembert-fleet` command.
#![forbid(unsafe_code)]

use std::io::{ErrorKind, Write};
use std::process::ExitCode;
use std::time::Duration;

use clap::Parser;
use dalembert_fleet::commands::{CommandLine, run};
use dalembert_fleet::progress::{Going, INTERRUPTED};
use tokio::runtime::Builder;

/// The exit code after Ctrl-C: 128 + SIGINT.
const ENDED: u8 = 130;

fn main() -> ExitCode {
    let arguments = CommandLine::parse();
    let runtime = match Builder::new_multi_thread().enable_all().build() {
        Ok(runtime) => runtime,
        Err(why) => return failed(&why.to_string()),
    };
    let (end, going) = Going::new();
    let result = runtime.block_on(async {
        tokio::spawn(async move {
            if tokio::signal::ctrl_c().await.is_ok() {
                // Whoever still waits hears of it.
                let _ = end.send(true);
            } else {
                std::future::pending::<()>().await;
            }
        });
        run(arguments, &going).await
    });
    // A search that nobody waits for any more is not waited for.
    runtime.shutdown_timeout(Duration::from_millis(100));
    match result {
        Ok(report) => match std::io::stdout().write_all(report.text.as_bytes()) {
            // A broken pipe: the reader has read enough.
            Err(why) if why.kind() != ErrorKind::BrokenPipe => failed(&why.to_string()),
            _ => match report.failed {
                Some(why) => failed(&why.to_string()),
                None => ExitCode::SUCCESS,
            },
        },
        Err(why) if why.to_string().ends_with(INTERRUPTED) => {
            eprintln!("{why}");
            ExitCode::from(ENDED)
        }
        Err(why) => failed(&why.to_string()),
    }
}

fn failed(why: &str) -> ExitCode {
    // The errors of a robot file say so themselves, at each place.
    match why.starts_with("error") {
        true => eprintln!("{why}"),
        false => eprintln!("error: {why}"),
    }
    ExitCode::FAILURE
}
