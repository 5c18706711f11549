//! `dalembert-audit CERTIFICATE.json ROBOT.toml [TEXT.rs]`
#![forbid(unsafe_code)]

use std::path::Path;
use std::process::ExitCode;

use dalembert_audit::{audit, read};

const USAGE: &str = "usage: dalembert-audit CERTIFICATE.json ROBOT.toml [TEXT.rs]

Shows that the function in a certificate is as near to the robot's dynamics as the
certificate says, by means of its own. TEXT.rs must have the function as it stands in
the certificate. Exit codes: 0 every output is shown, 1 one is not, 2 bad input.";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let given: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let (certificate, robot, text) = match given.as_slice() {
        [certificate, robot] => (*certificate, *robot, None),
        [certificate, robot, text] => (*certificate, *robot, Some(*text)),
        _ => {
            eprintln!("{USAGE}");
            return ExitCode::from(2);
        }
    };
    match run(certificate, robot, text) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::from(1),
        Err(why) => {
            eprintln!("{why}");
            ExitCode::from(2)
        }
    }
}

/// Audits every claim of a file; whether all are shown.
fn run(certificate: &str, robot: &str, text: Option<&str>) -> Result<bool, String> {
    let file = |path: &str| {
        std::fs::read_to_string(Path::new(path)).map_err(|error| format!("{path}: {error}"))
    };
    let (document, robot) = (file(certificate)?, file(robot)?);
    let text = text.map(file).transpose()?;
    let claims = read(&document).map_err(|fault| fault.to_string())?;
    let mut all = true;
    for claim in claims {
        if let Some(text) = &text
            && !text.contains(claim.text.trim())
        {
            return Err(format!("the text has not the certificate's `{}`", claim.function.name()));
        }
        let verdict = audit(&claim, &robot).map_err(|fault| fault.to_string())?;
        print!("{verdict}");
        all &= verdict.is_shown();
    }
    println!("{}", if all { "shown" } else { "not shown" });
    Ok(all)
}
