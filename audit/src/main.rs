//! `dalembert-audit CERTIFICATE.json ROBOT.toml [--scene NAME] [--text FILE.rs]`
#![forbid(unsafe_code)]

use std::process::ExitCode;

use dalembert_audit::{audit, read};

const USAGE: &str =
    "usage: dalembert-audit CERTIFICATE.json ROBOT.toml [--scene NAME] [--text FILE.rs]

Shows that the function in a certificate is as near to the robot's dynamics as the
certificate says, by means of its own. The scene is the certificate's unless it is named.
FILE.rs must have the function as it stands in the certificate. Exit codes: 0 every output
is shown, 1 one is not, 2 bad input, or nothing that is audited.";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let mut given: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let mut option = |name: &str| {
        let at = given.iter().position(|word| *word == name)?;
        given.remove(at);
        (at < given.len()).then(|| given.remove(at))
    };
    let (scene, text) = (option("--scene"), option("--text"));
    let &[certificate, robot] = given.as_slice() else {
        eprintln!("{USAGE}");
        return ExitCode::from(2);
    };
    let code = run(certificate, robot, scene, text).unwrap_or_else(|why| {
        eprintln!("{why}");
        2
    });
    println!("{}", if code == 0 { "shown" } else { "not shown" });
    ExitCode::from(code)
}

/// Audits every claim of a file; the exit code of the worst.
fn run(
    certificate: &str,
    robot: &str,
    scene: Option<&str>,
    text: Option<&str>,
) -> Result<u8, String> {
    let file = |path: &str| std::fs::read_to_string(path).map_err(|e| format!("{path}: {e}"));
    let (document, robot) = (file(certificate)?, file(robot)?);
    let text = text.map(file).transpose()?;
    let mut code = 0;
    for mut claim in read(&document).map_err(|fault| fault.to_string())? {
        if text.as_ref().is_some_and(|text| !text.contains(claim.text.trim())) {
            let name = claim.function.name();
            return Err(format!("the text has not the certificate's `{name}`"));
        }
        claim.scene = scene.map(String::from).or(claim.scene);
        match audit(&claim, &robot) {
            Ok(verdict) => {
                print!("{verdict}");
                code = code.max(u8::from(!verdict.is_shown()));
            }
            Err(fault) => {
                eprintln!("{fault}");
                code = 2;
            }
        }
    }
    Ok(code)
}
